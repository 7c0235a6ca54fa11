"""The decks of the study, anisotropic and isotropic.

usage, from the root of the repository: python3 -m studies.blast.cases FOLDER [--quick]
writes FOLDER/anisotropic.toml and FOLDER/isotropic.toml.
"""
from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from studies.common.decks import Deck, write_deck

FOLDER = Path(__file__).parent

# Tables 2 and 3 of the paper, Pa.
GPA = 1e9
CONSTANTS = {
    "isotropic": [(6.7, 20.0, 20.0, 20.0), (5.3, 16.0, 16.0, 16.0), (8.0, 24.0, 24.0, 24.0), (6.7, 20.0, 20.0, 20.0)],
    "anisotropic": [(6.7, 20.0, 6.7, 13.3), (5.3, 16.0, 6.7, 11.3), (8.0, 24.0, 8.0, 16.0), (6.7, 20.0, 5.3, 12.7)],
}

# Assumed, see README.md.
DENSITY = 2500.0                                    # kg/m3
WIDTH, DEPTH = 120.0, 80.0                          # m
CAVITY, RADIUS = (0.0, -20.0), 2.5                  # m
INTERFACES = [(-14.0, 5.0), (-34.0, 8.0), (-56.0, 6.0)]  # m: mean height and rise of each
PULSE = {"times": [0.0, 0.5e-3, 3e-3], "values": [0.0, 1.0, 0.0]}
PRESSURE = 50e6                                     # Pa, its peak
T_END = 20e-3                                       # s: 65 m of the fastest wave
SIZES = {"full": (0.95, 0.4), "quick": (4.6, 1.5)}  # m, sides of composites far away and at the cavity


def height(interface: int, x: float) -> float:
    """m, of an interface, counted from 0 at the top: as blast.geo has it."""
    mean, rise = INTERFACES[interface]
    return mean + rise * float(np.sin(2 * np.pi * (x / WIDTH + 0.375)))


def bedding(n: int = 48) -> list:
    """Lines that the axis alpha follows: the surface, the interfaces, the bottom."""
    places = np.linspace(-WIDTH / 2, WIDTH / 2, n + 1)
    curved = [[[float(x), height(k, float(x))] for x in places] for k in range(len(INTERFACES))]
    flat = [[[-WIDTH / 2, y], [WIDTH / 2, y]] for y in (0.0, -DEPTH)]
    return [flat[0], *curved, flat[1]]


def material(kind: str, layer: int) -> Deck:
    names = ("M_v", "M_alpha", "M_beta", "M_psi")
    result: Deck = {"region": f"layer_{layer + 1}", "density": DENSITY,
                    "constants": {name: value * GPA for name, value in zip(names, CONSTANTS[kind][layer])}}
    if kind == "anisotropic":
        result["axes"] = {"bedding": bedding()}
    return result


def deck(kind: str, profile: str) -> Deck:
    """A run without cracks."""
    size, fine = SIZES[profile]
    parameters = {"width": WIDTH, "depth": DEPTH, "cavity_x": CAVITY[0], "cavity_y": CAVITY[1], "radius": RADIUS,
                  "size": size, "fine": fine}
    for k, (mean, rise) in enumerate(INTERFACES):
        parameters |= {f"depth_{k + 1}": mean, f"rise_{k + 1}": rise}
    return {
        "title": f"blast in layered rock, {kind}",
        "mesh": {"file": str(FOLDER / "blast.geo"), "parameters": parameters},
        "solid": {"element": "compt", "plane": "strain"},
        "material": [material(kind, layer) for layer in range(4)],
        "load": [{"on": "cavity", "type": "pressure", "value": PRESSURE, "amplitude": {"type": "table"} | PULSE}],
        "boundary": [{"on": "outer", "type": "absorbing"}],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": T_END},
        "output": {"fields": T_END / 20, "probes": [{"name": "ground", "at": [0.0, -0.01]},
                                                    {"name": "left", "at": [-40.0, CAVITY[1]], "about": list(CAVITY)}]},
    }


def main(arguments: list[str]) -> int:
    folders = [a for a in arguments if not a.startswith("-")]
    if len(folders) != 1 or any(a.startswith("-") and a != "--quick" for a in arguments):
        print(__doc__, file=sys.stderr)
        return 2
    Path(folders[0]).mkdir(parents=True, exist_ok=True)
    for kind in CONSTANTS:
        write_deck(deck(kind, "quick" if "--quick" in arguments else "full"), Path(folders[0]) / f"{kind}.toml",
                   "Written by studies/blast/cases.py.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
