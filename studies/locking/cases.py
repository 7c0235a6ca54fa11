"""The cases of the study: which there are, what they are called, and the deck of each."""
from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from studies.common.decks import Deck, overlaid, read_deck

FOLDER = Path(__file__).parent

# Meshes of the unit square with n composites along a side. Diagonals of uniform_right rise towards the loaded corner.
PATTERNS = ["uniform_right", "uniform_left", "alternating", "crossed"]
FAMILIES = [*PATTERNS, "free"]
ELEMENTS = ["cst", "compt", "centre"]  # centre: COMPT with the volumetric stretch of its middle sub-triangle
PLANES = ["stress", "strain"]

# (25), (26) of the paper, Pa: E = 1 GPa with nu = 0.5 and nu = 0.4999. The paper prints 0.667 GPa.
M = 0.6667e9
CONSTANTS = {plane: {"M_v": M_v, "M_alpha": M, "M_beta": M, "M_psi": M}
             for plane, M_v in (("stress", M), ("strain", 1666.4e9))}

FORCES = {"small": 1e-3, "finite": 1e6}  # N: strains of 1e-12 to 1e-10, and of up to some tens of percent at the corner
SPREAD_LENGTH = 0.25                     # m, on each of the two edges at the corner
SIDE_TRACTION = 1000.0                   # Pa, Figure 20
SIDE_RATIOS = [0.25, 0.4999]             # Poisson's ratios of Figure 20
SIDE_MODULUS = 1e9                       # Pa, Young's


@dataclass(frozen=True)
class Case:
    """One equilibrium.

    load: "corner" a force at the corner, "spread" the same force over SPREAD_LENGTH of both edges, "sides" Figure 20.
    """

    load: str
    plane: str
    element: str
    family: str
    n: int
    size: str = "small"
    solver: str = "newton"  # or "relaxation": dynamic relaxation, as in the paper
    nu: float = 0.4999      # of "sides" alone

    @property
    def name(self) -> str:
        parts = [self.load, self.plane, self.element, self.family, f"n{self.n:03d}"]
        if self.load == "sides":
            parts.append(f"nu{round(1e4 * self.nu):04d}")
        elif self.size != "small":
            parts.append(self.size)
        return "-".join(parts + ([self.solver] if self.solver != "newton" else []))

    @property
    def force(self) -> float:
        """Of each component, N."""
        return FORCES[self.size]

    def of(self, **changes) -> "Case":
        return replace(self, **changes)


def mesh(family: str, n: int) -> Deck:
    """What a deck says of a mesh; parts of boundaries apart."""
    if family == "free":
        return {"file": str(FOLDER / "square.geo"), "parameters": {"n": n}}
    return {"generator": "rectangle", "width": 1.0, "height": 1.0, "cells": [n, n], "pattern": family}


def base_deck() -> Deck:
    return read_deck(FOLDER / "locking.toml")


def load(case: Case) -> list[Deck]:
    if case.load == "sides":
        return [{"on": on, "type": "traction", "value": [sign * SIDE_TRACTION, 0.0], "amplitude": RAMP}
                for on, sign in (("left", 1), ("right", -1))]
    if case.load == "spread":
        traction = case.force / (2 * SPREAD_LENGTH)  # Pa, thickness 1 m
        return [{"on": "loaded", "type": "traction", "value": [traction, -traction], "amplitude": RAMP}]
    return [{"on": "top_right", "type": "nodal_force", "value": [case.force, -case.force], "amplitude": RAMP}]


RAMP = {"type": "ramp", "end": 1.0}


def deck(case: Case) -> Deck:
    changes: Deck = {
        "title": f"locking: {case.name}",
        "solid": {"element": "cst" if case.element == "cst" else "compt", "plane": case.plane},
        "material": {"constants": CONSTANTS[case.plane]},
        "load": load(case),
    }
    if case.element == "centre":
        changes["solid"]["volumetric"] = "centre"
        changes["material"]["stress_map"] = "direct"
    if case.solver == "relaxation":
        changes["integrator"] = {"type": "dynamic_relaxation"}
    if case.load == "sides":
        changes["boundary"] = [{"on": "bottom", "type": "fixed"}]
        changes["material"]["constants"] = {"E": SIDE_MODULUS, "nu": case.nu}
    result = overlaid(base_deck(), changes)
    result["mesh"] = mesh(case.family, case.n)
    if case.load == "spread":
        result["mesh"]["parts"] = base_deck()["mesh"]["parts"]
    if case.load == "sides":
        result["material"][0]["constants"] = changes["material"]["constants"]  # another set: nothing of the first stays
    return result


def reference_deck() -> Deck:
    """The spread load on a mesh that is fine where the solution is singular: for Taylor-Hood elements."""
    result = deck(Case("spread", "strain", "compt", "free", 0))
    result["mesh"] |= {"file": str(FOLDER / "reference.geo"), "parameters": {"h": 0.03, "fine": 1e-5}}
    return result


@dataclass(frozen=True)
class Vibration:
    """A free vibration of small amplitude, explicit, nothing damped: supports as always, no load."""

    element: str  # compt, centre
    nu: float
    n: int

    @property
    def name(self) -> str:
        return f"{self.element}-nu{round(1e4 * self.nu):04d}-n{self.n:03d}"


VIBRATION_TIME = 0.06   # s: some hundred periods; flutter grows by ten orders of magnitude
VIBRATION_SPEED = 1e-9  # m/s: strains of 1e-4 after that
# Of the stable step. Central differences move at W with sin(W dt/2) = omega dt/2, so that a growth Im omega becomes
# Im omega/sqrt(1 - (omega dt/2)^2): 4 % more at half of the stable step, where the mode that grows has half of the largest
# frequency (nu = 0.25), 0.2 % at a tenth.
VIBRATION_SAFETY = 0.1


def vibration_deck(vibration: Vibration) -> Deck:
    result = deck(Case("corner", "strain", vibration.element, "uniform_right", vibration.n))
    result["title"] = f"locking: free vibration, {vibration.name}"
    result["material"][0]["constants"] = {"E": SIDE_MODULUS, "nu": vibration.nu}
    del result["load"]
    # no mode is left out: the field has no symmetry
    result["initial"] = [{"velocity": [f"{VIBRATION_SPEED}*sin(7*x + 3*y)*x", f"{VIBRATION_SPEED}*cos(5*x - 4*y)*y"]}]
    result["integrator"] = {"type": "central_difference", "safety": VIBRATION_SAFETY}
    result["run"] = {"t_end": VIBRATION_TIME}
    result["output"] = {"history": VIBRATION_TIME / 2000}
    return result


Levels = dict[str, tuple[int, ...]]  # composites along a side by family


def levels(uniform_right: tuple[int, ...], others: tuple[int, ...]) -> Levels:
    return {family: uniform_right if family == "uniform_right" else others for family in FAMILIES}


@dataclass(frozen=True)
class Plan:
    """The runs of one extent of the study, by what they are for. A run may serve several purposes."""

    corner: Levels                       # corner force, small, CST and COMPT
    centre: Levels                       # of these meshes, and of those of the spread load, which have `centre` as well
    p1: Levels                           # likewise deal.II's linear triangles, to compare with CST
    mixed: Levels                        # likewise P2 and Taylor-Hood
    finite: tuple[int, ...]              # CST and COMPT at finite load, uniform_right
    spread: tuple[int, ...]              # of the spread load, every family
    sides: int                           # of Figure 20, uniform_right
    relaxation: int                      # of dynamic relaxation
    maps: int                            # of the stress maps
    inf_sup: tuple[int, ...]             # of the inf-sup test, every family
    inf_sup_cst: tuple[int, ...]         # the same for CST: dense eigenvalues
    spectrum: tuple[int, ...]            # of the eigenvalues of centre and mean, uniform_right and free: dense
    vibration: int                       # of their free vibrations, one of those of the spectrum
    reference: tuple[int, ...]           # how often the reference's mesh is refined

    def corner_cases(self) -> list[Case]:
        return [Case("corner", plane, element, family, n) for family, levels in self.corner.items() for n in levels
                for plane in PLANES for element in ("cst", "compt")]

    def centre_cases(self) -> list[Case]:
        return [Case("corner", plane, "centre", family, n) for family in FAMILIES for n in self.corner[family]
                if n in self.centre[family] for plane in PLANES]

    def finite_cases(self) -> list[Case]:
        return [Case("corner", plane, element, "uniform_right", n, "finite") for n in self.finite for plane in PLANES
                for element in ("cst", "compt")]

    def spread_cases(self) -> list[Case]:
        return [Case("spread", "strain", element, family, n) for n in self.spread for family in FAMILIES
                for element in ELEMENTS if element != "centre" or n in self.centre[family]]

    def sides_cases(self) -> list[Case]:
        return [Case("sides", "strain", element, "uniform_right", self.sides, nu=nu)
                for nu in SIDE_RATIOS for element in ("compt", "cst")]

    def relaxation_pairs(self) -> list[tuple[Case, Case]]:
        """Dynamic relaxation and Newton's method on the same problem."""
        pairs = []
        for plane in PLANES:
            for element in ("cst", "compt"):
                newton = Case("corner", plane, element, "uniform_right", self.relaxation, "finite")
                pairs.append((newton.of(solver="relaxation"), newton))
        return pairs

    def map_cases(self, which: str) -> list[Case]:
        """Of a figure with stress maps: "stress", "strain" (corner force) or "sides"."""
        if which == "sides":
            return self.sides_cases()
        return [Case("corner", which, element, "uniform_right", self.maps) for element in ("compt", "cst")]

    def inf_sup_cases(self) -> list[Case]:
        return [Case("corner", "strain", element, family, n)
                for element, levels in (("compt", self.inf_sup), ("cst", self.inf_sup_cst)) for family in FAMILIES
                for n in levels]

    def spectrum_cases(self) -> list[Case]:
        return [Case("corner", "strain", element, family, n) for family in ("uniform_right", "free")
                for n in self.spectrum for element in ("compt", "centre")]

    def vibrations(self) -> list[Vibration]:
        return [Vibration(element, nu, self.vibration) for nu in SIDE_RATIOS for element in ("compt", "centre")]

    def peers(self) -> list[tuple[Case, str]]:
        """What deal.II computes as well, and with which of its elements."""
        there = self.corner_cases() + self.spread_cases()
        return ([(case, "p1") for case in there if case.element == "cst" and case.n in self.p1[case.family]]
                + [(case, element) for case in there if case.element == "compt" and case.n in self.mixed[case.family]
                   for element in ("p2", "taylor_hood")])

    def all_cases(self) -> list[Case]:
        pairs = [case for pair in self.relaxation_pairs() for case in pair]
        listed = (self.corner_cases() + self.centre_cases() + self.finite_cases() + self.spread_cases()
                  + self.sides_cases() + pairs)
        return sorted(set(listed), key=lambda case: (-case.n, case.name))  # the long ones first


SIX = (2, 4, 8, 16, 32, 64)
PLANS = {
    "full": Plan(
        corner=levels((*SIX, 128), SIX), centre=levels(SIX, SIX), p1=levels((*SIX, 128), SIX), mixed=levels(SIX, SIX),
        finite=SIX, spread=SIX, sides=32, relaxation=16, maps=32, inf_sup=SIX, inf_sup_cst=(2, 4, 8),
        spectrum=(1, 2, 4, 8), vibration=4, reference=(0, 1)),
    "quick": Plan(
        corner=levels((2, 4, 8, 16, 32), (2, 4, 8)), centre=levels((2, 4, 8, 16, 32), (8,)),
        p1=levels((2, 4, 8, 16, 32), (8,)), mixed=levels((2, 4, 8, 16, 32), (8,)),
        finite=(2, 4, 8), spread=(8, 16, 32), sides=16, relaxation=8, maps=16, inf_sup=(2, 4, 8), inf_sup_cst=(2, 4),
        spectrum=(1, 2, 4), vibration=4, reference=(0,)),
}
