"""What the comparisons say: errors against steps, orders in the range where they show, energies, failures."""
from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from studies.common.results import observed_order, read_table

# The asymptotic range: above what the two tight runs differ by, below where phases have gone astray, and every frequency
# of the mesh resolved (settings `beyond` are not).
ABOVE_REFERENCE = 20.0
LARGEST_ERROR = 0.05
LEAST_SETTINGS = 2

# What a scheme is refused for, or may fail for, and why. Everything else that fails is a finding.
GOES_BACK = "takes steps back in time: cracks cannot be undone, the program refuses it"
EXPLAINED = {(scheme, problem): GOES_BACK
             for scheme in (f"verlet_{c}_{f}" for c in ("yoshida_3", "suzuki_5", "mclachlan_5")
                            for f in ("velocity", "position"))
             for problem in ("splitting", "cantilever")}


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


def in_range(runs: Iterable[Run], floor: float, most_time_step: float, t_end: float) -> list[Run]:
    """Those in the asymptotic range. most_time_step: with omega dt = 1 or so for the highest frequency, s."""
    return [run for run in runs if run.status == "done" and run.steps * most_time_step >= t_end * (1 - 1e-9)
            and ABOVE_REFERENCE * floor < run.error < LARGEST_ERROR]


def order(runs: Iterable[Run], floor: float, most_time_step: float, t_end: float) -> float:
    """Slope of log(error) against log(mean step); NaN where fewer than two settings are in the range."""
    kept = in_range(runs, floor, most_time_step, t_end)
    if len({run.steps for run in kept}) < LEAST_SETTINGS:
        return math.nan
    return observed_order([1 / run.steps for run in kept], [run.error for run in kept])


def failures(runs: dict[str, list[Run]], problem: str) -> list[dict[str, Any]]:
    """Runs that did not come to their end, with the reason this study knows or none."""
    return [{"problem": problem, "scheme": run.scheme, "setting": run.setting, "status": run.status, "message": run.message,
             "explained": EXPLAINED.get((run.scheme, problem), "")}
            for of_scheme in runs.values() for run in of_scheme if run.status != "done"]


def mechanical_energy_error(run: Run) -> float:
    """Largest energy left over against the largest of kinetic and stored energy: the gas, which has far more, apart."""
    history = read_table(run.folder / "history.csv")
    return float(np.max(np.abs(history["left_over"])) / np.max(history["kinetic"] + history["stored_material"]))


def middle(runs: list[Run]) -> Run:
    """Of the settings of a scheme the one in the middle, which the quick study has too."""
    return runs[len(runs) // 2]
