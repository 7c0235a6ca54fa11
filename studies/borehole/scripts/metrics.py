"""Workflow step: the metrics of the study from the runs' histories, into summary.json. README.md defines each."""
import json
from pathlib import Path

import numpy as np

from studies.borehole.analysis import (Results, all_histories_difference, cavity_errors, front_speed_error,
                                       largest_filtered_difference, rotation_difference)
from studies.borehole.cases import DIRECTIONS, MATERIALS, PLANS, POISSON_RATIOS, ROTATION_PAIRS, Case, Plan
from studies.common.bounds import write_summary
from studies.common.results import find_number, observed_order, read_summary


def rotation(results: Results, cases: list[Case]) -> dict[str, dict]:
    """Every turned run against its unturned one: at the paper's probe, and the worst over the quadrant."""
    found = {}
    for case in cases:
        for unturned, turned in ROTATION_PAIRS:
            if case.axes == turned:
                reference = case.of(axes=unturned)
                quadrant = [rotation_difference(results, case, reference, d) for d in DIRECTIONS]
                found[case.name] = quadrant[0] | {
                    "quadrant_peak_difference": max(q["peak_difference"] for q in quadrant),
                    "quadrant_history_difference": max(q["history_difference"] for q in quadrant)}
    return found


def sight_of_axes(results: Results, cases: list[Case]) -> float:
    """Change of the filtered velocity when an isotropic material's axes turn and nothing else: not mesh, not probe."""
    isotropic = {case for case in cases if case.material == "isotropic"}
    pairs = [(case, case.of(axes=axes)) for case in isotropic
             for axes, other in (("horizontal", "general"), ("turned", "general_turned")) if case.axes == other]
    return max(largest_filtered_difference(results, *pair) for pair in pairs)


def worst(found: dict[str, dict], key: str) -> float:
    return max(entry[key] for entry in found.values())


def cavity(results: Results, plan: Plan) -> dict[str, dict]:
    """Errors against the closed form by Poisson's ratio and level, with the observed orders."""
    found = {}
    for nu in POISSON_RATIOS:
        by_level = {f"{level}mm": cavity_errors(results, Case("isotropic", nu, "horizontal", level))
                    for level in plan.levels}
        errors = {key: [entry[key] for entry in by_level.values()] for key in ("velocity", "displacement")}
        found[f"nu{round(100 * nu):02d}"] = {
            "levels": by_level,
            "velocity_order": observed_order(list(plan.levels), errors["velocity"]),
            "displacement_order": observed_order(list(plan.levels), errors["displacement"]),
            "falling": all(later < earlier for values in errors.values() for earlier, later in zip(values, values[1:])),
            "turned_axes": {axes: cavity_errors(results, Case("isotropic", nu, axes, plan.main))
                            for axes in ("turned", "general", "general_turned")},
        }
    return found


def fronts(results: Results, cases: list[Case]) -> dict[str, dict]:
    return {case.name: {f"{d:g}": front_speed_error(results, case, d) for d in DIRECTIONS} for case in cases}


def worst_front(found: dict[str, dict]) -> float:
    return max(abs(direction["error"]) for entry in found.values() for direction in entry.values())


def refinement_of_anisotropic(results: Results, plan: Plan) -> dict[str, dict]:
    """No closed form: the change of the filtered velocity from level to level, worst over the quadrant."""
    found = {}
    for nu in POISSON_RATIOS:
        cases = [Case("anisotropic", nu, "horizontal", level) for level in plan.levels]
        changes = [largest_filtered_difference(results, a, b) for a, b in zip(cases, cases[1:])]
        ratio = plan.levels[0] / plan.levels[1]
        found[f"nu{round(100 * nu):02d}"] = {
            "changes": dict(zip((f"{a}mm to {b}mm" for a, b in zip(plan.levels, plan.levels[1:])), changes)),
            "order": float(np.log(changes[0] / changes[1]) / np.log(ratio)),
            "falling": all(later < earlier for earlier, later in zip(changes, changes[1:]))}
    return found


def same_bits(results: Results, case: Case, reference: Case) -> bool:
    """Whether two runs wrote the same histories, byte by byte, and the same numbers into every field."""
    a, b = results.of(case), results.of(reference)
    if find_number(read_summary(a), "threads") == find_number(read_summary(b), "threads"):
        raise ValueError(f"{case.name} and {reference.name} ran with the same number of threads")
    return (all((a / name).read_bytes() == (b / name).read_bytes() for name in ("probes.csv", "history.csv"))
            and str(results.snapshot(case)["digest"]) == str(results.snapshot(reference)["digest"]))


def collect(results: Results, plan: Plan) -> dict:
    main = rotation(results, plan.main_cases())
    small = rotation(results, plan.small_load_runs())
    closed_form = cavity(results, plan)
    front = {level: fronts(results, [Case("anisotropic", nu, "horizontal", level) for nu in POISSON_RATIOS])
             for level in plan.levels}
    changes = refinement_of_anisotropic(results, plan)
    pairs = plan.comparisons()
    finest = f"{plan.levels[-1]}mm"
    at_finest = {nu: entry["levels"][finest] for nu, entry in closed_form.items()}
    summaries = {case.name: read_summary(results.of(case)) for case in plan.all_cases()}
    balance = {name: find_number(summary, "balance_error") for name, summary in summaries.items()}

    metrics = {
        "rotation_peak_difference_max": worst(main, "peak_difference"),
        "rotation_peak_difference_max_raw": worst(main, "raw_peak_difference"),
        "rotation_history_difference_max": worst(main, "history_difference"),
        "rotation_history_difference_max_raw": worst(main, "raw_history_difference"),
        "rotation_peak_difference_max_1kPa": worst(small, "peak_difference"),
        "rotation_peak_difference_max_1kPa_raw": worst(small, "raw_peak_difference"),
        "rotation_history_difference_max_1kPa": worst(small, "history_difference"),
        "rotation_history_difference_max_1kPa_raw": worst(small, "raw_history_difference"),
        "isotropic_axes_difference_max": sight_of_axes(results, plan.main_cases()),
        **({"isotropic_axes_difference_max_1kPa": sight_of_axes(results, plan.small_load_runs())}
           if any(material == "isotropic" for material, _ in plan.small_load_cases) else {}),
        "cavity_solution_l2_max": worst(at_finest, "velocity"),
        "cavity_solution_l2_max_raw": worst(at_finest, "raw_velocity"),
        "cavity_displacement_l2_max": worst(at_finest, "displacement"),
        "cavity_solution_order_min": min(entry["velocity_order"] for entry in closed_form.values()),
        "cavity_displacement_order_min": min(entry["displacement_order"] for entry in closed_form.values()),
        "cavity_errors_fall_with_refinement": all(entry["falling"] for entry in closed_form.values()),
        "anisotropic_changes_fall_with_refinement": all(entry["falling"] for entry in changes.values()),
        "wavefront_speed_error_max": worst_front(front[plan.levels[-1]]),
        "compt_cst_difference_at_zero_Mv": all_histories_difference(results, *pairs["compt_cst"]),
        "hypo_hyper_difference_max": all_histories_difference(results, *pairs["hypo_hyper"]),
        "direct_conjugate_difference": largest_filtered_difference(results, *pairs["direct_conjugate"]),
        "energy_balance_error_max": max(abs(error) for error in balance.values()),
        "threads_bitwise_identical": same_bits(results, *pairs["threads"]),
        "mesh_nodes_repeated_by_45_degrees": max(float(results.snapshot(case)["repeated_nodes"])
                                                 for case in plan.main_cases()),
    }
    details = {
        "sub_edges_mm": {"levels": plan.levels, "main": plan.main, "comparisons": plan.comparison},
        "filter_sigma_s": {f"{m} nu={nu:g}": Case(m, nu, "horizontal", plan.main).filter_sigma
                           for m in MATERIALS for nu in POISSON_RATIOS},
        "rotation": main,
        "rotation_1kPa": small,
        "cavity": closed_form,
        "wavefront": front[plan.levels[-1]],
        "wavefront_error_max": {f"{level}mm": worst_front(found) for level, found in front.items()},
        "refinement_of_anisotropic": changes,
        "energy_balance_error": balance,
    }
    return {"study": "borehole", "metrics": metrics, "details": details}


def main(folder: Path, profile: str, out: Path) -> None:
    summary = {"status": "done", "extent": profile} | collect(Results(folder), PLANS[profile])
    write_summary(out, summary)


main(Path(snakemake.params.folder), snakemake.params.profile, Path(snakemake.output[0]))  # noqa: F821
