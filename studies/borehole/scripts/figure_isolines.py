"""Workflow step: isolines of the speed, unturned over turned back, as the paper's Figures 9 and 13."""
import numpy as np
from scipy.ndimage import gaussian_filter

from studies.borehole.cases import (CAVITY_RADIUS, FILTER_FACTOR, PROBE_RADIUS, ROTATION_PAIRS, SNAPSHOT_TIME)
from studies.borehole.figures import TITLES, case_of_file, materials_title
from studies.common import style

HALF_WIDTH = 9.0  # m
LEVELS = [0.1, 0.2, 0.3, 0.4]  # m/s
SMOOTHING = FILTER_FACTOR * PROBE_RADIUS  # m: the way of the wave in the time of the histories' filter


def smoothed_speed(velocity: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Speed after a Gaussian average of the velocity over the solid alone: points in the cavity count for nothing."""
    inside = np.isfinite(velocity[..., 0])
    width = SMOOTHING / (axis[1] - axis[0])
    weight = np.maximum(gaussian_filter(inside.astype(float), width), 1e-12)
    average = [gaussian_filter(np.where(inside, velocity[..., i], 0.0), width) / weight for i in (0, 1)]
    return np.where(inside, np.hypot(*average), np.nan)


by_axes = {case_of_file(path).axes: path for path in snakemake.input.runs}  # noqa: F821
figure, panels = style.plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 4.2), sharey=True)
for letter, panel, (unturned, turned) in zip("ab", panels, ROTATION_PAIRS):
    for axes, key, look in ((unturned, "velocity", {"colors": style.RED, "linewidths": 1.6}),
                            (turned, "turned_back", {"colors": "black", "linewidths": 0.7, "linestyles": "--"})):
        data = np.load(by_axes[axes])
        panel.contour(data["axis"], data["axis"], smoothed_speed(data[key], data["axis"]), LEVELS, **look)
    style.plan_view(panel, HALF_WIDTH)
    panel.add_patch(style.plt.Circle((0, 0), CAVITY_RADIUS, fill=False, linewidth=0.8))
    style.panel_label(panel, f"{letter}) {TITLES[unturned]} and {TITLES[turned]}")
panels[1].set_ylabel("")
title = materials_title(case_of_file(snakemake.input.runs[0]))  # noqa: F821
figure.suptitle(f"{title}, t = {1e3 * SNAPSHOT_TIME:g} ms\n"
                f"speed {', '.join(f'{v:g}' for v in LEVELS)} m/s; red: unturned, dashed: turned by 45° and turned back",
                fontsize=9)
style.save(figure, snakemake.output[0])  # noqa: F821
