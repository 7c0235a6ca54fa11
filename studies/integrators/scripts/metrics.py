"""Workflow step: the metrics of the study from its comparisons and measurements, into summary.json. README.md defines each."""
import json
import math
from pathlib import Path
from typing import Any, Iterable

from scipy.optimize import brentq

import numpy as np

from studies.common.bounds import SKIPPED, write_summary
from studies.common.results import read_summary, read_table
from studies.integrators import analysis, comparisons, through_events
from studies.integrators.problems import FIRST_TOUCH, PROBLEMS, SAMPLES
from studies.integrators.schemes import SCHEMES, fixed
from studies.common.spectrum import growth_rate

COMPARISONS, MEASURED = Path("comparisons"), Path("measured")
Runs = dict[str, list[analysis.Run]]


def farthest(values: list[float], documented: int) -> float:
    """The one farthest from the documented order; NaN where one is missing."""
    return math.nan if any(map(math.isnan, values)) else max(values, key=lambda value: abs(value - documented))


def worst(values: Iterable[float]) -> float:
    """The largest in size; NaN where one is NaN, or none is there."""
    sizes = np.abs(np.array(list(values), dtype=float))
    return float(np.max(sizes)) if sizes.size else math.nan


def orders(compared: dict[str, Runs], floors: dict[str, float]) -> tuple[dict, dict]:
    """By scheme and problem, and how many settings each was taken from; also those through contact, which are reported."""
    found: dict[str, dict[str, float]] = {}
    kept: dict[str, dict[str, int]] = {}
    for scheme in SCHEMES.values():
        if scheme.order is None:
            continue
        for name, problem in PROBLEMS.items():
            fewest = 0.4 * problem.resolved * SAMPLES   # omega dt of about 2 for the highest frequency
            runs = compared[name].get(scheme.name, [])
            found.setdefault(scheme.name, {})[name] = analysis.order(runs, floors[name], problem.largest_error, fewest)
            kept.setdefault(scheme.name, {})[name] = len(analysis.in_range(runs, floors[name], problem.largest_error, fewest))
    return found, kept


def exact_instant() -> float:
    """Of the splitting mesh, s: ln(s)/s times the P-wave modulus reaches the strength, s = 1 + rate t."""
    E, nu = through_events.ROCK["constants"]["E"], through_events.ROCK["constants"]["nu"]
    level = through_events.SEAM["tensile"] / (E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)))
    return brentq(lambda t: math.log1p(through_events.STRETCHING * t) / (1 + through_events.STRETCHING * t) - level,
                  0.0, 1e-4, xtol=1e-18, rtol=1e-14)


def instants(runs: Runs, group: str, name: str) -> dict[str, float]:
    """Of an event that summary.json tells, s, by scheme."""
    return {scheme: read_summary(run.folder)[group][name] for scheme, of_scheme in runs.items() for run in of_scheme
            if run.status == "done" and scheme in SCHEMES}


def late(compared: dict[str, Runs]) -> dict[str, dict[str, float]]:
    """Instants less those of theory, over the tolerance, by event and scheme. A cantilever has none in closed form: less the
    median of all schemes, which differ by their own errors as well; so do the bars when they part."""
    found = {}
    opening, touching, beam, parting = (
        instants(compared["splitting"], "cracks", "first_opening_s"), instants(compared["touch"], "touches", "first_touch_s"),
        instants(compared["cantilever"], "cracks", "first_opening_s"),
        instants(compared["touch"], "touches", "last_parting_s"))
    closed = {"splitting": exact_instant(), "touch": FIRST_TOUCH,
              "cantilever": float(np.median(list(beam.values()))), "parting": float(np.median(list(parting.values())))}
    tolerance = {"splitting": through_events.SPLITTING_TOLERANCE, "touch": through_events.TOUCH_TOLERANCE,
                 "cantilever": through_events.BEAM_TOLERANCE, "parting": through_events.TOUCH_TOLERANCE}
    for name, at in (("splitting", opening), ("touch", touching), ("cantilever", beam), ("parting", parting)):
        found[name] = {scheme: (t - closed[name]) / tolerance[name] for scheme, t in at.items()}
    return found


def flutter(compared: dict[str, Runs]) -> dict[str, dict[str, float]]:
    """Growth of the velocity of a free vibration by volumetric form and scheme, 1/s."""
    found: dict[str, dict[str, float]] = {}
    for volumetric in comparisons.VOLUMETRIC:
        for name, of_scheme in compared[f"flutter-{volumetric}"].items():
            if of_scheme[0].status == "done":
                history = read_table(of_scheme[0].folder / "history.csv")
                found.setdefault(volumetric, {})[name] = growth_rate(history.t[1:], history["kinetic"][1:])
    return found


def restitution(runs: Runs) -> dict[str, float]:
    """Of two discs: kinetic energy in the end over that at the start, by scheme; the rest vibrates, or is lost."""
    found = {}
    for name, of_scheme in runs.items():
        if of_scheme[0].status == "done":
            history = read_table(of_scheme[0].folder / "history.csv")
            found[name] = float((history["kinetic"][-1] + history["stored_material"][-1]) / history["kinetic"][0])
    return found


def worst_wave_speed(waves: dict[str, Any], element: str, kind: str, nu: float, wavelength: float) -> float:
    """c_h/c - 1 farthest from 0 over directions and meshes, at a wavelength over h."""
    at = int(np.argmin(np.abs(np.array(waves["wavelength"]) - wavelength)))
    values = [curve[at] - 1 for mesh in waves["meshes"] if (mesh["element"], mesh["wave"], mesh["nu"]) == (element, kind, nu)
              for curve in mesh["over_wavelength"].values() if math.isfinite(curve[at])]
    return max(values, key=abs)


def collect(profile: str) -> dict[str, Any]:
    compared = {path.parent.name: analysis.read_comparison(path.parent)
                for path in sorted(COMPARISONS.glob("*/compare.json"))}
    steps = json.loads((MEASURED / "steps.json").read_text())
    waves = json.loads((MEASURED / "waves.json").read_text())
    smooth = [name for name, problem in PROBLEMS.items() if problem.smooth]
    # the quick study has one setting but on the problem with a closed form
    plain = [name for name in smooth if not PROBLEMS[name].stiff and (profile == "full" or PROBLEMS[name].exact)]
    floors = {name: analysis.disagreement(compared[name]) for name in PROBLEMS}
    order, kept = orders(compared, floors)
    failed = [entry for name, runs in compared.items() for entry in analysis.failures(runs, name)]
    instants_late = late(compared)
    growing = flutter(compared)
    tight = [run for name in ("reference", "witness") for run in compared["gas"][name]]
    energy = {name: {scheme: analysis.middle(of_scheme).energy_drift for scheme, of_scheme in compared[name].items()
                     if scheme in SCHEMES and analysis.middle(of_scheme).status == "done"} for name in PROBLEMS}

    metrics: dict[str, Any] = {
        f"observed_order_{scheme.name}": farthest([order[scheme.name][name] for name in plain], scheme.order)
        for scheme in fixed() if scheme.integrator["type"] != "mri"}
    metrics |= {f"observed_order_{name}": farthest([order[name][problem] for problem in plain], scheme.order)
                for name, scheme in SCHEMES.items() if scheme.setting == "rtol" and scheme.order}
    stiff = {scheme.name: order[scheme.name]["square"] for scheme in fixed()}
    metrics |= {f"stiff_order_{name}": value for name, value in stiff.items()}
    metrics["stiff_order_error_max"] = max((abs(value - SCHEMES[name].order) for name, value in stiff.items()
                                            if math.isfinite(value)), default=SKIPPED)
    metrics |= {f"contact_order_{scheme.name}": order[scheme.name]["impact"] for scheme in fixed()}
    for name, entry in steps["stability"].items():
        if entry["theory"] > 0:
            metrics[f"stability_limit_{name}"] = entry["measured"]
        else:
            metrics[f"growth_error_{name}"] = worst(point["measured"] / point["theory"] - 1 for point in entry["growth"])
    limits = [entry for entry in steps["stability"].values() if entry["theory"] > 0]
    metrics |= {
        "stability_limit_error_max": worst(entry["measured"] / entry["theory"] - 1 if entry["measured"] else math.nan
                                           for entry in limits),
        "step_eigenvalue_difference_max": worst(point["difference"] for points in steps["steps"].values()
                                                for point in points),
        "reference_self_agreement": worst(floors[name] for name in smooth),
        "reference_self_agreement_impact": floors["impact"],
        "gas_cavity_energy_error": worst(analysis.mechanical_energy_error(run) for run in tight),
        "event_time_error_max": worst(value for name in ("splitting", "touch") for value in instants_late[name].values()),
        "event_time_spread_cantilever": float(np.ptp(list(instants_late["cantilever"].values()))),
        "event_time_spread_parting": float(np.ptp(list(instants_late["parting"].values()))),
        "runs_failed_unexplained": sum(not entry["explained"] for entry in failed),
        "runs_failed_explained": sum(bool(entry["explained"]) for entry in failed),
        "centre_growth_rate_min": min(growing["centre"].values()),
        "centre_growth_rate_reference": growing["centre"]["reference"],
        # explicit tables without a limit grow by themselves
        "mean_growth_over_centre_max": np.max([rate for name, rate in growing["mean"].items()
                                           if f"growth_error_{name}" not in metrics]) / growing["centre"]["reference"],
        "standing_wave_difference_max": worst(entry["run"] / entry["bloch"] - 1 for entry in waves["standing"].values()),
    }
    for element in ("cst", "compt"):
        for kind in "PS":
            for nu in (0.3, 0.49):
                metrics[f"wave_speed_error_20h_{element}_{kind}_nu{nu:g}"] = \
                    worst_wave_speed(waves, element, kind, nu, 20.0)
    metrics |= {f"energy_drift_{name}_{scheme}": value for name, of_scheme in energy.items()
                for scheme, value in of_scheme.items()}
    details = {"order": order, "order_settings": kept, "floor": floors, "failed": failed, "late": instants_late,
               "growth_rate": growing, "disc_energy_kept": restitution(compared["discs"]), "stability": steps["stability"]}
    return {"study": "integrators", "status": "done", "extent": profile, "metrics": metrics, "details": details}


write_summary(snakemake.output[0], collect(snakemake.params.profile))  # noqa: F821
