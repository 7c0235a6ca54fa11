"""What the comparisons say: errors against steps, orders in the range where they show, energies, failures."""
from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from studies.common.results import observed_order, read_table
from studies.integrators import through_events
from studies.integrators.problems import FIRST_TOUCH, PROBLEMS
from studies.integrators.schemes import SCHEMES

# The asymptotic range: above what the two tight runs differ by, below where phases have gone astray, and every frequency
# of the mesh resolved (settings `beyond` are not).
ABOVE_REFERENCE = 20.0
LEAST_SETTINGS = 2

@dataclass(frozen=True)
class Run:
    """A row of compare.json. error: the larger of displacement and velocity, relative; NaN where the run failed."""

    scheme: str
    setting: str
    status: str
    message: str
    folder: Path
    error: float
    energy_error: float
    energy_drift: float
    steps: int
    work: int       # force evaluations
    cpu_time: float


def read_comparison(folder: Path) -> dict[str, list[Run]]:
    """Runs by scheme, in the order of the deck: reference, witness, and the schemes."""
    found: dict[str, list[Run]] = {}
    for row in json.loads((folder / "compare.json").read_text())["runs"]:
        error = max(row.get("error_displacement", math.nan), row.get("error_velocity", math.nan))
        found.setdefault(row["scheme"], []).append(
            Run(row["scheme"], row["setting"], row["status"], row.get("message", ""),
                folder / "runs" / Path(row["folder"]).name, error, row["energy_error"], row["energy_drift"], row["steps"],
                row["force_evaluations"], row["cpu_time_s"]))
    return found


def disagreement(runs: dict[str, list[Run]]) -> float:
    """Of the two tight runs, from each other or from the closed form."""
    return max(run.error for name in ("tight", "witness") for run in runs.get(name, []))


def in_range(runs: Iterable[Run], floor: float, largest: float, fewest: float) -> list[Run]:
    """Those in the asymptotic range: errors between what the tight runs differ by and the largest, at least so many steps."""
    return [run for run in runs if run.status == "done" and run.steps >= fewest
            and ABOVE_REFERENCE * floor < run.error < largest]


def order(runs: Iterable[Run], floor: float, largest: float, fewest: float) -> float:
    """Slope of log(error) against log(mean step); NaN where fewer than two settings are in the range."""
    kept = in_range(runs, floor, largest, fewest)
    if len({run.steps for run in kept}) < LEAST_SETTINGS:
        return math.nan
    return observed_order([1 / run.steps for run in kept], [run.error for run in kept])


BACK_IN_TIME = "takes steps back in time: cracks cannot be undone, the program refuses it"
KINK = ("ARKODE's Newton method takes ten iterations; where bodies first touch or a side opens forces have a kink, and a "
        "fixed step cannot be made shorter")
NO_LIMIT = "has no limit, every step grows: the discs fly apart"


def _number(pattern: str, text: str) -> float:
    found = re.search(pattern + r" = ([0-9.e+-]+)", text)
    return float(found[1]) if found else math.nan


def explanation(run: Run, problem: str) -> str:
    """Why a run was refused or failed, "" where this study does not know: that is a finding."""
    scheme = SCHEMES.get(run.scheme)
    if scheme is None or scheme.setting != "dt":
        return ""
    t, dt = _number("from t", run.message), _number("dt", run.setting)
    if problem in ("splitting", "cantilever") and run.status == "refused":
        goes_back = scheme.family == "Verlet" and scheme.integrator["composition"] != "single"
        return BACK_IN_TIME if goes_back and "back in time" in run.message else ""
    if scheme.name == "heun_euler_2_1_2" and problem == "discs" and "have come from nothing" in run.message:
        return NO_LIMIT
    if scheme.family in ("implicit Runge-Kutta", "additive Runge-Kutta") and "ARK_CONV_FAILURE" in run.message:
        impact = PROBLEMS["impact"]
        beyond = dt > impact.interval / impact.resolved
        if problem == "impact" and beyond and t <= FIRST_TOUCH <= t + dt:
            return KINK
        if problem == "cantilever" and scheme.name == "sdirk_2_1_2" and through_events.CRACKING[0] <= t <= through_events.CRACKING[1]:
            return KINK
    return ""


def failures(runs: dict[str, list[Run]], problem: str) -> list[dict[str, Any]]:
    """Runs that did not come to their end, with the reason this study knows or none."""
    return [{"problem": problem, "scheme": run.scheme, "setting": run.setting, "status": run.status, "message": run.message,
             "explained": explanation(run, problem)}
            for of_scheme in runs.values() for run in of_scheme if run.status != "done"]


def mechanical_energy_error(run: Run) -> float:
    """Largest energy left over against the largest of kinetic and stored energy: the gas, which has far more, apart."""
    history = read_table(run.folder / "history.csv")
    return float(np.max(np.abs(history["left_over"])) / np.max(history["kinetic"] + history["stored_material"]))


def middle(runs: list[Run]) -> Run:
    """Of the settings of a scheme the one in the middle, which the quick study has too."""
    return runs[len(runs) // 2]
