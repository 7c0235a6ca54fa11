"""Workflow step: speed of the front against direction, and errors against element size, from summary.json."""
import json
from pathlib import Path

import numpy as np

from studies.borehole.analysis import FRONT_SPAN
from studies.borehole.figures import case_of_file
from studies.common import style

details = json.loads(Path(snakemake.input.summary).read_text())["details"]  # noqa: F821


def wavefront(path: str) -> None:
    figure, (top, bottom) = style.plt.subplots(2, 1, figsize=(style.HALF_WIDTH * 1.3, 4.6), sharex=True,
                                               height_ratios=[2, 1])
    for (name, directions), colour, marker in zip(details["wavefront"].items(), style.CYCLE, "os"):
        case = case_of_file(name)
        degrees = np.array([float(d) for d in directions])
        fine = np.linspace(0, 90, 91)
        span = FRONT_SPAN[1] - FRONT_SPAN[0]
        exact = [span / (case.stiffness.arrival(np.radians(d), FRONT_SPAN[1], 1.0)
                         - case.stiffness.arrival(np.radians(d), FRONT_SPAN[0], 1.0)) for d in fine]
        top.plot(fine, exact, color=colour, linewidth=0.9, label=f"exact, ν = {case.nu:.2f}")
        top.plot(degrees, [d["speed"] for d in directions.values()], marker, color=colour, markersize=4,
                 label=f"computed, {case.sub_edge_mm} mm")
        bottom.plot(degrees, [100 * d["error"] for d in directions.values()], marker + "-", color=colour, markersize=3)
    bottom.axhline(0, color="black", linewidth=0.6)
    top.set(ylabel=f"speed between {FRONT_SPAN[0]:g} and {FRONT_SPAN[1]:g} m [m/s]")
    bottom.set(xlabel="direction from axis α [°]", ylabel="error of the\ntravel time [%]", xlim=(-3, 93),
               xticks=range(0, 91, 15))
    top.legend()
    style.panel_label(top, "front of the anisotropic materials")
    style.save(figure, path)


def convergence(path: str) -> None:
    figure, (left, right) = style.plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 4.0), sharey=True)
    levels = np.array(details["sub_edges_mm"]["levels"], dtype=float)
    for (nu, entry), marker in zip(details["cavity"].items(), "os"):
        for key, label, colour in (("displacement", "displacement", style.BLUE),
                                   ("velocity", "filtered velocity", style.ORANGE),
                                   ("raw_velocity", "raw velocity", style.GREY)):
            errors = [level[key] for level in entry["levels"].values()]
            order = f", order {entry[key + '_order']:.2f}" if key + "_order" in entry else ""
            left.loglog(levels, errors, marker + "-", color=colour, markersize=4,
                        label=f"{label}, ν = 0.{nu[-2:]}{order}")
    for (nu, entry), marker in zip(details["refinement_of_anisotropic"].items(), "os"):
        right.loglog(levels[1:], list(entry["changes"].values()), marker + "-", color=style.GREEN, markersize=4,
                     label=f"filtered velocity, ν = 0.{nu[-2:]}, order {entry['order']:.2f}")
    for panel in (left, right):
        panel.set_xticks(levels, [f"{level:g}" for level in levels])
        panel.set_xticks([], minor=True)
        panel.set_xlabel("sub-edge [mm]")
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), fontsize=7)
    left.set_ylabel("relative L2 difference")
    style.panel_label(left, "a) isotropic: against the closed form")
    style.panel_label(right, "b) anisotropic: change from the coarser level")
    style.save(figure, path)


wavefront(snakemake.output.front)  # noqa: F821
convergence(snakemake.output.convergence)  # noqa: F821
