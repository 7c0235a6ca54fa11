"""Workflow step: maps of the Cauchy stress sigma_xx side by side, as the paper's Figures 17, 19 and 21."""
from pathlib import Path

import numpy as np
from matplotlib.collections import PolyCollection

from studies.common import style
from studies.locking.analysis import Results
from studies.locking.cases import PLANS, SIDE_TRACTION
from studies.locking.figures import ELEMENT_NAMES

which = snakemake.wildcards.which  # noqa: F821
cases = PLANS[snakemake.params.profile].map_cases(which)  # noqa: F821
results = Results(Path("cases"), Path("crosscheck"))
unit, label = (SIDE_TRACTION, "$\\sigma_{xx}$ / traction") if which == "sides" else \
    (cases[0].force, "$\\sigma_{xx}$ / force [1/m²]")
frames = {case: results.frame(case) for case in cases}
stresses = {case: frame.cell_data["cauchy_stress"][:, 0] / unit for case, frame in frames.items()}


def limits(of):
    """One scale for CST and COMPT, that of COMPT: its middle 98 %, so that the singular corners do not claim it all."""
    low, high = np.percentile(np.concatenate([stresses[case] for case in of if case.element == "compt"]), [1, 99])
    return (low, high)


rows = [cases[i : i + 2] for i in range(0, len(cases), 2)]
figure, panels = style.plt.subplots(len(rows), 2, figsize=(style.FULL_WIDTH, 0.2 + 3.1 * len(rows)), squeeze=False,
                                    sharex=True, sharey=True)
letters = iter("abcd")
for row, axes in zip(rows, panels):
    low, high = limits(row)
    for case, panel in zip(row, axes):
        frame = frames[case]
        drawn = PolyCollection(frame.points[frame.triangles], array=np.asarray(stresses[case], dtype=float),
                               cmap=style.SPEED_MAP, edgecolors="none", antialiaseds=False)
        drawn.set_clim(low, high)
        panel.add_collection(drawn)
        panel.set_aspect("equal")
        panel.grid(False)
        panel.set(xlim=(0, 1), ylim=(0, 1), xticks=[0, 0.25, 0.5, 0.75, 1], yticks=[0, 0.25, 0.5, 0.75, 1])
        panel.set_xticklabels(["0", "", "0.5", "", "1"])
        panel.set_yticklabels(["0", "", "0.5", "", "1"])
        ratio = f", ν = {case.nu:g}" if which == "sides" else ""
        style.panel_label(panel, f"{next(letters)}) {ELEMENT_NAMES[case.element]}{ratio}")
    axes[0].set_ylabel("y [m]")
    figure.colorbar(drawn, ax=axes, label=label, extend="both", fraction=0.045, pad=0.01, aspect=30)
for panel in panels[-1]:
    panel.set_xlabel("x [m]")
title = {"stress": "corner force, plane stress", "strain": "corner force, plane strain, ν = 0.4999",
         "sides": "traction on both sides, plane strain"}[which]
figure.suptitle(f"{title}, {cases[0].n} composites along a side", fontsize=9)
style.save(figure, snakemake.output[0])  # noqa: F821
