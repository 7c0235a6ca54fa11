"""Crack paths as segments of edges: from cracks_*.vtu, or from a frame of the fields whose elements have come apart."""
from __future__ import annotations

import heapq
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from studies.common.fields import Frame, read_vtu

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Segments:
    """Edges: ends (n, 2, 2) m in the reference shape; m; m; s at which they failed, infinite where they have not."""

    ends: Array
    opening: Array
    slip: Array
    time_of_failure: Array

    @property
    def middle(self) -> Array:
        return self.ends.mean(axis=1)

    @property
    def length(self) -> Array:
        return np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)

    def chosen(self, which: NDArray) -> "Segments":
        return Segments(self.ends[which], self.opening[which], self.slip[which], self.time_of_failure[which])

    def failed_by(self, t: float) -> "Segments":
        return self.chosen(self.time_of_failure <= t)


def read_cracks(path: Path) -> Segments:
    """cracks_*.vtu: edges as lines, with opening, slip and time_of_failure (negative or NaN: has not failed) per cell."""
    content = read_vtu(path)
    if not np.all(content.types == 3):
        raise ValueError(f"{path}: holds other cells than lines")
    ends = content.points[content.connectivity.reshape(-1, 2)]
    time = np.asarray(content.cell_data["time_of_failure"], dtype=float).copy()
    time[~(time >= 0)] = np.inf
    return Segments(ends, np.asarray(content.cell_data["opening"], dtype=float),
                    np.asarray(content.cell_data["slip"], dtype=float), time)


def apart(frame: Frame, digits: int = 9) -> Segments:
    """Edges at the same place in the reference shape that belong to different nodes; digits: decimals of a metre."""
    triangles = frame.triangles
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    place = np.round(frame.points, digits) + 0.0
    _, of_place = np.unique(place, axis=0, return_inverse=True)
    of_place = of_place.ravel()
    turned = of_place[edges[:, 0]] > of_place[edges[:, 1]]
    edges[turned] = edges[turned][:, ::-1]
    keys = of_place[edges]
    order = np.lexsort((edges[:, 0], keys[:, 1], keys[:, 0]))
    edges, keys, turned = edges[order], keys[order], turned[order]
    twins = np.nonzero(np.all(keys[1:] == keys[:-1], axis=1) & np.any(edges[1:] != edges[:-1], axis=1))[0]
    first, second = edges[twins], edges[twins + 1]
    u = frame.point_data["displacement"][:, :2]
    jump = (u[first] - u[second]).mean(axis=1)
    ends = frame.points[first]
    way = ends[:, 1] - ends[:, 0]
    way /= np.linalg.norm(way, axis=1)[:, None]
    # an element that walks from the lower to the higher place has its inside to the left of that way: so has the first one
    # where its edge was not turned round
    normal = np.stack([-way[:, 1], way[:, 0]], axis=1) * np.where(turned[twins], -1, 1)[:, None]
    return Segments(ends, np.sum(jump * normal, axis=1), np.abs(np.sum(jump * way, axis=1)),
                    np.full(twins.size, np.inf))


def connected(ends: Array, tolerance: float) -> NDArray[np.int64]:
    """Number of the chain that each segment belongs to: segments that share an end, to the tolerance, hang together."""
    corners = np.round(ends.reshape(-1, 2) / tolerance).astype(np.int64)
    _, node = np.unique(corners, axis=0, return_inverse=True)
    node = node.ravel().reshape(-1, 2)
    parent = np.arange(node.max() + 1 if node.size else 0)

    def root(i: int) -> int:
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for a, b in node:
        parent[root(a)] = root(b)
    roots = np.array([root(a) for a, _ in node], dtype=np.int64)
    return np.unique(roots, return_inverse=True)[1].ravel()


def read_times(folder: Path, damage: float) -> Segments:
    """All edges of a run that crack, with the time at which their damage passes `damage`, s, between frames by interpolation."""
    root = ElementTree.parse(Path(folder) / "cracks.pvd").getroot()
    before: dict[tuple, tuple[float, float]] = {}  # time and damage of the frame before, by ends
    passed: dict[tuple, float] = {}
    last = None
    for entry in root.iter("DataSet"):
        t, content = float(entry.attrib["timestep"]), read_vtu(Path(folder) / entry.attrib["file"])
        if content.types.size == 0:
            previous = t
            continue
        last = content.points[content.connectivity.reshape(-1, 2)]
        keys = [tuple(row) for row in np.round(last.reshape(-1, 4), 9)]
        for key, d in zip(keys, content.cell_data["damage"]):
            t0, d0 = before.get(key, (previous, 0.0))
            if d >= damage and key not in passed:
                passed[key] = t0 + (t - t0) * (damage - d0) / max(d - d0, 1e-12) if d > d0 else t
            before[key] = (t, d)
        previous = t
    if last is None:
        return Segments(np.zeros((0, 2, 2)), np.zeros(0), np.zeros(0), np.zeros(0))
    times = np.array([passed.get(key, np.inf) for key in keys])
    return Segments(last, np.asarray(content.cell_data["opening"], dtype=float),
                    np.asarray(content.cell_data["slip"], dtype=float), times)


def start_time(cracks: Segments) -> float:
    """When the first edge fails, s; edges that were open from the start have failed at 0 and do not count."""
    later = cracks.time_of_failure[(cracks.time_of_failure > 0) & np.isfinite(cracks.time_of_failure)]
    return float(later.min()) if later.size else float("nan")


class Network:
    """Edges that have failed as a graph that grows from a notch's tip: what hangs together with it, and when it was reached.

    A node is reached when a chain of failed edges leads from the tip to it: edges that fail ahead of the crack count once
    the crack has come to them. So the tip never jumps to what has nothing to do with it.
    """

    def __init__(self, cracks: Segments, tip: Array, tolerance: float) -> None:
        failed = cracks.chosen(np.isfinite(cracks.time_of_failure))
        corners = np.round(failed.ends.reshape(-1, 2) / tolerance).astype(np.int64)
        _, first, node = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        self.points = failed.ends.reshape(-1, 2)[first]
        self.edges, self.times, self.lengths = node.ravel().reshape(-1, 2), failed.time_of_failure, failed.length
        self.neighbours: list[list[int]] = [[] for _ in self.points]
        for e, (i, j) in enumerate(self.edges):
            self.neighbours[i].append(e)
            self.neighbours[j].append(e)
        self.reached = np.full(len(self.points), np.inf)
        self.way = np.full(len(self.points), np.inf)  # m, along the edges by which it was reached
        self.parent = np.full(len(self.points), -1)
        if len(self.points) == 0:
            return
        start = int(np.argmin(np.linalg.norm(self.points - np.asarray(tip), axis=1)))
        self.reached[start] = self.way[start] = 0.0
        heap, done = [(0.0, 0.0, start)], set()
        while heap:
            t, way, i = heapq.heappop(heap)
            if i in done:
                continue
            done.add(i)
            for e in self.neighbours[i]:
                j = int(self.edges[e].sum() - i)
                then = (max(t, self.times[e]), way + self.lengths[e])
                if j not in done and then < (self.reached[j], self.way[j]):
                    self.reached[j], self.way[j], self.parent[j] = *then, i
                    heapq.heappush(heap, (*then, j))

    def history(self, direction: Array = np.array([1.0, 0.0])) -> tuple[Array, Array]:
        """Times and how far, along a direction, the crack has come by then, m."""
        there = np.nonzero(np.isfinite(self.reached))[0]
        order = there[np.argsort(self.reached[there], kind="stable")]
        return self.reached[order], np.maximum.accumulate(self.points[order] @ np.asarray(direction))

    def chain(self, i: int) -> list[int]:
        """Nodes from i back to the tip."""
        found = [i]
        while self.parent[found[-1]] >= 0:
            found.append(int(self.parent[found[-1]]))
        return found

    def fork(self, arm: float) -> tuple[Array, float]:
        """Where, m, and when, s, the crack first parts into two arms that both get longer than `arm`, m; NaN: nowhere.

        The time is that at which the later of the two arms has left the fork by one edge.
        """
        there = np.isfinite(self.reached)
        children: list[list[int]] = [[] for _ in self.points]
        for i in np.nonzero(there)[0]:
            if self.parent[i] >= 0:
                children[self.parent[i]].append(int(i))
        longest = np.where(there, self.way, 0.0)  # the end furthest down the tree
        for i in sorted(np.nonzero(there)[0], key=lambda i: -self.way[i]):
            if self.parent[i] >= 0:
                longest[self.parent[i]] = max(longest[self.parent[i]], longest[i])
        forks = []
        for i in np.nonzero(there)[0]:
            arms = sorted(self.reached[j] for j in children[i] if longest[j] - self.way[i] > arm)
            if len(arms) > 1:
                forks.append((arms[1], int(i)))
        if not forks:
            return np.full(2, np.nan), float("nan")
        when, where = min(forks)
        return self.points[where], float(when)


def speeds(times: Array, reach: Array, span: float) -> tuple[Array, Array]:
    """Positions, m, and speeds, m/s, of a tip: slopes of straight lines through its way over stretches of time, `span`, s. Where
    it gets from node to node the mean over a stretch counts; a stretch that begins before the crack or ends after it has none.
    """
    if times.size < 2 or times[-1] - times[0] <= span:
        return np.zeros(0), np.zeros(0)
    found = []
    for begin in np.arange(times[0], times[-1] - span, span / 8):
        t = np.linspace(begin, begin + span, 60)
        way = reach[np.searchsorted(times, t, side="right") - 1]  # it rests between nodes
        found.append((way.mean(), np.polyfit(t - begin, way, 1)[0]))
    at, speed = np.array(found).T
    return at, speed


def angle_of(cracks: Segments, tip: Array, tolerance: float) -> float:
    """Degrees from x to the line from a notch's tip to the end of the crack that hangs together with it."""
    failed = cracks.chosen(np.isfinite(cracks.time_of_failure) & (cracks.time_of_failure > 0))
    if failed.length.size == 0:
        return float("nan")
    chain = connected(failed.ends, tolerance)
    away = np.linalg.norm(failed.ends - np.asarray(tip), axis=2)
    at_tip = np.unravel_index(np.argmin(away), away.shape)[0]
    of_crack = chain == chain[at_tip]
    far = np.unravel_index(np.argmax(np.where(of_crack[:, None], away, -1.0)), away.shape)
    end = failed.ends[far] - np.asarray(tip)
    return float(np.degrees(np.arctan2(end[1], end[0])))
