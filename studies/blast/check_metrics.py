"""Compares the metrics of a summary.json with what the study has to show; exit status 1 if one misses its bound.

usage: check_metrics.py SUMMARY.json
"""
from __future__ import annotations

import sys

from studies.common.bounds import Bound, main

BOUNDS = {
    "energy_balance_error_max": Bound(5e-3, 5e-3),
    "fracture_energy_consistency": Bound(1e-2, 1e-2),
    "fracture_energy_of_files": Bound(1e-12, 1e-12),
    "sub_triangles_min": Bound(100000, 10000, "coarse", at_least=True),
}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], BOUNDS, __doc__))
