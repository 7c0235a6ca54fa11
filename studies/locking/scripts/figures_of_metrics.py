"""Workflow step: displacement, checkerboard, spread load and inf-sup against element size, from summary.json."""
import json
from pathlib import Path

import numpy as np

from studies.common import style
from studies.locking.figures import (ELEMENT_COLOURS, ELEMENT_MARKS, ELEMENT_NAMES, ELEMENT_ORDER, FAMILY_COLOURS, FAMILY_MARKS,
                                     FAMILY_NAMES, size_axis, sizes_and_values)

details = json.loads(Path(snakemake.input.summary).read_text())["details"]  # noqa: F821
SCALE = 1e9  # displacements in nm/N, which is mm for a force of 1 MN


def with_legend_below(n_panels: int, height: float):
    """A figure with panels side by side, and axes without lines below them: the last of the list."""
    figure, panels = style.plt.subplot_mosaic([list(range(n_panels)), ["legend"] * n_panels],
                                              figsize=(style.FULL_WIDTH, height), height_ratios=[1, 0.28 / n_panels])
    panels["legend"].axis("off")
    return figure, list(panels.values())


def displacement(plane: str, path: str) -> None:
    """As the paper's Figures 16 and 18: x and y of the corner, on the uniform mesh."""
    small, finite = (details["corner_displacement"][size][plane] for size in ("small", "finite"))
    peers = details["deal_ii"].get("corner", {}).get("corner", {}).get(plane, {})
    curves = [(element, small[element]["uniform_right"]) for element in ("cst", "compt", "centre")]
    curves += [(element, peers[element]["uniform_right"]) for element in ("p1", "p2", "taylor_hood") if element in peers]
    figure, panels = with_legend_below(2, 3.9)
    for component, panel in enumerate(panels[:2]):
        for element, levels in curves:
            sizes, values = sizes_and_values(levels)
            line = {"linestyle": "none"} if element == "p1" else {}
            panel.plot(sizes, [SCALE * value[component] for value in values], ELEMENT_MARKS[element],
                       color=ELEMENT_COLOURS[element], markersize=4, label=ELEMENT_NAMES[element],
                       **({"linestyle": "-"} | line))
        for element in ("cst", "compt"):
            sizes, values = sizes_and_values(finite[element]["uniform_right"])
            panel.plot(sizes, [SCALE * value[component] for value in values], ELEMENT_MARKS[element] + ":",
                       color=ELEMENT_COLOURS[element], markersize=6, markerfacecolor="none",
                       label=f"{ELEMENT_NAMES[element]}, 1 MN")
        size_axis(panel, sizes_and_values(small["compt"]["uniform_right"])[0])
        panel.set_ylabel(f"$u_{'xy'[component]}$ of the corner / force [nm/N]")
        style.panel_label(panel, f"{'ab'[component]}) {'xy'[component]}")
    panels[-1].legend(*panels[0].get_legend_handles_labels(), loc="center", ncols=4)
    plane_name = {"stress": "plane stress, ν = 0.5", "strain": "plane strain, ν = 0.4999"}[plane]
    figure.suptitle(f"corner force, {plane_name}, diagonals towards the corner", fontsize=9)
    style.save(figure, path)


def by_element(title: str):
    """A figure with a panel for each element, meshes as curves, and room for their legend: figure, {element: panel}, legend."""
    figure, panels = style.plt.subplots(2, 3, figsize=(style.FULL_WIDTH, 4.8), sharex=True, sharey=True)
    panels = list(panels.flat)
    panels[-1].axis("off")
    for letter, element, panel in zip("abcde", ELEMENT_ORDER, panels):
        style.panel_label(panel, f"{letter}) {ELEMENT_NAMES[element]}")
    figure.suptitle(title, fontsize=9)
    return figure, dict(zip(ELEMENT_ORDER, panels)), panels[-1]


def finish_by_element(figure, panels: dict, legend, sizes: list[float], label: str, path: str) -> None:
    size_axis(panels["cst"], sizes, short=True)
    for i, panel in enumerate(panels.values()):
        panel.set_ylabel(label if i % 3 == 0 else "")
        panel.set_xlabel("edge of a composite [m]" if i > 1 else "")
        panel.tick_params(labelbottom=i > 1)
        if not panel.lines:
            panel.text(0.5, 0.5, "deal.II is not there", ha="center", transform=panel.transAxes, color=style.GREY)
    legend.legend(*panels["cst"].get_legend_handles_labels(), loc="center")
    style.save(figure, path)


def draw_family(panel, family: str, sizes: list[float], values: list[float]) -> None:
    panel.plot(sizes, values, FAMILY_MARKS[family] + "-", color=FAMILY_COLOURS[family], markersize=4,
               label=FAMILY_NAMES[family])


def meshes(path: str) -> None:
    """x of the corner in plane strain, every mesh and element."""
    figure, panels, legend = by_element("corner force, plane strain, ν = 0.4999")
    found = details["corner_displacement"]["small"]["strain"] | \
        details["deal_ii"].get("corner", {}).get("corner", {}).get("strain", {})
    for element, panel in panels.items():
        for family, levels in found.get(element, {}).items():
            sizes, values = sizes_and_values(levels)
            draw_family(panel, family, sizes, [SCALE * value[0] for value in values])
    panels["cst"].set_ylim(bottom=0)
    finish_by_element(figure, panels, legend, sizes_and_values(found["cst"]["uniform_right"])[0], "$u_x$ / force [nm/N]", path)


def checkerboard(path: str) -> None:
    figure, (panel, below) = with_legend_below(1, 4.6)
    for element in ("cst", "compt"):
        for family, levels in details["checkerboard"][element].items():
            sizes, values = sizes_and_values(levels)
            panel.plot(sizes, [value["pressure"] for value in values], FAMILY_MARKS[family],
                       linestyle="-" if element == "compt" else "--", color=FAMILY_COLOURS[family], markersize=4,
                       markerfacecolor=FAMILY_COLOURS[family] if element == "compt" else "white",
                       label=f"{ELEMENT_NAMES[element]}, {FAMILY_NAMES[family]}")
    panel.set_yscale("log")
    size_axis(panel, sizes_and_values(details["checkerboard"]["compt"]["uniform_right"])[0])
    panel.set_ylabel("‖p − smoothed p‖ / ‖smoothed p‖")
    below.legend(*panel.get_legend_handles_labels(), loc="center", ncols=2)
    style.panel_label(panel, "oscillation of the pressure, plane strain, farther than 0.5 m from the corner")
    style.save(figure, path)


def spread_load(path: str) -> None:
    figure, panels, legend = by_element("force spread over 0.25 m of both edges, plane strain, ν = 0.4999")
    found = details["spread_load"]
    for element, panel in panels.items():
        for family, entry in found.get(element, {}).items():
            sizes, errors = sizes_and_values(entry["error"])
            draw_family(panel, family, sizes, np.abs(errors))
        panel.set_yscale("log")
    finish_by_element(figure, panels, legend, sizes_and_values(found["cst"]["uniform_right"]["error"])[0],
                      "relative error in compliance", path)


def inf_sup(path: str) -> None:
    figure, panels = with_legend_below(2, 4.0)
    for panel, element in zip(panels, ("compt", "cst")):
        for family, levels in details["inf_sup"][element].items():
            sizes, values = sizes_and_values(levels)
            panel.plot(sizes, [value["beta"] for value in values], FAMILY_MARKS[family] + "-",
                       color=FAMILY_COLOURS[family], markersize=4, label=FAMILY_NAMES[family])
        size_axis(panel, sizes_and_values(details["inf_sup"][element]["uniform_right"])[0])
        style.panel_label(panel, f"{'ab'[element == 'cst']}) {ELEMENT_NAMES[element]}")
    panels[0].set(ylabel="inf-sup constant", ylim=(0, 0.8))
    panels[1].set_yscale("log")
    figure.suptitle("smallest inf-sup constant of pressures that are controlled", fontsize=9)
    panels[-1].legend(*panels[0].get_legend_handles_labels(), loc="center", ncols=3)
    style.save(figure, path)


for plane in ("stress", "strain"):
    displacement(plane, snakemake.output[plane])  # noqa: F821
meshes(snakemake.output.meshes)  # noqa: F821
checkerboard(snakemake.output.checkerboard)  # noqa: F821
spread_load(snakemake.output.spread)  # noqa: F821
inf_sup(snakemake.output.inf_sup)  # noqa: F821
