"""One look for the figures of all studies. Import it before the first figure is made."""
from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # files only: no display is needed

import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours, told apart with any colour vision.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
GREY = "#7F7F7F"
CYCLE = [BLUE, ORANGE, GREEN, RED, PURPLE, SKY]
SPEED_MAP = "viridis"  # uniform in lightness
FULL_WIDTH, HALF_WIDTH = 7.0, 3.4  # in, of a page and of a column

plt.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 200, "figure.constrained_layout.use": True,
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8,
    "xtick.labelsize": 8, "ytick.labelsize": 8,
    "axes.prop_cycle": plt.cycler(color=CYCLE), "lines.linewidth": 1.3,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#DDDDDD", "grid.linewidth": 0.5, "legend.frameon": False,
})


def save(figure: plt.Figure, path: Path | str) -> None:
    """Writes and closes the figure."""
    figure.savefig(path)
    plt.close(figure)


def panel_label(axes: plt.Axes, text: str, **kwargs) -> None:
    """A heading at the upper left, outside of the axes."""
    axes.set_title(text, loc="left", **kwargs)


def plan_view(axes: plt.Axes, half_width: float) -> None:
    """Equal axes in metres about the origin, without a grid."""
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set(xlim=(-half_width, half_width), ylim=(-half_width, half_width), xlabel="x [m]", ylabel="y [m]")
