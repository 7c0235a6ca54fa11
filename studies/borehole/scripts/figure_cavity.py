"""Workflow step: the isotropic histories on three levels under the closed form of the cavity."""
from pathlib import Path

from studies.borehole.analysis import TIMES, Results, cavity
from studies.borehole.cases import PLANS, POISSON_RATIOS, PROBE_RADIUS, Case
from studies.common import style

plan = PLANS[snakemake.params.profile]  # noqa: F821
results = Results(Path(snakemake.params.folder))  # noqa: F821
ms = 1e3 * TIMES
figure, panels = style.plt.subplots(3, 2, figsize=(style.FULL_WIDTH, 6.6), sharex=True, sharey="row")
for (u_panel, filtered_panel, raw_panel), nu in zip(panels.T, POISSON_RATIOS):
    for level, colour in zip(plan.levels, (style.GREEN, style.ORANGE, style.BLUE)):
        case = Case("isotropic", nu, "horizontal", level)
        label = f"sub-edges of {level} mm"
        u_panel.plot(ms, 1e3 * results.displacement(case), color=colour, label=label)
        filtered_panel.plot(ms, results.filtered_velocity(case), color=colour, label=label)
        raw_panel.plot(ms, results.raw_velocity(case), color=colour, label=label, linewidth=0.6)
    exact = cavity(case)
    u_panel.plot(ms, 1e3 * exact.displacement(PROBE_RADIUS, TIMES), ":", color="black", label="closed form")
    filtered_panel.plot(ms, exact.filtered_velocity(PROBE_RADIUS, TIMES, case.filter_sigma), ":", color="black")
    raw_panel.plot(ms, exact.velocity(PROBE_RADIUS, TIMES), ":", color="black")
    raw_panel.set(xlabel="time [ms]", xlim=(0, ms[-1]))
    style.panel_label(u_panel, f"isotropic, ν = {nu:.2f}, r = {PROBE_RADIUS:g} m")
    style.panel_label(filtered_panel, f"filtered, σ = {1e3 * case.filter_sigma:.3f} ms")
    style.panel_label(raw_panel, "not filtered")
panels[0, 0].set_ylabel("radial displacement [mm]")
panels[1, 0].set_ylabel("radial speed [m/s]")
panels[2, 0].set_ylabel("radial speed [m/s]")
panels[0, 0].legend(loc="upper left")
style.save(figure, snakemake.output[0])  # noqa: F821
