"""Workflow step: radial speed at the probes for the four orientations, as the paper's Figures 7, 10 and 14."""
from pathlib import Path

import numpy as np

from studies.borehole.analysis import TIMES, Results, cavity
from studies.borehole.cases import PROBE_RADIUS, ROTATION_PAIRS
from studies.borehole.figures import COLOURS, TITLES, case_of_file, materials_title
from studies.common import style

results = Results(Path(snakemake.params.folder))  # noqa: F821
cases = {case_of_file(path).axes: case_of_file(path) for path in snakemake.input.runs}  # noqa: F821
filtered = {axes: results.filtered_velocity(case) for axes, case in cases.items()}
first = cases["horizontal"]
ms = 1e3 * TIMES

figure, (top, bottom) = style.plt.subplots(2, 1, figsize=(style.FULL_WIDTH, 4.8), sharex=True, height_ratios=[3, 1])
for axes, case in cases.items():
    t, v = results.velocity(case)
    top.plot(1e3 * t, v, color=COLOURS[axes], linewidth=0.4, alpha=0.5)
dashes = {"horizontal": "-", "turned": "--", "general": "-", "general_turned": "--"}
for axes in cases:
    top.plot(ms, filtered[axes], dashes[axes], color=COLOURS[axes], label=TITLES[axes])
if first.material == "isotropic":
    exact = cavity(first).filtered_velocity(PROBE_RADIUS, TIMES, first.filter_sigma)
    top.plot(ms, exact, ":", color="black", label="closed form")
top.set(ylabel="radial speed [m/s]", xlim=(0, ms[-1]))
top.legend(title=f"filtered, σ = {1e3 * first.filter_sigma:.3f} ms", title_fontsize=8)
style.panel_label(top, f"{materials_title(first)}, r = {PROBE_RADIUS:g} m; thin lines: not filtered")
for unturned, turned in ROTATION_PAIRS:
    scale = np.max(filtered[unturned])
    bottom.plot(ms, 100 * (filtered[turned] - filtered[unturned]) / scale, color=COLOURS[turned],
                label=f"{TITLES[turned]} − {TITLES[unturned]}")
bottom.set(xlabel="time [ms]", ylabel="difference\n[% of peak]")
bottom.legend(ncol=2)
style.save(figure, snakemake.output[0])  # noqa: F821
