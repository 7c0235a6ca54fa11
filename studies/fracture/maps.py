"""Speed maps with cracks over them: what is read from a frame, and how it is drawn."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from studies.common import style
from studies.common.fields import frame_path, read_frame, sample_on_grid

PIXELS = 160  # along the longer side


def speed_map(folder: Path, t: float, width: float, height: float) -> dict:
    """|v| of the frame at t on a grid over a plate, m/s; in the reference shape."""
    frame = read_frame(frame_path(folder, t, 1e-3 * t))
    pitch = max(width, height) / PIXELS
    x, y = np.arange(pitch / 2, width, pitch), np.arange(pitch / 2, height, pitch)
    values = np.linalg.norm(frame.point_data["velocity"][:, :2], axis=1)
    grid = sample_on_grid(frame.points, frame.triangles, values, x, y)
    return {"speed": np.round(np.nan_to_num(grid), 3).tolist(), "extent": [0.0, width * 1e3, 0.0, height * 1e3]}


def draw_map(panel, found: dict, segments: list, unit: str) -> None:
    values = np.array(found["speed"])
    image = panel.imshow(values, origin="lower", extent=found["extent"], cmap="viridis", vmax=np.percentile(values, 99.5))
    panel.figure.colorbar(image, ax=panel, shrink=0.7, label=f"speed [{unit}]")
    draw_cracks(panel, segments, style.RED)
    panel.grid(False)
    panel.set(xlabel="x [mm]", ylabel="y [mm]")


def draw_cracks(panel, segments: list, colour) -> None:
    from matplotlib.collections import LineCollection

    ends: NDArray = np.array(segments).reshape(-1, 2, 2) * 1e3
    panel.add_collection(LineCollection(ends, colors=colour, linewidths=1.0))
