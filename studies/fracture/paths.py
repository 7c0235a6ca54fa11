"""Crack paths as segments of edges: from cracks_*.vtu, or from a frame of the fields whose elements have come apart."""
from __future__ import annotations

import heapq
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

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


def last_cracks(folder: Path) -> Segments:
    """Of the last frame of a run: edges with the exact time at which they failed."""
    entries = list(ElementTree.parse(Path(folder) / "cracks.pvd").getroot().iter("DataSet"))
    return read_cracks(Path(folder) / entries[-1].attrib["file"])


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
    """Edges of a run that crack, as the last frame has them, with the time at which their damage passes `damage`, s."""
    frames = []
    for entry in ElementTree.parse(Path(folder) / "cracks.pvd").getroot().iter("DataSet"):
        content = read_vtu(Path(folder) / entry.attrib["file"])
        ends = content.points[content.connectivity.reshape(-1, 2)]
        frames.append((float(entry.attrib["timestep"]), ends, content.cell_data.get("damage", np.zeros(0))))
    cracks = last_cracks(folder)
    return Segments(cracks.ends, cracks.opening, cracks.slip, passing_times(frames, damage))


def passing_times(frames: list[tuple[float, Array, Array]], damage: float) -> Array:
    """Of the edges of the last of frames (time s; ends (n, 2, 2) m; damage): when their damage passes a value, between frames
    by interpolation; infinite if it does not. Edges that a frame does not have are undamaged in it."""
    before: dict[tuple, tuple[float, float]] = {}  # time and damage where it was last seen, by ends
    passed: dict[tuple, float] = {}
    previous, keys = 0.0, []
    for t, ends, values in frames:
        keys = [tuple(row) for row in np.round(ends.reshape(-1, 4), 9)]
        for key, d in zip(keys, values):
            t0, d0 = before.get(key, (previous, 0.0))
            if d >= damage and key not in passed:
                passed[key] = t0 + (t - t0) * (damage - d0) / (d - d0) if d > d0 else t
            before[key] = (t, float(d))
        previous = t
    return np.array([passed.get(key, np.inf) for key in keys])


def start_time(cracks: Segments) -> float:
    """When the first edge fails, s; edges that were open from the start have failed at 0 and do not count."""
    later = cracks.time_of_failure[(cracks.time_of_failure > 0) & np.isfinite(cracks.time_of_failure)]
    return float(later.min()) if later.size else float("nan")


class Network:
    """Failed edges that hang together with a notch's tip, as a tree that leaves out what closes a loop last.

    Every node has the time of the edge by which the tree comes to it. That may be earlier than the time of the edge before it: edges
    fail ahead of a tip, and last bridges fail far behind it. Chains that end less than `bridge` (m) from each other hang together
    by what still holds there, if by nothing else.
    """

    def __init__(self, cracks: Segments, tip: Array, tolerance: float, bridge: float = 0.0) -> None:
        failed = cracks.chosen(np.isfinite(cracks.time_of_failure) & (cracks.time_of_failure > 0))  # no notches
        corners = np.round(failed.ends.reshape(-1, 2) / tolerance).astype(np.int64)
        _, first, node = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        edges, lengths = node.ravel().reshape(-1, 2), failed.length
        self.points = failed.ends.reshape(-1, 2)[first]
        self.time = np.full(len(self.points), np.inf)
        self.way = np.full(len(self.points), np.inf)  # m, along the tree
        self.parent = np.full(len(self.points), -1)
        self.in_order: list[int] = []  # parents before children
        if len(self.points) == 0:
            return
        neighbours: list[list[tuple[int, float, float, float]]] = [[] for _ in self.points]  # node, cost, length, time
        for (i, j), length, t in zip(edges, lengths, failed.time_of_failure):
            neighbours[i].append((int(j), float(t), float(length), float(t)))
            neighbours[j].append((int(i), float(t), float(length), float(t)))
        chain_of = np.zeros(len(self.points), dtype=int)
        chain_of[edges.ravel()] = np.repeat(connected(failed.ends, tolerance), 2)
        bridges = cKDTree(self.points).query_pairs(bridge) if bridge > 0 else set()
        first_time = [min(t for _, _, _, t in around) for around in neighbours]
        for i, j in bridges:
            if chain_of[i] != chain_of[j]:
                gap = float(np.linalg.norm(self.points[i] - self.points[j]))
                # dearer than every edge, the shorter the better
                neighbours[i].append((j, 1.0 + gap, gap, first_time[j]))
                neighbours[j].append((i, 1.0 + gap, gap, first_time[i]))
        start = int(np.argmin(np.linalg.norm(self.points - np.asarray(tip), axis=1)))
        heap, done = [(0.0, 0.0, start, -1, 0.0)], set()
        while heap:
            latest, way, i, parent, time = heapq.heappop(heap)
            if i in done:
                continue
            done.add(i)
            self.in_order.append(i)
            self.way[i], self.parent[i], self.time[i] = way, parent, time
            for j, cost, length, t in neighbours[i]:
                if j not in done:
                    heapq.heappush(heap, (max(latest, cost), way + length, j, i, t))

    def history(self, direction: Array = np.array([1.0, 0.0])) -> tuple[Array, Array]:
        """Times and how far, along a direction, the crack has come by then, m."""
        order = np.array(self.in_order, dtype=int)
        order = order[np.argsort(self.time[order], kind="stable")]
        return self.time[order], np.maximum.accumulate(self.points[order] @ np.asarray(direction))

    def fork(self, arm: float) -> tuple[Array, float]:
        """Where, m, and when, s, the crack first parts into two arms that both get longer than `arm`, m; NaN: nowhere.

        The time of an arm is that of the edge that fails first in twice that length; that of a fork the time of its second arm.
        """
        end = np.arange(len(self.points))  # of the longest way down the tree
        children: dict[int, list[int]] = {}
        for i in reversed(self.in_order):
            parent = int(self.parent[i])
            if parent >= 0:
                children.setdefault(parent, []).append(i)
                if self.way[end[i]] > self.way[end[parent]]:
                    end[parent] = end[i]

        def begins(fork: int, child: int) -> float:
            i, first = int(end[child]), np.inf
            while i != fork:
                if self.way[i] - self.way[fork] <= 2 * arm:  # what is nearest may fail last
                    first = min(first, self.time[i])
                i = int(self.parent[i])
            return first

        forks = []
        for i, arms in children.items():
            begun = sorted(begins(i, j) for j in arms if self.way[end[j]] - self.way[i] > arm)
            if len(begun) > 1:
                forks.append((float(begun[1]), i))
        if not forks:
            return np.full(2, np.nan), float("nan")
        when, where = min(forks)
        return self.points[where], when


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
