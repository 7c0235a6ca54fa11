"""Crack paths as segments of edges: from cracks_*.vtu, or from a frame of the fields whose elements have come apart."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

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


def start_time(cracks: Segments) -> float:
    """When the first edge fails, s; edges that were open from the start have failed at 0 and do not count."""
    later = cracks.time_of_failure[(cracks.time_of_failure > 0) & np.isfinite(cracks.time_of_failure)]
    return float(later.min()) if later.size else float("nan")


def tip_history(cracks: Segments, direction: Array = np.array([1.0, 0.0])) -> tuple[Array, Array]:
    """Times of failure and how far, along a direction, the crack has come by then, m."""
    failed = np.isfinite(cracks.time_of_failure)
    order = np.argsort(cracks.time_of_failure[failed], kind="stable")
    reach = np.max(cracks.ends[failed] @ np.asarray(direction), axis=1)[order]
    return cracks.time_of_failure[failed][order], np.maximum.accumulate(reach)


def tip_speed(times: Array, reach: Array, window: float) -> float:
    """Largest speed over a distance, m/s: of all stretches that long or just longer."""
    best = 0.0
    for i in range(times.size):
        j = int(np.searchsorted(reach, reach[i] + window))
        if j < times.size and times[j] > times[i]:
            best = max(best, float((reach[j] - reach[i]) / (times[j] - times[i])))
    return best


def branching(cracks: Segments, apart_by: float, column: float) -> tuple[float, float]:
    """Where along x, m, and when, s, a crack that runs along x parts into branches: the first of three columns in a row in which
    failed edges are more than `apart_by` apart along y, and the time at which the second branch enters it. NaN: it does not.
    """
    failed = cracks.chosen(np.isfinite(cracks.time_of_failure))
    x, y = failed.middle.T
    if x.size == 0:
        return float("nan"), float("nan")
    number = np.floor((x - x.min()) / column).astype(int)
    entered = []
    for k in range(number.max() + 1):
        inside = np.nonzero(number == k)[0]
        inside = inside[np.argsort(y[inside])]
        gaps = np.nonzero(np.diff(y[inside]) > apart_by)[0]
        if gaps.size == 0:
            entered.append(np.nan)
            continue
        groups = np.split(failed.time_of_failure[inside], gaps + 1)
        entered.append(float(np.sort([group.min() for group in groups])[1]))
    for k in range(len(entered) - 2):
        if np.all(np.isfinite(entered[k : k + 3])):
            return float(x.min() + k * column), entered[k]
    return float("nan"), float("nan")


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
