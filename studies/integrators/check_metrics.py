"""Compares the metrics of a summary.json with what the study has to show; exit status 1 if one misses its bound.

usage: check_metrics.py SUMMARY.json
"""
from __future__ import annotations

import json
import sys
from math import inf
from pathlib import Path

from studies.common.bounds import Bound, main
from studies.integrators.schemes import fixed
from studies.integrators.theory import stability_limit

ORDER = 0.15    # of a slope over two to four settings
LIMIT = 0.01    # relative
UP_TO = 4.0     # omega dt to which limits are looked for


def bounds(quick: bool) -> dict[str, Bound]:
    found = {}
    for scheme in fixed():
        if scheme.integrator["type"] == "mri":
            continue    # only through contact
        asked = (scheme.order - ORDER, scheme.order + ORDER)
        found[f"observed_order_{scheme.name}"] = Bound(asked, asked)
    for scheme in fixed():
        limit = stability_limit(scheme.integrator, scheme.explicit, UP_TO)
        if limit == 0:
            found[f"growth_error_{scheme.name}"] = Bound(1e-3, 1e-3)
        elif limit < inf:
            asked = (limit * (1 - LIMIT), limit * (1 + LIMIT))
            found[f"stability_limit_{scheme.name}"] = Bound(asked, asked)
    return found | {
        # What is stiff keeps some of the motion in frequencies that are barely resolved. The quick study has one setting.
        "stiff_order_error_max": Bound(0.3, 0.3, may_skip=quick),
        "stability_limit_error_max": Bound(LIMIT, LIMIT),
        # eigenvalues of a step against theory; modes of the same run leave 1e-7 in each other at most
        "step_eigenvalue_difference_max": Bound(1e-5, 1e-5),
        "reference_self_agreement": Bound(1e-8, 1e-8),
        "gas_cavity_energy_error": Bound(1e-6, 1e-6),
        # over the tolerance
        "event_time_error_max": Bound(10.0, 10.0),
        "runs_failed_unexplained": Bound(0, 0),
        # the fit of one sine to a wave that is not quite one
        "standing_wave_difference_max": Bound(1e-3, 1e-3),
        "mean_growth_over_centre_max": Bound(0.05, 0.05),
    }


if __name__ == "__main__":
    coarse = len(sys.argv) == 2 and json.loads(Path(sys.argv[1]).read_text())["extent"] == "quick"
    sys.exit(main(sys.argv[1:], bounds(coarse), __doc__))
