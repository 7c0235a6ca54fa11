"""Schemes through contact and fracture: one setting of each, on small problems."""
from __future__ import annotations

from pathlib import Path

from studies.common.decks import Deck
from studies.integrators.comparisons import TIGHT, WITH_NEWTON
from studies.integrators.problems import impact
from studies.integrators.schemes import SCHEMES, representatives

FOLDER = Path(__file__).parent
RTOL = 1e-7
NEWTON = 1e-10          # force out of balance; contact and cracks have kinks: less is not always found

ROCK = {"density": 2500.0, "constants": {"E": 30e9, "nu": 0.2}}
SEAM = {"tensile": 4e6, "cohesion": 1e8, "friction": 0.0, "residual_friction": 0.0, "G_I": 20.0, "G_II": 60.0}
STRONG = SEAM | {"tensile": 1e9, "cohesion": 1e9, "G_I": 1e6, "G_II": 1e6}

# --- a mesh that splits: stretched evenly, every scheme is exact up to the instant of the first opening ---
STRETCHING = 10.0       # 1/s
SPLITTING_TOLERANCE = 1e-9  # s


def splitting() -> Deck:
    velocity = [f"{STRETCHING}*x", 0.0]
    return {
        "title": "integrators: a stretched mesh splits",
        "mesh": {"generator": "rectangle", "width": 0.04, "height": 0.02, "cells": [4, 2], "pattern": "crossed"},
        "solid": {"element": "compt", "plane": "strain"},
        "material": [ROCK | {"strength": SEAM}],
        "fracture": {"method": "extrinsic"},
        "initial": [{"velocity": velocity}],
        "boundary": [{"on": on, "type": "velocity", "value": velocity} for on in ("left", "right", "top", "bottom")],
        "run": {"t_end": 1.3e-5, "event_tolerance": SPLITTING_TOLERANCE},
    }


# --- a double cantilever beam that is opened ---
ARM, NOTCH, LENGTH, CELL = 10e-3, 20e-3, 50e-3, 5e-3    # m
OPENING, OPENING_TIME = 4e-4, 1.5e-4                  # m of either arm, s
BEAM_TOLERANCE = 1e-9
CRACKING = (3.6e-5, OPENING_TIME)  # s, when sides open
AT_REST = {"displacement_scale": OPENING, "velocity_scale": OPENING / OPENING_TIME}


def cantilever() -> Deck:
    amplitude = {"type": "expression", "expression": f"(t/{OPENING_TIME})^3"}
    return {
        "title": "integrators: double cantilever beam",
        "mesh": {"generator": "rectangle", "width": LENGTH, "height": 2 * ARM, "origin": [0.0, -ARM],
                 "cells": [round(LENGTH / CELL), round(2 * ARM / CELL)], "pattern": "alternating",
                 "parts": [{"name": "upper", "of": "left", "from": [0.0, CELL / 2], "to": [0.0, ARM]},
                           {"name": "lower", "of": "left", "from": [0.0, -ARM], "to": [0.0, -CELL / 2]}],
                 "lines": [{"name": "notch", "from": [0.0, 0.0], "to": [NOTCH, 0.0]},
                           {"name": "seam", "from": [NOTCH, 0.0], "to": [LENGTH, 0.0]}]},
        "solid": {"element": "compt", "plane": "stress"},
        "material": [ROCK | {"strength": STRONG}],
        "fracture": {"method": "extrinsic", "penalty": 5.0},    # softer than is usual: longer steps
        "crack": [{"on": "notch"}],
        "interface": [{"on": "seam", "strength": SEAM | {"cohesion": 12e6}}],
        "boundary": [{"on": on, "type": "displacement", "value": ["free", sign * OPENING], "amplitude": amplitude}
                     for on, sign in (("upper", 1), ("lower", -1))] + [{"on": "bottom_right", "type": "fixed"}],
        "run": {"t_end": OPENING_TIME, "event_tolerance": BEAM_TOLERANCE},
    }


# --- two discs that collide ---
DISC_SPEED, DISC_GAP = 0.5, 1e-4    # m/s of either, m


def discs() -> Deck:
    return {
        "title": "integrators: two discs collide",
        "mesh": {"file": str(FOLDER.parent / "fracture/decks/disc_pair.geo"), "parameters": {"n": 5, "gap": DISC_GAP}},
        "solid": {"element": "compt", "plane": "strain"},
        "material": [{"density": 1000.0, "constants": {"E": 1e9, "nu": 0.25}}],
        "contact": {"method": "potential", "friction": 0.0},
        "initial": [{"on": on, "velocity": [sign * DISC_SPEED, 0.0]} for on, sign in (("left", 1), ("right", -1))],
        "run": {"t_end": 3e-4},
    }


# --- two bars that collide: the instants at which they touch and part ---
TOUCH_TOLERANCE = 1e-9


def touch() -> Deck:
    result = impact().deck
    return result | {"title": "integrators: two bars touch and part",
                     "run": result["run"] | {"event_tolerance": TOUCH_TOLERANCE}}


STEPS = {"touch": 600, "splitting": 390, "cantilever": 1500, "discs": 600}    # equal ones of fixed steps, all below every limit
PROBLEMS = {"touch": touch, "splitting": splitting, "cantilever": cantilever, "discs": discs}


WITH_BOUNDS = ("touch", "splitting")    # the quick study has every scheme on these alone


def deck(name: str, profile: str) -> Deck:
    result = PROBLEMS[name]()
    t_end = result["run"]["t_end"]
    schemes = []
    for scheme in (SCHEMES.values() if profile == "full" or name in WITH_BOUNDS else representatives()):
        keys = dict(scheme.integrator)
        keys |= {"rtol": RTOL} if scheme.setting == "rtol" else {"dt": t_end / STEPS[name]}
        if keys["type"] in WITH_NEWTON:
            keys["tolerance"] = NEWTON
        if keys["type"] in ("ida", "mri") and name == "cantilever":
            keys |= AT_REST  # their own scales, the largest so far, are 0 at the start
        schemes.append({"name": scheme.name, "integrator": keys})
    result["output"] = {"history": t_end / 200, "rows": "steps"}
    result["compare"] = {"samples": 4, "reference": TIGHT | {"dt": t_end / (4 * STEPS[name])}, "scheme": schemes}
    return result
