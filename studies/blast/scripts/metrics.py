"""Workflow step: the metrics of the study, into summary.json. README.md defines each."""
import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from studies.blast.analysis import consistency, deep, largest_jump, last_cracks, orientation, worst_balance
from studies.blast.cases import CASES
from studies.common.bounds import write_summary
from studies.common.results import read_summary, read_table

metrics: dict[str, float] = {}
details: dict[str, dict] = {}
for name, case in CASES.items():
    folder = Path("cases") / name
    summary, cracks = read_summary(folder), last_cracks(folder)
    history = read_table(folder / "history.csv")
    energy = consistency(case, cracks, summary["energies_J"]["dissipated_fracture"])
    whole = cracks.failed
    near = whole & deep(cracks)
    of_all, of_near = (orientation(cracks.angle[which], cracks.length[which]) for which in (whole, near))
    work = history["external_work"][-1]
    details[name] = {
        "energy_balance_error_max": worst_balance(history),
        "largest_jump": dict(zip(("t_s", "of_work"), largest_jump(history))),
        "fracture_energy_consistency": abs(energy.all_ends),
        "fracture_energy": asdict(energy),
        "fracture_energy_of_files": abs(energy.files),
        "fracture_energy_by_end": energy.by_end,
        "crack_length_m": float(cracks.length[whole].sum()),
        "crack_length_near_cavity_m": float(cracks.length[near].sum()),
        "mean_orientation_deg": of_all.mean, "concentration": of_all.concentration,
        "mean_orientation_near_cavity_deg": of_near.mean, "concentration_near_cavity": of_near.concentration,
        "opening_share": float(np.sum((cracks.length * cracks.mode)[whole]) / cracks.length[whole].sum()),
        "fragments": summary["cracks"]["fragments"],
        "of_work": {key: history[key][-1] / work for key in (
            "dissipated_fracture", "dissipated_friction", "splitting", "stored_contact", "kinetic", "stored_material")},
        "steps": summary["counts"]["steps"], "elements": summary["counts"]["elements"],
        "wall_s": summary["timings"]["wall_s"],
    }


metrics["energy_balance_error_max"] = max(details[name]["energy_balance_error_max"] for name, case in CASES.items()
                                          if not case.equal_energies)
for key in ("fracture_energy_consistency", "fracture_energy_of_files", "fracture_energy_by_end"):
    metrics[key] = max(of_run[key] for of_run in details.values())
metrics["strength_excess_max"] = max(of_run["fracture_energy"]["excess"] for of_run in details.values())
metrics["sub_triangles_min"] = 4 * min(details[name]["elements"] for name, case in CASES.items() if not case.equal_energies)
metrics["splitting_of_work_max"] = max(details[name]["of_work"]["splitting"] for name, case in CASES.items()
                                       if not case.equal_energies)
for name, case in CASES.items():
    if not case.equal_energies:
        for key in ("crack_length_m", "mean_orientation_deg", "concentration", "mean_orientation_near_cavity_deg",
                    "concentration_near_cavity"):
            metrics[f"{key}/{name}"] = details[name][key]
write_summary(snakemake.output[0], {  # noqa: F821
    "study": "blast", "extent": snakemake.params.profile, "metrics": metrics, "details": details,  # noqa: F821
})
