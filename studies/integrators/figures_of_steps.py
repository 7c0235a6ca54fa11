"""The figures of what steps and meshes do to waves: stability, dispersion and dissipation, wave speeds."""
from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from studies.common import style
from studies.common.style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, plt
from studies.integrators.schemes import SCHEMES

PANELS = {  # of the dispersion figure: title and schemes
    "explicit; multirate": ["central_difference", "noh_bathe", "verlet_yoshida_3_velocity", "verlet_suzuki_5_velocity",
                                  "verlet_mclachlan_5_velocity", "mis_kw3", "mri_gark_erk33a", "mri_gark_erk45a"],
    "Newmark and Bathe": ["newmark", "newmark_linear", "newmark_damped", "generalized_alpha", "generalized_alpha_0",
                          "hht_alpha", "bathe", "bathe_0"],
    "explicit Runge-Kutta": ["heun_euler_2_1_2", "knoth_wolke_3_3", "zonneveld_5_3_4", "sayfy_aburub_6_3_4", "cash_karp_6_4_5",
                             "dormand_prince_7_4_5", "verner_8_5_6", "fehlberg_13_7_8"],
    "implicit Runge-Kutta": ["sdirk_2_1_2", "trbdf2_3_3_2", "kvaerno_4_2_3", "esdirk325l2sa_5_2_3", "cash_5_3_4",
                             "kvaerno_5_3_4", "esdirk437l2sa_7_3_4", "esdirk547l2sa_7_4_5"],
    "to a tolerance (1e-4)": ["cvode_adams", "cvode_adams_4", "cvode_bdf", "cvode_bdf_2", "ida", "arkode_explicit",
                              "arkode_implicit", "generalized_alpha_adaptive"],
}
COLOURS = [BLUE, ORANGE, GREEN, RED, PURPLE, SKY, "#8C6D31", GREY]
MESH_COLOUR = {"uniform_right": BLUE, "alternating": ORANGE, "crossed": GREEN}
LEAST = 1e-9  # what modes of the same run leave in each other
FORCES = {"central_difference": 1, "verlet_single_velocity": 1, "verlet_single_position": 1, "noh_bathe": 2,
          "verlet_yoshida_3_velocity": 3, "verlet_yoshida_3_position": 3, "verlet_suzuki_5_velocity": 5,
          "mis_kw3": 4, "mri_gark_erk33a": 4, "mri_gark_erk45a": 6,  # of the long steps
          "verlet_suzuki_5_position": 5, "verlet_mclachlan_5_velocity": 5, "verlet_mclachlan_5_position": 5}


def _points(steps: dict[str, Any], name: str, panel: str) -> list[dict[str, float]]:
    return steps["own_steps"][name]["0.0001"] if "tolerance" in panel else steps["steps"][name]


def _plain(value: float | None) -> float:
    """What is drawn: the size, nothing where it is round-off."""
    return abs(value) if value is not None and math.isfinite(value) and abs(value) > LEAST else math.nan


def dispersion(steps: dict[str, Any], path: Path) -> None:
    """Size of the period elongation, and of the damping ratio, against omega dt: lines theory, dots the program."""
    figure, grid = plt.subplots(len(PANELS), 2, figsize=(style.FULL_WIDTH, 11.0), sharex=True)
    for row, (title, names) in zip(grid, PANELS.items()):
        for name, colour in zip(names, COLOURS):
            points = _points(steps, name, title)
            y = [point["y"] for point in points]
            for axes, kind in zip(row, ("elongation", "damping")):
                measured = [_plain(point.get(f"{kind}_measured")) for point in points]
                axes.loglog(y, measured, "." if "tolerance" not in title else ".-", ms=3, lw=0.6, color=colour,
                            label=SCHEMES[name].label)
                axes.loglog(y, [_plain(point.get(f"{kind}_theory")) for point in points], "-", lw=0.9, color=colour)
        style.panel_label(row[0], f"{title}: |T/T exact − 1|")
        style.panel_label(row[1], "|damping ratio|")
        row[1].legend(fontsize=6, loc="center left", bbox_to_anchor=(1.0, 0.5), markerscale=2)
        for axes in row:
            axes.set(ylim=(LEAST, 3), xlim=(0.03, 7))
    for axes in grid[-1]:
        axes.set_xlabel("ω Δt (of the mean step, to a tolerance)")
    style.save(figure, path)


def _forces(name: str) -> int:
    """Evaluations in a step; of tables their stages, the first number of the name."""
    return FORCES.get(name) or int(re.search(r"_(\d+)_", name)[1])


def stability(steps: dict[str, Any], path: Path) -> None:
    """Measured limits on those of theory, and the step that an evaluation of forces buys."""
    found = {name: entry for name, entry in steps["stability"].items() if entry["theory"] > 0}
    names = sorted(found, key=lambda name: found[name]["theory"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 3.8), sharey=True, width_ratios=(1, 1))
    rows = np.arange(len(names))
    left.barh(rows, [found[name]["theory"] for name in names], color="#DDDDDD", label="theory")
    left.plot([found[name]["measured"] for name in names], rows, "o", ms=4, color=BLUE, label="measured")
    left.set_yticks(rows, [SCHEMES[name].label for name in names], fontsize=7)
    left.set(xlabel="limit of ω Δt")
    left.legend(loc="lower right")
    steps_of_one = [found[name]["theory"] / _forces(name) if SCHEMES[name].explicit else 0.0 for name in names]
    right.barh(rows, steps_of_one, color=ORANGE)
    right.set(xlabel="limit over evaluations of forces in a step")
    style.save(figure, path)


def wave_directions(measured: dict[str, Any], path: Path) -> None:
    """c_h/c of P and S waves over direction, Poisson's ratio 0.3."""
    figure, grid = plt.subplots(2, 3, figsize=(style.FULL_WIDTH, 5.6), subplot_kw={"projection": "polar"})
    figure.get_layout_engine().set(rect=(0, 0.09, 1, 0.91))
    direction = np.radians(measured["direction"])
    whole = np.concatenate([direction, direction + np.pi])
    for row, element in zip(grid, ("cst", "compt")):
        for axes, pattern in zip(row, MESH_COLOUR):
            for mesh in measured["meshes"]:
                if (mesh["element"], mesh["pattern"], mesh["nu"]) != (element, pattern, 0.3):
                    continue
                for wavelength, values in mesh["over_direction"].items():
                    axes.plot(whole, np.concatenate([values, values]), "-" if mesh["wave"] == "P" else "--", lw=1.1,
                              color={"4": RED, "6": ORANGE, "10": BLUE}[wavelength],
                              label=f"{mesh['wave']}, λ = {wavelength} h")
            axes.plot(np.linspace(0, 2 * np.pi, 181), np.ones(181), color=GREY, lw=0.6)
            axes.set_ylim(0.6, 1.15)
            axes.set_yticks([0.7, 0.8, 0.9, 1.0, 1.1])
            axes.tick_params(labelsize=6, pad=-2)
            axes.set_title(f"{element.upper()}, {pattern.replace('_', ' ')}", fontsize=8)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=6, fontsize=7)
    style.save(figure, path)


def wave_lengths(measured: dict[str, Any], path: Path) -> None:
    """c_h/c over h/wavelength at 22.5 degrees, both Poisson's ratios."""
    figure, grid = plt.subplots(2, 2, figsize=(style.FULL_WIDTH, 5.2), sharex=True)
    figure.get_layout_engine().set(rect=(0, 0.09, 1, 0.91))
    over = 1 / np.array(measured["wavelength"])
    for row, nu in zip(grid, (0.3, 0.49)):
        for axes, kind in zip(row, "PS"):
            for mesh in measured["meshes"]:
                if (mesh["wave"], mesh["nu"]) == (kind, nu):
                    axes.plot(over, np.array(mesh["over_wavelength"]["22.5"], dtype=float),
                              "-" if mesh["element"] == "compt" else "--", color=MESH_COLOUR[mesh["pattern"]],
                              label=f"{mesh['element'].upper()}, {mesh['pattern'].replace('_', ' ')}")
            axes.axhline(1, color=GREY, lw=0.6)
            axes.set(ylim=(0.4, 2.0 if (kind, nu) == ("S", 0.49) else 1.2))
            style.panel_label(axes, f"{kind} wave, ν = {nu:g}, 22.5° from x")
    for axes in grid[-1]:
        axes.set_xlabel("h/λ, h the sub-edge")
    for axes in grid[:, 0]:
        axes.set_ylabel("c_h/c")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, fontsize=7)
    style.save(figure, path)
