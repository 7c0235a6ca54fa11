"""VERIFICATION 17: a plate struck beside its notch. The deck is checked; its runs wait for cracks_*.vtu."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common.decks import Deck
from studies.fracture.paths import Segments, angle_of, start_time

FOLDER = Path(__file__).parent.parent
SIDE, NOTCH, FROM_AXIS = 0.1, 0.05, 0.025  # m: the upper half of the plate, axis along y = 0
YOUNG, POISSON, DENSITY = 190e9, 0.3, 8000.0
VELOCITY, RISE = 16.5, 1e-6                # m/s, s
# Not in the reference: cohesion and G_II. Steel that does not fail in shear here: twice f_t, ten times G_I.
STRENGTH = {"tensile": 844e6, "cohesion": 1688e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 22.13e3, "G_II": 221.3e3}
SIZE = {"full": 0.5e-3, "quick": 1.25e-3}  # m, sub-edges; the cohesion length is G E'/f_t^2 = 6.5 mm
T_END = 90e-6


def deck(element: str, size: float, method: str) -> Deck:
    fracture: Deck = {"method": method}
    if method == "intrinsic":
        fracture["penalty"] = 50.0
    return {
        "title": f"fracture: Kalthoff and Winkler, {element}, {method}",
        "mesh": {"file": str(FOLDER / "plate.geo"),
                 "parameters": {"width": SIDE, "height": SIDE, "at": FROM_AXIS, "length": NOTCH, "size": 2 * size}},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": STRENGTH}],
        "fracture": fracture,
        "crack": [{"on": "notch"}],
        "boundary": [{"on": "bottom", "type": "displacement", "value": ["free", 0.0]},
                     {"on": "left_below", "type": "velocity", "value": [VELOCITY, "free"],
                      "amplitude": {"type": "ramp", "end": RISE}}],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": T_END},
        "output": {"fields": T_END / 20},
    }


def cases(profile: str, method: str = "intrinsic") -> dict[str, Deck]:
    return {f"kalthoff-{element}": deck(element, SIZE[profile], method) for element in ("cst", "compt")}


def measure_cracks(cracks: Segments, size: float) -> dict:
    """From the edges of the last frame and when each failed; size of the sub-edges, m."""
    return {"angle_degrees": angle_of(cracks, np.array([NOTCH, FROM_AXIS]), 0.01 * size),
            "start_us": start_time(cracks) * 1e6}
