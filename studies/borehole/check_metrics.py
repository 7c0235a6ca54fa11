"""Compares the metrics of a summary.json with what the study has to show; exit status 1 if one misses its bound.

usage: check_metrics.py SUMMARY.json
"""
from __future__ import annotations

import json
import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Union

Asked = Union[float, bool]


@dataclass(frozen=True)
class Bound:
    """What is asked of a metric: a number is an upper bound, True or False the value itself."""

    full: Asked
    quick: Asked
    why_quick: str = ""  # why the coarse study is held to something else


# The full study is held to what its description asks. The quick one has sub-edges three to four times as long, where
# errors are of order 1 to 2; its bounds are 1.2 to 2.5 times what it gives: they catch a mistake, not a change of the mesh.
COARSE = "discretisation: sub-edges of 100 mm instead of 35 and 25"
BOUNDS = {
    "rotation_peak_difference_max": Bound(0.005, 0.02, COARSE),
    "rotation_history_difference_max": Bound(2e-3, 0.02, COARSE),
    "rotation_peak_difference_max_1kPa": Bound(0.005, 0.02, COARSE),
    "rotation_history_difference_max_1kPa": Bound(2e-3, 0.02, COARSE),
    "cavity_solution_l2_max": Bound(0.02, 0.08, COARSE),
    "cavity_displacement_l2_max": Bound(0.005, 0.02, COARSE),
    "cavity_errors_fall_with_refinement": Bound(True, True),
    "anisotropic_changes_fall_with_refinement": Bound(True, True),
    "wavefront_speed_error_max": Bound(0.01, 0.015, COARSE),
    "compt_cst_difference_at_zero_Mv": Bound(1e-12, 1e-12),
    "hypo_hyper_difference_max": Bound(1e-10, 1e-10),
    "energy_balance_error_max": Bound(1e-3, 5e-3, "steps four times as long"),
    "threads_bitwise_identical": Bound(True, True),
    # No mesh with a 45 degree symmetry: a few chance meetings of nodes are no symmetry.
    "mesh_nodes_repeated_by_45_degrees": Bound(0.01, 0.01),
}


def kept(asked: Asked, measured: object) -> bool:
    """NaN, a missing value or one of another kind keeps no bound."""
    if isinstance(asked, bool):
        return measured is asked
    return isinstance(measured, (int, float)) and not isinstance(measured, bool) \
        and math.isfinite(measured) and measured <= asked


def shown(value: object) -> str:
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "missing"}[value]
    return f"{value:.3g}" if isinstance(value, (int, float)) else str(value)


def check(summary: dict) -> tuple[str, bool]:
    """The table asked/measured, and whether every bound is kept."""
    quick = summary["extent"] == "quick"
    metrics = summary["metrics"]
    lines = [f"{'metric':44} {'asked':>12} {'measured':>12}"]
    good = True
    for name, bound in BOUNDS.items():
        asked = bound.quick if quick else bound.full
        measured = metrics.get(name)
        fine = kept(asked, measured)
        good = good and fine
        wanted = shown(asked) if isinstance(asked, bool) else f"<= {shown(asked)}"
        lines.append(f"{name:44} {wanted:>12} {shown(measured):>12}{'' if fine else '   MISSED'}")
    lines += [f"{name:44} {'reported':>12} {shown(value):>12}" for name, value in metrics.items() if name not in BOUNDS]
    return "\n".join(lines), good


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    summary = json.loads(Path(arguments[0]).read_text())
    table, good = check(summary)
    print(table)
    if summary["extent"] == "quick":
        print("quick: bounds are wider than those of the full study (check_metrics.py says why)")
    print("every bound is kept" if good else "some bounds are missed")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
