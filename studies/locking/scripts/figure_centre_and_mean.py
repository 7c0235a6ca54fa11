"""Workflow step: frequencies in the complex plane, and the kinetic energy of free vibrations, of `centre` and `mean`."""
import json
from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.results import read_table
from studies.locking.cases import PLANS, SIDE_RATIOS, VIBRATION_TIME
from studies.locking.figures import ELEMENT_COLOURS, ELEMENT_MARKS

NAMES = {"compt": "mean", "centre": "centre"}
plan = PLANS[snakemake.params.profile]  # noqa: F821
figure, panels = style.plt.subplots(2, 2, figsize=(style.FULL_WIDTH, 5.4))
for column, nu in enumerate(SIDE_RATIOS):
    top, bottom = panels[:, column]
    for case in plan.spectrum_cases():
        if case.n == plan.vibration and case.family == "uniform_right":
            pairs = np.array(json.loads(Path(f"spectra/{case.name}.json").read_text())[f"{nu:g}"]["omega"])
            above = case.element == "compt"  # all on the axis, where `centre` has most of its own
            top.plot(*(1e-3 * pairs.T), ELEMENT_MARKS[case.element], color=ELEMENT_COLOURS[case.element],
                     markersize=1.5 if above else 3, markerfacecolor=None if above else "none", zorder=4 if above else 3,
                     label=NAMES[case.element])
    if nu > 0.4:
        top.set_xscale("log")  # pressure waves are fifty times as fast as the others
    top.set(xlabel="Re ω [krad/s]", ylabel="Im ω [krad/s]" if column == 0 else "")
    style.panel_label(top, f"{'ab'[column]}) frequencies, ν = {nu:g}")
    for vibration in plan.vibrations():
        if vibration.nu == nu:
            history = read_table(Path("vibrations") / vibration.name / "history.csv")
            bottom.semilogy(1e3 * history.t, history["kinetic"] / history["kinetic"][0],
                            color=ELEMENT_COLOURS[vibration.element], linewidth=0.8, label=NAMES[vibration.element])
            if vibration.element == "centre":
                pairs = np.array(json.loads(Path(f"spectra/corner-strain-centre-uniform_right-n{vibration.n:03d}.json")
                                            .read_text())[f"{nu:g}"]["omega"])
                rate = np.max(pairs[:, 1])
                late = history.t > 0.5 * VIBRATION_TIME
                height = np.mean(np.log(history["kinetic"][late] / history["kinetic"][0]) - 2 * rate * history.t[late])
                bottom.semilogy(1e3 * history.t[late], np.exp(height + 2 * rate * history.t[late]), color="black",
                                linestyle=":", label="exp(2 max Im ω t)")
    bottom.set(xlabel="t [ms]", ylabel="kinetic energy / initial" if column == 0 else "")
    style.panel_label(bottom, f"{'cd'[column]}) free vibration, ν = {nu:g}")
    bottom.legend(loc="upper left")
    top.legend(loc="upper left")
figure.suptitle(f"COMPT, {plan.vibration} composites along a side, left and bottom fixed", fontsize=9)
style.save(figure, snakemake.output[0])  # noqa: F821
