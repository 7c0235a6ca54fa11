"""The cases of the study and their decks.

usage, from the root of the repository: python3 -m studies.blast.cases FOLDER [--quick]
writes a deck for each case.
"""
from __future__ import annotations

import sys
from dataclasses import dataclass
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
THICKNESS = 1.0                                     # m
WIDTH, DEPTH = 120.0, 80.0                          # m
CAVITY, RADIUS = (0.0, -20.0), 2.5                  # m
INTERFACES = [(-14.0, 5.0), (-34.0, 8.0), (-56.0, 6.0)]  # m: mean height and rise of each
PULSE = {"times": [0.0, 0.5e-3, 3e-3], "values": [0.0, 1.0, 0.0]}
PRESSURE = 40e6                                     # Pa, its peak
T_END = 16e-3                                       # s: 55 m of the fastest wave
STRENGTH = {"tensile": 4e6, "cohesion": 20e6, "friction": 0.8, "residual_friction": 0.6, "G_I": 300.0, "G_II": 1500.0}
# The same energy in every mode, and an elastic branch that is a small part of it, README.md says why.
EQUAL_ENERGIES = STRENGTH | {"cohesion": 10e6, "G_I": 2000.0, "G_II": 2000.0}
CONTACT_FRICTION = 0.6
PENALTY = 20.0

SIZES = {"full": (0.95, 0.4), "quick": (2.4, 0.9)}  # m, sides of composites far away and at the cavity
# s. One step from the start: leapfrog's ledger jumps where its step does, and it would with the first joint.
STEP = {"full": 3.5e-6, "quick": 5e-6}
# Numbers for blast.geo: angle (rad) of the first point on the cavity, algorithm of Gmsh (5 Delaunay, 6 frontal).
MESHES = {1: {"turn": 0.0, "algorithm": 5}, 2: {"turn": 0.0, "algorithm": 6}}
FRAMES = 32                                         # of the runs that are shown as pictures
HISTORY = 400                                       # rows


@dataclass(frozen=True)
class Case:
    material: str
    method: str = "extrinsic"
    mesh: int = 1
    equal_energies: bool = False  # G_I = G_II, on the coarse mesh

    @property
    def name(self) -> str:
        return (f"{self.material}-{self.method}" + (f"-mesh_{self.mesh}" if self.mesh > 1 else "")
                + ("-equal_energies" if self.equal_energies else ""))

    @property
    def pictures(self) -> bool:
        return self == Case(self.material)

    @property
    def strength(self) -> Deck:
        return EQUAL_ENERGIES if self.equal_energies else STRENGTH


MATERIALS = ("anisotropic", "isotropic")
CASES = {case.name: case for case in
         [Case(material, *how) for how in (("extrinsic",), ("intrinsic",), ("extrinsic", 2)) for material in MATERIALS]
         + [Case("isotropic", method, 1, True) for method in ("extrinsic", "intrinsic")]}


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


def material(case: Case, layer: int) -> Deck:
    names = ("M_v", "M_alpha", "M_beta", "M_psi")
    result: Deck = {"region": f"layer_{layer + 1}", "density": DENSITY,
                    "constants": {name: value * GPA for name, value in zip(names, CONSTANTS[case.material][layer])},
                    "strength": dict(case.strength)}
    if case.material == "anisotropic":
        result["axes"] = {"bedding": bedding()}
    return result


def deck(case: Case, profile: str) -> Deck:
    grid = "quick" if case.equal_energies else profile
    size, fine = SIZES[grid]
    parameters = {"width": WIDTH, "depth": DEPTH, "cavity_x": CAVITY[0], "cavity_y": CAVITY[1], "radius": RADIUS,
                  "size": size, "fine": fine} | MESHES[case.mesh]
    for k, (mean, rise) in enumerate(INTERFACES):
        parameters |= {f"depth_{k + 1}": mean, f"rise_{k + 1}": rise}
    return {
        "title": f"blast in layered rock, {case.name}",
        "mesh": {"file": str(FOLDER / "blast.geo"), "parameters": parameters},
        "solid": {"element": "compt", "plane": "strain", "thickness": THICKNESS},
        "material": [material(case, layer) for layer in range(4)],
        "load": [{"on": "cavity", "type": "pressure", "value": PRESSURE, "amplitude": {"type": "table"} | PULSE}],
        "boundary": [{"on": "outer", "type": "absorbing"}],
        "fracture": {"method": case.method, "penalty": PENALTY},
        "contact": {"method": "potential", "friction": CONTACT_FRICTION},
        "integrator": {"type": "central_difference", "dt": STEP[grid]},
        "run": {"t_end": T_END},
        "output": {"fields": T_END / FRAMES if case.pictures else 0.0, "history": T_END / HISTORY},
    }


def main(arguments: list[str]) -> int:
    folders = [a for a in arguments if not a.startswith("-")]
    if len(folders) != 1 or any(a.startswith("-") and a != "--quick" for a in arguments):
        print(__doc__, file=sys.stderr)
        return 2
    Path(folders[0]).mkdir(parents=True, exist_ok=True)
    for name, case in CASES.items():
        write_deck(deck(case, "quick" if "--quick" in arguments else "full"), Path(folders[0]) / f"{name}.toml",
                   "Written by studies/blast/cases.py.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
