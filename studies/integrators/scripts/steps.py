"""What a step of every scheme does to the vibrations of an assembled mesh: stability, period, damping, beside the theory.

usage: steps.py PROGRAM PROFILE OUT.json
"""
from __future__ import annotations

import json
import sys
import tempfile
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from studies.integrators.modes import (Course, Modes, elongation_and_damping, equal_steps, modes_of, principal, run,
                                       step_eigenvalues)
from studies.integrators.schemes import SCHEMES, Scheme, fixed
from studies.integrators.theory import eigenvalues, growth, stability_limit

STEPS = 16                      # of a run; the first rows give the eigenvalues to twelve digits already
BRACKET = 0.03                  # limits are looked for within this of the theory; outside it is "not found"
BISECTIONS = {"full": 5, "quick": 3}
GROWTH = 1e-9                   # of a step, counts as unstable
GROWTH_OF_PAIRS = 1e-4          # where a double eigenvalue on the unit circle parts, it is known to the root of round-off
GROWING_AT = (0.5, 1.0)         # omega dt at which tables without a limit are looked at
LARGEST = 6.0                   # omega dt of schemes without a limit
LARGEST_WITHOUT_LIMIT = 1.5     # of explicit tables that always grow
PARTS = {"full": (1.0, 0.15), "quick": (0.5,)}  # of the largest omega dt: two runs span the frequencies
TOLERANCES = {"full": (1e-4, 1e-6), "quick": (1e-4,)}
LONG = 0.02                     # s, of runs with steps of their own choice: 8 to 35 periods


def n_values(scheme: Scheme) -> int:
    """Numbers per mode that a step takes over: a third one is the acceleration that is no longer that of u."""
    return 3 if scheme.integrator["type"] in ("generalized_alpha", "hht_alpha") else 2


def limit_of(scheme: Scheme) -> float:
    return stability_limit(scheme.integrator, scheme.explicit, 4.0)


class Stability:
    """Of the highest frequency of one composite, where the program's own bound is exact."""

    def __init__(self, program: str, folder: Path) -> None:
        self.program, self.folder = program, folder
        self.modes = modes_of(program, "one composite", folder)

    def growth(self, scheme: Scheme, y: float) -> float:
        """Of a step, at omega dt = y; inf where the program refuses the step."""
        course = equal_steps(self.program, "one composite", self.modes, scheme.integrator,
                             y / float(self.modes.omega[-1]), STEPS, self.folder)
        if isinstance(course, str):
            if "critical step" not in course:
                raise RuntimeError(f"{scheme.name}: {course}")
            return inf
        return float(np.max(np.abs(step_eigenvalues(course, -1, n_values(scheme))))) - 1

    def limit(self, scheme: Scheme, theory: float, bisections: int) -> dict[str, Any]:
        least = GROWTH if scheme.integrator["type"] in ("arkode", "mri") else GROWTH_OF_PAIRS
        stable, unstable = theory * (1 - BRACKET), theory * (1 + BRACKET)
        at_stable, at_unstable = self.growth(scheme, stable), self.growth(scheme, unstable)
        if at_stable > least or at_unstable <= least:
            return {"theory": theory, "measured": None, "growth": [at_stable, at_unstable]}
        for _ in range(bisections):
            middle = 0.5 * (stable + unstable)
            found = self.growth(scheme, middle)
            if found > least:
                unstable, at_unstable = middle, found
            else:
                stable = middle
        return {"theory": theory, "measured": 0.5 * (stable + unstable), "refused": at_unstable == inf}


def stability(program: str, profile: str, folder: Path) -> dict[str, Any]:
    vibration = Stability(program, folder)
    found: dict[str, Any] = {}
    for scheme in fixed():
        theory = limit_of(scheme)
        if theory == inf:
            continue
        if theory > 0:
            found[scheme.name] = vibration.limit(scheme, theory, BISECTIONS[profile])
        else:
            found[scheme.name] = {"theory": 0.0, "growth": [
                {"y": y, "measured": vibration.growth(scheme, y), "theory": growth(scheme.integrator, y, scheme.explicit)}
                for y in GROWING_AT]}
    return found


def of_equal_steps(program: str, profile: str, scheme: Scheme, modes: Modes, folder: Path) -> list[dict[str, float]]:
    """Of every mode: omega dt, period elongation, damping ratio, as measured and by theory."""
    limit = limit_of(scheme)
    largest = LARGEST if limit == inf else LARGEST_WITHOUT_LIMIT if limit == 0 else 0.98 * limit
    points = []
    for part in PARTS[profile]:
        dt = part * largest / float(modes.omega[-1])
        course = equal_steps(program, "square", modes, scheme.integrator, dt, STEPS, folder)
        if isinstance(course, str):
            raise RuntimeError(f"{scheme.name}: {course}")
        for k, omega in enumerate(modes.omega):
            y = float(omega) * dt
            measured, theory = (principal(step_eigenvalues(course, k, n_values(scheme))),
                                principal(eigenvalues(scheme.integrator, y, scheme.explicit)))
            point = {"y": y, "difference": abs(measured - theory)}
            if abs(theory.imag) > 1e-3:
                for name, value in (("measured", measured), ("theory", theory)):
                    point[f"elongation_{name}"], point[f"damping_{name}"] = elongation_and_damping(value, y)
            points.append(point)
    return sorted(points, key=lambda point: point["y"])


def of_own_steps(course: Course, modes: Modes) -> list[dict[str, float]]:
    """The same of a long run with steps of its own choice, from the course of phase and amplitude. No theory."""
    points = []
    mean_dt = float(course.t[-1] - course.t[1]) / (course.t.size - 2)
    for k, omega in enumerate(modes.omega):
        turning = course.p[1:, k] - 1j * course.omega_q[1:, k]    # exp(-i omega t) of an exact vibration
        phase = -np.unwrap(np.angle(turning))
        rate = float(np.polyfit(course.t[1:], phase, 1)[0])
        decay = -float(np.polyfit(course.t[1:], np.log(np.abs(turning)), 1)[0])
        points.append({"y": float(omega) * mean_dt, "elongation_measured": float(omega) / rate - 1,
                       "damping_measured": decay / rate})
    return points


def main(program: str, profile: str, out: str) -> None:
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        found: dict[str, Any] = {"stability": stability(program, profile, folder), "steps": {}, "own_steps": {}}
        modes = modes_of(program, "square", folder)
        for scheme in SCHEMES.values():
            if scheme.setting == "dt":
                found["steps"][scheme.name] = of_equal_steps(program, profile, scheme, modes, folder)
                continue
            for rtol in TOLERANCES[profile]:
                course = run(program, "square", modes, scheme.integrator | {"rtol": rtol}, LONG, 1e-12, folder)
                if isinstance(course, str):
                    raise RuntimeError(f"{scheme.name}: {course}")
                found["own_steps"].setdefault(scheme.name, {})[f"{rtol:g}"] = of_own_steps(course, modes)
    Path(out).write_text(json.dumps(found) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
