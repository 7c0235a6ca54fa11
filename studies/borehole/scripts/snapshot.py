"""Samples the fields of a finished run.

usage: snapshot.py FOLDER OUT.npz

OUT.npz holds the velocity at SNAPSHOT_TIME on a regular grid, shape (y, x, 2), as it is (`velocity`) and as seen by one
who has turned with the axes (`turned_back`), m/s, the grid's coordinates (`axis`), m, a digest of every number in that
frame (`digest`), and how much of the mesh a turn by 45 degrees maps onto itself (`repeated_nodes`).
"""
from __future__ import annotations

import hashlib
import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from studies.borehole.cases import SNAPSHOT_TIME, TURN
from studies.common.fields import Frame, frame_path, read_frame, sample_on_grid

HALF_WIDTH = 9.0  # m
PITCH = 0.03      # m, about a sub-edge of the finest mesh
# Relative to the typical distance of nodes. Two meshes that have nothing to do with each other meet that closely in
# about one node of ten thousand.
MEETING = 0.01
TIME_TOLERANCE = 1e-9  # s; the program ends a step at every output time


def rotation(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def digest(frame: Frame) -> str:
    found = hashlib.sha256()
    for arrays in (frame.point_data, frame.cell_data):
        for name in sorted(arrays):
            found.update(name.encode() + arrays[name].tobytes())
    return found.hexdigest()


def share_of_nodes_repeated(points: np.ndarray) -> float:
    """Part of the nodes that another node meets when the mesh is turned by 45 degrees about the borehole."""
    spacing = np.sqrt(np.ptp(points[:, 0]) * np.ptp(points[:, 1]) / len(points))
    points = points[np.hypot(*points.T) < 0.99 * np.max(points)]  # a disc: the square itself does not turn into itself
    distance, _ = cKDTree(points).query(points @ rotation(np.pi / 4).T, distance_upper_bound=MEETING * spacing)
    return float(np.mean(np.isfinite(distance)))


def main(folder: Path, out: Path) -> None:
    frame = read_frame(frame_path(folder, SNAPSHOT_TIME, TIME_TOLERANCE))
    axis = np.linspace(-HALF_WIDTH, HALF_WIDTH, round(2 * HALF_WIDTH / PITCH) + 1)
    velocity = frame.point_data["velocity"][:, :2]
    turn = next(TURN[part] for part in folder.name.split("-") if part in TURN)
    sampled = [sample_on_grid(frame.points @ back.T, frame.triangles, velocity @ back.T, axis, axis).astype(np.float32)
               for back in map(rotation, [0.0, -turn] if turn else [0.0])]
    np.savez_compressed(out, axis=axis, velocity=sampled[0], turned_back=sampled[-1], digest=digest(frame),
                        repeated_nodes=share_of_nodes_repeated(frame.points))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
