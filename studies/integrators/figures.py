"""The figures of the study: errors, orders, energies, events."""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import LogNorm

from studies.common import style
from studies.common.style import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY, plt
from studies.integrators import through_events
from studies.integrators.analysis import Run
from studies.integrators.problems import PROBLEMS
from studies.integrators.schemes import SCHEMES, fixed, representatives

Compared = dict[str, dict[str, list[Run]]]

# One of each kind, told apart in figures where all of them would be a thicket.
SHOWN = dict(zip((scheme.name for scheme in representatives()), [
    (BLUE, "o", "-"), (SKY, "v", "-"), (GREEN, "s", "-"), (ORANGE, "^", "-"), (RED, "D", "-"),
    (BLUE, "o", "--"), (SKY, "v", "--"), (PURPLE, "P", "--"), (ORANGE, "^", "--"),
    (GREEN, "x", ":"), (RED, "+", ":"), (PURPLE, "*", ":"), ("#8C6D31", "h", "-")]))


def precision(compared: Compared, path: Path) -> None:
    """Error against evaluations of forces, problem by problem; all schemes in grey."""
    figure, grid = plt.subplots(2, 3, figsize=(style.FULL_WIDTH, 5.6), sharey=True)
    for axes, (name, problem) in zip(grid.flat, PROBLEMS.items()):
        for scheme, runs in compared[name].items():
            done = sorted((run.work, run.error) for run in runs if run.status == "done" and run.error > 0)
            if scheme not in SCHEMES or not done:
                continue
            work, error = zip(*done)
            if scheme in SHOWN:
                colour, marker, line = SHOWN[scheme]
                axes.loglog(work, error, line, marker=marker, ms=3.5, color=colour, label=SCHEMES[scheme].label, zorder=3)
            else:
                axes.loglog(work, error, "-", color="#D5D5D5", lw=0.6, zorder=1)
        style.panel_label(axes, problem.title)
        axes.set(ylim=(1e-11, 1))
    for axes in grid[:, 0]:
        axes.set_ylabel("error of u and v")
    for axes in [*grid[1, :2], grid[0, 2]]:
        axes.set_xlabel("evaluations of forces")
    grid[1, 2].axis("off")
    handles, labels = grid[1, 0].get_legend_handles_labels()
    grid[1, 2].legend(handles, labels, loc="center", fontsize=7, handlelength=3.5)
    style.save(figure, path)


def _part_families(axes: plt.Axes, names: list[str]) -> None:
    """A line between the rows of one family and the next."""
    for row in range(1, len(names)):
        if SCHEMES[names[row]].family != SCHEMES[names[row - 1]].family:
            axes.axhline(row - 0.5, color=GREY, lw=0.6)


def orders(summary: dict[str, Any], path: Path) -> None:
    """Observed orders, a row for each scheme of fixed steps; open through contact."""
    schemes = fixed()
    figure, axes = plt.subplots(figsize=(style.FULL_WIDTH, 8.6))
    markers = {"bar": ("o", BLUE), "borehole": ("s", ORANGE), "square": ("^", GREEN), "gas": ("D", PURPLE)}
    rows = np.arange(len(schemes))
    for row, scheme in zip(rows, schemes):
        axes.fill_betweenx([row - 0.4, row + 0.4], scheme.order - 0.15, scheme.order + 0.15, color="#DDDDDD", lw=0)
    for name, (marker, colour) in markers.items():
        values = [summary["details"]["order"][scheme.name][name] for scheme in schemes]
        axes.plot(values, rows, marker, ms=4, color=colour, alpha=0.8, label=PROBLEMS[name].title)
    through = [summary["details"]["order"][scheme.name]["impact"] for scheme in schemes]
    axes.plot(through, rows, "x", ms=5, color=RED, label="through contact (impact)")
    axes.set_yticks(rows, [scheme.label for scheme in schemes], fontsize=6.5)
    _part_families(axes, [scheme.name for scheme in schemes])
    axes.set(xlabel="observed order; grey: documented ± 0.15", ylim=(len(schemes) - 0.5, -0.5), xlim=(-0.5, 9))
    axes.legend(loc="lower right", fontsize=7)
    style.save(figure, path)


def stiff(compared: Compared, path: Path) -> None:
    """Errors against steps on the nearly incompressible square."""
    problem = PROBLEMS["square"]
    figure, axes = plt.subplots(figsize=(style.FULL_WIDTH, 3.6))
    for scheme, (colour, marker, line) in SHOWN.items():
        done = sorted((run.steps, run.error) for run in compared["square"].get(scheme, []) if run.status == "done")
        if not done:
            continue
        axes.loglog(*zip(*[(problem.deck["run"]["t_end"] / steps * 1e6, error) for steps, error in done]), line,
                    marker=marker, ms=4, color=colour, label=SCHEMES[scheme].label)
    axes.axvline(problem.interval / problem.resolved * 1e6 / 0.8, color=GREY, lw=0.8)
    axes.text(problem.interval / problem.resolved * 1e6 / 0.8 * 1.05, 2e-9, "ω Δt = 1 for the highest\nfrequency of the mesh",
              fontsize=7.5, color=GREY)
    axes.set(xlabel="mean step [µs]", ylabel="error of u and v", ylim=(1e-9, 1))
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=7)
    style.save(figure, path)


def flutter(summary: dict[str, Any], path: Path) -> None:
    """Growth of the velocity of a free vibration, `centre` and `mean`, by scheme."""
    growth = summary["details"]["growth_rate"]
    names = [name for name in SCHEMES if name in growth["centre"]]
    figure, axes = plt.subplots(figsize=(style.FULL_WIDTH, 3.9))
    place = np.arange(len(names))
    for volumetric, colour, marker in (("centre", RED, "o"), ("mean", BLUE, "s")):
        axes.plot(place, [growth[volumetric].get(name, math.nan) for name in names], marker, ms=4, color=colour,
                  label=f"volumetric {volumetric}")
    axes.axhline(growth["centre"]["reference"], color=GREY, lw=0.8, zorder=0)
    axes.set_xticks(place, [SCHEMES[name].label for name in names], rotation=90, fontsize=5.5)
    axes.set(ylabel="growth of the velocity [1/s]")
    axes.legend(loc="center left")
    style.save(figure, path)


def events(compared: Compared, summary: dict[str, Any], path: Path) -> None:
    """Instants of events against the tolerance; errors through contact against steps."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 4.6), width_ratios=(1, 1.25))
    late = summary["details"]["late"]
    kinds = {"splitting": ("opening, mesh that splits", BLUE, "o"), "touch": ("touch of two bars", ORANGE, "s"),
             "cantilever": ("opening, cantilever: from the median, reported", GREEN, "^")}
    for name, (label, colour, marker) in kinds.items():
        values = np.sort([abs(value) for value in late[name].values()])
        left.semilogy(np.arange(1, values.size + 1), np.maximum(values, 1e-8), marker, ms=3, color=colour, label=label)
    left.axhline(10, color=RED, lw=0.8)
    left.text(1, 13, "asked of splitting and touch", color=RED, fontsize=7)
    left.set(xlabel="schemes, by their error", ylabel="error of the instant/tolerance", ylim=(5e-9, 100))
    left.legend(fontsize=6.5, loc="upper left", bbox_to_anchor=(0.0, -0.16))
    for scheme, (colour, marker, line) in SHOWN.items():
        done = sorted((run.steps, run.error) for run in compared["impact"][scheme] if run.status == "done")
        right.loglog(*zip(*done), line, marker=marker, ms=3.5, color=colour, label=SCHEMES[scheme].label)
    right.set(xlabel="steps", ylabel="error of u and v, impact")
    right.legend(fontsize=6.5, loc="upper left", bbox_to_anchor=(-0.1, -0.16), ncol=2, handlelength=3)
    style.save(figure, path)


def energy(compared: Compared, path: Path) -> None:
    """Energy left over in the end, by scheme and problem; the setting in the middle."""
    problems = [*PROBLEMS, *(name for name in through_events.PROBLEMS if name != "touch")]
    names = list(SCHEMES)
    values = np.full((len(names), len(problems)), np.nan)
    for j, problem in enumerate(problems):
        for i, name in enumerate(names):
            runs = compared[problem].get(name, [])
            if runs and runs[len(runs) // 2].status == "done":
                values[i, j] = max(abs(runs[len(runs) // 2].energy_drift), 1e-16)
    figure, axes = plt.subplots(figsize=(style.FULL_WIDTH, 9.0))
    colours = plt.get_cmap("viridis").copy()
    colours.set_bad("white")
    image = axes.imshow(np.ma.masked_invalid(values), norm=LogNorm(1e-16, 1e-1), cmap=colours, aspect="auto")
    axes.grid(False)
    axes.set_xticks(range(len(problems)), problems, rotation=30, ha="right")
    axes.set_yticks(range(len(names)), [SCHEMES[name].label for name in names], fontsize=6.5)
    _part_families(axes, names)
    for i, j in np.argwhere(np.isnan(values)):
        runs = compared[problems[j]].get(names[i])
        axes.text(j, i, runs[0].status if runs else "not run", ha="center", va="center", fontsize=5.5, color=GREY)
    figure.colorbar(image, ax=axes, label="energy left over in the end/largest entry of the ledger", shrink=0.6)
    style.save(figure, path)
