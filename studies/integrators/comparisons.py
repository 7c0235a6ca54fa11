"""The decks of `gneiss compare`: every scheme at its settings, on every problem."""
from __future__ import annotations

from math import inf

from studies.common.decks import Deck
from studies.integrators.problems import SAMPLES, Problem
from studies.integrators.schemes import SCHEMES, Scheme, applicable, representatives
from studies.integrators.theory import stability_limit

# Steps between two samples over `resolved` of the problem. What is of high order falls below the reference's error soon: the
# finest of order 8 has an error of 2e-9 on the bar, where those of the tight runs are 7e-11 and 1e-11.
REFINEMENTS = {1: (16.0, 32.0, 64.0), 2: (4.0, 8.0, 16.0), 3: (2.0, 4.0, 8.0), 4: (1.0, 2.0, 4.0), 5: (1.5, 2.2, 3.3),
               6: (2.2, 2.8, 3.5), 8: (1.0, 1.15, 1.35)}
# On what is stiff errors saturate up to shorter steps: further settings of those that are not below it by then.
FINER_WHERE_STIFF = {
    "verlet_yoshida_3_velocity": (8.0, 16.0), "verlet_yoshida_3_position": (8.0, 16.0), "newmark": (32.0, 64.0),
    "generalized_alpha": (32.0, 64.0), "hht_alpha": (32.0, 64.0), "generalized_alpha_0": (32.0, 64.0, 128.0),
    "heun_euler_2_1_2": (32.0, 64.0, 128.0), "sdirk_2_1_2": (32.0, 64.0, 128.0), "newmark_damped": (128.0, 256.0, 512.0)}
TOLERANCES = (1e-4, 1e-6, 1e-8)
TOLERANCES_OF_ORDER_2 = (1e-4, 1e-5, 1e-6)      # tighter ones take tens of thousands of steps
NEWTON = 1e-12          # force out of balance: far below the errors that are measured
HISTORY_ROWS = 200

TIGHT = {"type": "arkode", "table": "fehlberg_13_7_8"}  # an eighth of the steps of order 4
WITNESS = {"type": "cvode", "method": "adams", "iteration": "functional", "rtol": 1e-13}
# Through contact the two are multistep schemes: these find the instants at which forces have kinks. Fixed steps do not, and
# steps of high order pass over them (energy left over: 1e-11 against 4e-4).
WITNESS_THROUGH_CONTACT = {"type": "ida", "rtol": 1e-10}
WITH_NEWTON = ("newmark", "generalized_alpha", "hht_alpha", "bathe")


def solved_tightly(keys: Deck, explicit: bool) -> Deck:
    """The keys, and Newton's method to far less than the errors that are measured: of ARKODE's fixed steps rtol says how far."""
    if keys["type"] in WITH_NEWTON:
        return keys | {"tolerance": NEWTON}
    return keys | {"rtol": NEWTON} if keys["type"] == "arkode" and not explicit else keys


def limited(scheme: Scheme) -> bool:
    """Whether its steps have to resolve the highest frequency of the mesh."""
    return scheme.explicit or (scheme.setting == "dt" and stability_limit(scheme.integrator, False) < inf)


def resolved_steps(problem: Problem, scheme: Scheme) -> tuple[int, ...]:
    """Numbers of equal steps between two samples, ascending."""
    finer = FINER_WHERE_STIFF.get(scheme.name, ()) if problem.stiff else ()
    return tuple(round(problem.resolved * factor) for factor in (*REFINEMENTS[scheme.order], *finer))


def integrator(problem: Problem, scheme: Scheme, quick: bool) -> Deck:
    """Keys of `[integrator]`, with a list of settings. The quick study has orders where they cost least."""
    keys = dict(scheme.integrator)
    if scheme.setting == "rtol":
        tolerances = TOLERANCES_OF_ORDER_2 if scheme.order == 2 else TOLERANCES
        return keys | {"rtol": list(tolerances[1:2] if quick else tolerances)}
    numbers = resolved_steps(problem, scheme)
    beyond = () if limited(scheme) else problem.beyond
    if quick:
        numbers, beyond = (numbers[1:] if problem.exact else numbers[:1]), (beyond[:1] if problem.stiff else ())
    keys["dt"] = [problem.interval / n for n in [*beyond, *numbers]]
    return solved_tightly(keys, scheme.explicit)


def deck(problem: Problem, profile: str) -> Deck:
    result = dict(problem.deck)
    result["run"] = problem.deck["run"] | {"most_energy_gained": 0.0}  # how much energy a scheme makes is a result
    result["output"] = {"history": problem.deck["run"]["t_end"] / HISTORY_ROWS, "rows": "steps"}
    tight, witness = TIGHT | {"dt": problem.interval / (8 * problem.resolved)}, WITNESS
    if not problem.smooth:
        tight, witness = WITNESS, WITNESS_THROUGH_CONTACT
    schemes = [{"name": "witness", "integrator": witness}]
    schemes += [{"name": scheme.name, "integrator": integrator(problem, scheme, profile == "quick")}
                for scheme in (SCHEMES.values() if profile == "full" or problem.exact else representatives())
                if applicable(scheme, problem.deck)]
    if problem.exact:
        schemes.insert(0, {"name": "tight", "integrator": tight})
    result["compare"] = {"samples": SAMPLES, "scheme": schemes,
                         **({"exact": problem.exact} if problem.exact else {"reference": tight})}
    return result


# --- `centre` against `mean`: one setting of each scheme, far below its limit, free vibrations over a long time ---
FLUTTER_RATIO, FLUTTER_TIME, FLUTTER_SPEED = 0.3, 30e-3, 1e-9   # Poisson's; s; m/s, so small that growth stays linear
FLUTTER_STEPS = 900     # omega dt about 0.4 for the highest frequency
FLUTTER_RTOL = 1e-7
VOLUMETRIC = ("mean", "centre")


def flutter_deck(volumetric: str, profile: str) -> Deck:
    """The square of the study locking: left and bottom edge fixed, a start without symmetry, nothing damped."""
    schemes = []
    for scheme in (SCHEMES.values() if profile == "full" else representatives()):
        if scheme.integrator["type"] == "mri":
            continue    # neither contact nor joints
        keys = dict(scheme.integrator)
        keys |= {"rtol": FLUTTER_RTOL} if scheme.setting == "rtol" else {"dt": FLUTTER_TIME / FLUTTER_STEPS}
        schemes.append({"name": scheme.name, "integrator": keys})
    return {
        "title": f"integrators: free vibration of a square, volumetric {volumetric}",
        "mesh": {"generator": "rectangle", "width": 1.0, "height": 1.0, "cells": [2, 2]},
        "solid": {"element": "compt", "plane": "strain", "volumetric": volumetric},
        "material": [{"density": 1000.0, "stress_map": "direct" if volumetric == "centre" else "conjugate",
                      "constants": {"E": 1e9, "nu": FLUTTER_RATIO}}],
        "boundary": [{"on": on, "type": "fixed"} for on in ("left", "bottom")],
        "initial": [{"velocity": [f"{FLUTTER_SPEED}*sin(7*x + 3*y)*x*y", f"{FLUTTER_SPEED}*cos(5*x - 4*y)*x*y"]}],
        "run": {"t_end": FLUTTER_TIME, "most_energy_gained": 0.0},
        "output": {"history": FLUTTER_TIME / 1000, "rows": "steps"},
        "compare": {"samples": 1, "reference": TIGHT | {"dt": FLUTTER_TIME / (2 * FLUTTER_STEPS)}, "scheme": schemes},
    }
