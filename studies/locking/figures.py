"""What the figures of the study share: names in words, colours and marks of elements and meshes."""
from __future__ import annotations

from studies.common import style

ELEMENT_NAMES = {"cst": "CST", "compt": "COMPT", "centre": "COMPT, centre", "p1": "P1 (deal.II)", "p2": "P2 (deal.II)",
                 "taylor_hood": "Taylor–Hood (deal.II)"}
# Peers are black or grey: colours are for our own elements, and for meshes.
ELEMENT_COLOURS = {"cst": style.RED, "compt": style.BLUE, "centre": style.ORANGE, "p1": "black", "p2": style.GREY,
                   "taylor_hood": "black"}
ELEMENT_MARKS = {"cst": "s", "compt": "o", "centre": "D", "p1": "x", "p2": "^", "taylor_hood": "v"}
ELEMENT_ORDER = ["compt", "centre", "cst", "p2", "taylor_hood"]  # of panels; P1 is CST

FAMILY_NAMES = {"uniform_right": "uniform, towards the corner", "uniform_left": "uniform, across",
                "alternating": "alternating", "crossed": "crossed", "free": "free"}
FAMILY_COLOURS = dict(zip(FAMILY_NAMES, style.CYCLE))
FAMILY_MARKS = dict(zip(FAMILY_NAMES, "osD^v"))


def sizes_and_values(levels: dict) -> tuple[list[float], list]:
    """Edges of composites, m, and what belongs to them, from a dictionary by the number along a side."""
    order = sorted(levels, key=int)
    return [1 / int(n) for n in order], [levels[n] for n in order]


def size_axis(axes, sizes: list[float], short: bool = False) -> None:
    """Element sizes, logarithmic, coarse to the left. short: every other one is named, for small panels."""
    axes.set_xscale("log", base=2)
    axes.set_xticks(sizes, ["" if short and i % 2 else f"1/{round(1 / size)}" for i, size in enumerate(sizes)])
    axes.set_xticks([], minor=True)
    axes.invert_xaxis()
    axes.set_xlabel("edge of a composite [m]")
