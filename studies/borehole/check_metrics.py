"""Compares the metrics of a summary.json with what the study has to show; exit status 1 if one misses its bound.

usage: check_metrics.py SUMMARY.json
"""
from __future__ import annotations

import sys

from studies.common.bounds import Bound, main

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


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], BOUNDS, __doc__))
