"""Workflow step: orientation of the axis alpha and the probes, as the paper's Figure 5."""
from math import cos, pi, sin, sqrt

import numpy as np

from studies.borehole.cases import AXES, CAVITY_RADIUS, PROBE_RADIUS, TURN
from studies.borehole.figures import TITLES
from studies.common import style

HALF_WIDTH = 9.0  # m


def angle_at(axes: str, x: float, y: float) -> float:
    """The deck's expression at a point, rad: its functions mean the same in Python."""
    formula = AXES[axes]
    if not isinstance(formula, str):
        return formula
    return eval(formula, {"sin": sin, "cos": cos, "sqrt": sqrt, "pi": pi, "x": x, "y": y})


line = np.linspace(-HALF_WIDTH, HALF_WIDTH, 61)
x, y = np.meshgrid(line, line)
figure, panels = style.plt.subplots(2, 2, figsize=(style.FULL_WIDTH, 6.9), sharex=True, sharey=True)
for letter, panel, axes in zip("abcd", panels.flat, AXES):
    angle = np.vectorize(angle_at)(axes, x, y)
    panel.streamplot(x, y, np.cos(angle), np.sin(angle), density=1.4, color=style.GREY, linewidth=0.7, arrowstyle="-")
    style.plan_view(panel, HALF_WIDTH)
    panel.add_patch(style.plt.Circle((0, 0), CAVITY_RADIUS, facecolor="white", edgecolor="black", zorder=3))
    panel.plot(PROBE_RADIUS * cos(TURN[axes]), PROBE_RADIUS * sin(TURN[axes]), "o", color="black", markersize=5)
    style.panel_label(panel, f"{letter}) {TITLES[axes]}")
for panel in panels[0]:
    panel.set_xlabel("")
for panel in panels[:, 1]:
    panel.set_ylabel("")
style.save(figure, snakemake.output[0])  # noqa: F821
