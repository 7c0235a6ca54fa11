"""VERIFICATION 16: a crack that runs and branches. The deck is checked; its runs wait for cracks_*.vtu."""
from __future__ import annotations

from pathlib import Path

from studies.common.decks import Deck
from studies.fracture.paths import Segments, branching, start_time, tip_history, tip_speed

FOLDER = Path(__file__).parent.parent
WIDTH, HEIGHT, NOTCH = 0.1, 0.04, 0.05     # m
YOUNG, POISSON, DENSITY = 32e9, 0.2, 2450.0
TRACTION = 1e6                             # Pa, on top and bottom, from the start
RAYLEIGH = 2125.0                          # m/s
# Not in the reference: cohesion and G_II. Shear hardly matters: three times the tensile strength, ten times G_I.
STRENGTH = {"tensile": 3.08e6, "cohesion": 9.24e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 3.0, "G_II": 30.0}
SIZE = {"full": 0.5e-3, "quick": 1e-3}     # m, sub-edges; the cohesion length is G E'/f_t^2 = 10.5 mm
T_END = 80e-6


def deck(element: str, size: float, method: str) -> Deck:
    fracture: Deck = {"method": method}
    if method == "intrinsic":
        fracture["penalty"] = 50.0
    return {
        "title": f"fracture: branching, {element}, {method}",
        "mesh": {"file": str(FOLDER / "plate.geo"),
                 "parameters": {"width": WIDTH, "height": HEIGHT, "at": HEIGHT / 2, "length": NOTCH, "size": 2 * size}},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": STRENGTH}],
        "fracture": fracture,
        "crack": [{"on": "notch"}],
        "load": [{"on": on, "type": "traction", "value": [0.0, sign * TRACTION]} for on, sign in (("top", 1), ("bottom", -1))],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": T_END},
        "output": {"fields": T_END / 20},
    }


def cases(profile: str, method: str = "intrinsic") -> dict[str, Deck]:
    return {f"branching-{element}": deck(element, SIZE[profile], method) for element in ("cst", "compt")}


def measure_cracks(cracks: Segments, size: float) -> dict:
    """From the edges of the last frame and when each failed; size of the sub-edges, m."""
    times, reach = tip_history(cracks)
    where, when = branching(cracks, apart_by=3 * size, column=2 * size)
    return {"start_us": start_time(cracks) * 1e6, "branching_us": when * 1e6, "branching_mm": where * 1e3,
            "speed_over_rayleigh": tip_speed(times, reach, 5e-3) / RAYLEIGH}
