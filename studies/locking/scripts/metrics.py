"""Workflow step: the metrics of the study from what the runs left, into summary.json. README.md defines each."""
import json
from pathlib import Path

import numpy as np

from studies.common.bounds import SKIPPED, write_summary
from studies.common.results import read_table
from studies.locking.analysis import (LAST_LEVELS, LOCKING_TABLE, REFERENCE_COMPLIANCE, TABLE_UNIT, Results, checkerboard,
                                      growth_per_halving, orders, pressure, relative_difference, stress_difference)
from studies.locking.cases import CONSTANTS, FAMILIES, PLANES, PLANS, SIDE_RATIOS, Case, M, Plan
from studies.common.spectrum import flutter, growth_rate

ORDER_FAMILIES = ["uniform_right", "uniform_left", "alternating"]  # where an order is asked of the spread load


def corner(plane: str, element: str, family: str, n: int, size: str = "small") -> Case:
    return Case("corner", plane, element, family, n, size)


def displacements(results: Results, plan: Plan) -> dict:
    """Corner displacement over force, m/N, by load size, plane, element, mesh and number of composites."""
    found: dict = {}
    for case in plan.corner_cases() + plan.centre_cases() + plan.finite_cases():
        levels = found.setdefault(case.size, {}).setdefault(case.plane, {}).setdefault(case.element, {}) \
            .setdefault(case.family, {})
        levels[str(case.n)] = results.corner(case).tolist()
    return found


def table_differences(results: Results, plan: Plan) -> dict[str, dict[str, float]]:
    """u_x of the corner against VERIFICATION 7, relative."""
    there = {case.name for case in plan.all_cases()}
    found: dict = {}
    for element, column in LOCKING_TABLE.items():
        for n, value in column.items():
            case = corner("strain", element, "uniform_right", n)
            if case.name in there:
                found.setdefault(element, {})[str(n)] = float(results.corner(case)[0] / TABLE_UNIT / value - 1)
    return found


def offsets(results: Results, plan: Plan) -> dict:
    """COMPT - CST corner displacement in plane stress, m/N, and how much it changes over the last meshes."""
    by_family = {}
    for family, levels in plan.corner.items():
        by_level = {n: results.corner(corner("stress", "compt", family, n)) -
                    results.corner(corner("stress", "cst", family, n)) for n in levels}
        last = np.array([by_level[n] for n in levels[-LAST_LEVELS:]])
        by_family[family] = {"offset": {str(n): offset.tolist() for n, offset in by_level.items()},
                             "spread": float(np.max(np.ptp(last, axis=0) / np.abs(last.mean(axis=0))))}
    return by_family


def growth(u: dict) -> dict:
    """Growth of u_x over the last halving of elements, uniform_right, relative to that of the wedge less 1."""
    found: dict = {}
    for plane in PLANES:
        exact = growth_per_halving(CONSTANTS[plane]["M_v"], M)
        for element in ("cst", "compt"):
            levels = u["small"][plane][element]["uniform_right"]
            before, last = (levels[str(n)][0] for n in sorted(map(int, levels))[-2:])
            found.setdefault(element, {})[plane] = (last - before) / exact - 1
    return found


def spread_load(results: Results, plan: Plan, peers: dict, reference: float) -> dict:
    """Errors in compliance by element and mesh, deal.II's elements too, with their orders."""
    found: dict = {}
    for case in plan.spread_cases():
        entry = found.setdefault(case.element, {}).setdefault(case.family, {"compliance": {}, "corner": {}})
        entry["compliance"][str(case.n)] = results.compliance(case)
        entry["corner"][str(case.n)] = results.corner(case).tolist()
    for element, families in peers.get("compliance", {}).items():
        for family, levels in families.items():
            found.setdefault(element, {})[family] = {"compliance": levels,
                                                     "corner": peers["corner"]["spread"]["strain"][element][family]}
    for families in found.values():
        for entry in families.values():
            entry["error"] = {n: value / reference - 1 for n, value in entry["compliance"].items()}
            entry |= orders(entry["error"])
    return found


def checkerboards(results: Results, plan: Plan) -> dict:
    """The measure of oscillation of the pressure, by element, mesh and number of composites; plane strain."""
    found: dict = {}
    for case in plan.corner_cases():
        if case.plane == "strain":
            frame = results.frame(case)
            volumetric = frame.cell_data["munjiza_stress"][:, 0]
            levels = found.setdefault(case.element, {}).setdefault(case.family, {})
            levels[str(case.n)] = {"pressure": checkerboard(frame, pressure(frame)),
                                   "volumetric": checkerboard(frame, volumetric)}
    return found


def sides(results: Results, plan: Plan) -> dict[str, float]:
    """sigma_xx of CST against that of COMPT under the load of Figure 20, by Poisson's ratio."""
    frames = {(case.nu, case.element): results.frame(case) for case in plan.sides_cases()}
    return {f"{nu:g}": stress_difference(frames[nu, "cst"], frames[nu, "compt"]) for nu in SIDE_RATIOS}


def finest(levels: dict):
    return levels[max(levels, key=int)]


def coarsest(levels: dict):
    return levels[min(levels, key=int)]


def inf_sup(plan: Plan, folder: Path) -> dict:
    found: dict = {}
    for case in plan.inf_sup_cases():
        entry = json.loads((folder / f"{case.name}.json").read_text())
        found.setdefault(case.element, {}).setdefault(case.family, {})[str(case.n)] = entry
    return found


def inf_sup_ratio(levels: dict) -> float:
    return finest(levels)["beta"] / coarsest(levels)["beta"]


def centre_and_mean(plan: Plan, spectra: Path, vibrations: Path) -> dict:
    """Flutter in the eigenvalues, the asymmetry of the stiffness, and the growth of a free vibration against the largest
    Im omega, 1/s."""
    found: dict = {"flutter": {}, "asymmetry": {}, "growth": {}}
    largest = {}
    for case in plan.spectrum_cases():
        spectrum = json.loads((spectra / f"{case.name}.json").read_text())
        for nu, entry in spectrum.items():
            omega = np.array([complex(*pair) for pair in entry["omega"]])
            for what, value in (("flutter", flutter(omega)), ("asymmetry", entry["asymmetry"])):
                found[what].setdefault(case.element, {}).setdefault(case.family, {}).setdefault(nu, {})[str(case.n)] = value
            if case.family == "uniform_right":
                largest[case.element, nu, case.n] = float(np.max(omega.imag))
    for vibration in plan.vibrations():
        history = read_table(vibrations / vibration.name / "history.csv")
        found["growth"].setdefault(vibration.element, {})[f"{vibration.nu:g}"] = {
            "measured": growth_rate(history.t[1:], history["kinetic"][1:]),
            "eigenvalues": largest[vibration.element, f"{vibration.nu:g}", vibration.n]}
    return found


def against_deal_ii(results: Results, plan: Plan) -> dict:
    """CST against P1, node by node; corner displacements and compliances of P2 and Taylor-Hood."""
    found: dict = {"p1": {}, "corner": {}, "compliance": {}}
    for case, element in plan.peers():
        peer = results.peer(case, element)
        if element == "p1":
            found["p1"][case.name] = relative_difference(results.displacement(case), peer["displacement"])
        where = found["corner"].setdefault(case.load, {}).setdefault(case.plane, {}).setdefault(element, {})
        where.setdefault(case.family, {})[str(case.n)] = (np.array(peer["probes"]["corner"]) / case.force).tolist()
        if case.load == "spread":
            levels = found["compliance"].setdefault(element, {}).setdefault(case.family, {})
            levels[str(case.n)] = peer["compliance"] / case.force**2
    return found


def collect(results: Results, plan: Plan, folder: Path, with_deal_ii: bool) -> dict:
    u = displacements(results, plan)
    table = table_differences(results, plan)
    offset = offsets(results, plan)
    boards = checkerboards(results, plan)
    beta = inf_sup(plan, folder / "inf_sup")
    unstable = centre_and_mean(plan, folder / "spectra", folder / "vibrations")
    pairs = {a.name: relative_difference(results.displacement(a), results.displacement(b))
             for a, b in plan.relaxation_pairs()}
    skipped = []
    peers, reference = {}, {"stored": REFERENCE_COMPLIANCE}
    if with_deal_ii:
        peers = against_deal_ii(results, plan)
        force = Case("spread", "strain", "compt", "free", 0).force
        for k in plan.reference:
            found = json.loads((folder / f"crosscheck/reference-{k}.json").read_text())
            reference[f"refined {k} times"] = found["compliance"] / force**2
        reference["used"] = reference[f"refined {plan.reference[-1]} times"]
    else:
        skipped.append("deal.II is not there: no comparison of CST with P1, no P2 and Taylor-Hood elements; the spread "
                       "load is compared with the stored reference")
        reference["used"] = REFERENCE_COMPLIANCE
    spread = spread_load(results, plan, peers, reference["used"])
    last = str(plan.spread[-1])
    cst_board, compt_board = (finest(boards[element]["uniform_right"])["pressure"] for element in ("cst", "compt"))
    ratio_of = {family: finest(boards["compt"][family])["pressure"] / finest(boards["cst"][family])["pressure"]
                for family in FAMILIES}
    strain = u["small"]["strain"]
    grown = growth(u)
    squeezed = sides(results, plan)
    growth_of = unstable["growth"]

    metrics = {
        "cst_dealii_p1_difference_max": max(peers["p1"].values()) if with_deal_ii else SKIPPED,
        "locking_table_difference_max": max(abs(d) for column in table.values() for d in column.values()),
        "reference_difference": abs(REFERENCE_COMPLIANCE / reference["used"] - 1) if with_deal_ii else SKIPPED,
        "compt_traction_error_finest": max(abs(spread["compt"][f]["error"][last]) for f in ORDER_FAMILIES),
        "compt_traction_order": min(spread["compt"][f]["order"] for f in ORDER_FAMILIES),
        **{f"compt_traction_order_{f}": spread["compt"][f]["order"] for f in ORDER_FAMILIES},
        "cst_traction_error_finest": max((spread["cst"][f]["error"][last] for f in ORDER_FAMILIES), key=abs),
        **{f"cst_traction_error_finest_{f}": spread["cst"][f]["error"][last] for f in ORDER_FAMILIES},
        **{f"{element}_traction_error_finest": max((finest(spread[element][f]["error"]) for f in ORDER_FAMILIES), key=abs)
           if element in spread else SKIPPED for element in ("centre", "p2", "taylor_hood")},
        **{f"traction_corner_displacement_{e}_finest": spread[e]["uniform_right"]["corner"][last][0]
           for e in ("compt", "cst")},
        "plane_stress_offset_spread": offset["uniform_right"]["spread"],
        **{f"{element}_corner_growth_difference_max": max(map(abs, grown[element].values()))
           for element in ("compt", "cst")},
        "cst_locking_ratio_coarsest": coarsest(strain["cst"]["uniform_right"])[0]
        / coarsest(strain["compt"]["uniform_right"])[0],
        "checkerboard_cst": cst_board,
        "checkerboard_compt": compt_board,
        "checkerboard_ratio": compt_board / cst_board,
        "checkerboard_ratio_worst_mesh": max(ratio_of.values()),
        **{f"sides_stress_difference_nu{nu}": difference for nu, difference in squeezed.items()},
        "kinsol_relaxation_difference_max": max(pairs.values()),
        "inf_sup_min_ratio": min(inf_sup_ratio(levels) for levels in beta["compt"].values()),
        "inf_sup_smallest": min(finest(levels)["beta"] for levels in beta["compt"].values()),
        "inf_sup_pressures_without_control": max(entry["n_without_control"] for levels in beta["compt"].values()
                                                 for entry in levels.values()),
        "inf_sup_min_ratio_cst": min(inf_sup_ratio(levels) for levels in beta["cst"].values()),
        **{f"{element}_asymmetry_max": max(value for by_nu in unstable["asymmetry"][element].values()
                                           for levels in by_nu.values() for value in levels.values())
           for element in ("compt", "centre")},
        **{f"compt_flutter_max_nu{nu:g}": max(max(by_nu[f"{nu:g}"].values())
                                              for by_nu in unstable["flutter"]["compt"].values()) for nu in SIDE_RATIOS},
        **{f"centre_flutter_max_{family}_nu{nu:g}": max(by_nu[f"{nu:g}"].values())
           for family, by_nu in unstable["flutter"]["centre"].items() for nu in SIDE_RATIOS},
        **{f"{element}_growth_rate_nu{nu:g}": growth_of[element][f"{nu:g}"]["measured"]
           for nu in SIDE_RATIOS for element in ("compt", "centre")},
        **{f"centre_growth_difference_nu{nu:g}": abs(growth_of["centre"][f"{nu:g}"]["measured"]
                                                     / growth_of["centre"][f"{nu:g}"]["eigenvalues"] - 1)
           for nu in SIDE_RATIOS},
        **{f"compt_growth_over_centre_nu{nu:g}": abs(growth_of["compt"][f"{nu:g}"]["measured"]
                                                     / growth_of["centre"][f"{nu:g}"]["measured"]) for nu in SIDE_RATIOS},
    }
    details = {
        "corner_displacement": u, "locking_table_difference": table, "plane_stress_offset": offset,
        "corner_growth_difference": grown, "spread_load": spread, "reference_compliance": reference, "checkerboard": boards,
        "checkerboard_ratio": ratio_of, "kinsol_relaxation_difference": pairs, "inf_sup": beta,
        "centre_and_mean": unstable, "deal_ii": peers,
    }
    return {"study": "locking", "metrics": metrics, "skipped": skipped, "details": details}


def main(folder: Path, profile: str, with_deal_ii: bool, out: Path) -> None:
    results = Results(folder / "cases", folder / "crosscheck")
    summary = {"status": "done", "extent": profile} | collect(results, PLANS[profile], folder, with_deal_ii)
    write_summary(out, summary)


main(Path("."), snakemake.params.profile, snakemake.params.with_deal_ii, Path(snakemake.output[0]))  # noqa: F821
