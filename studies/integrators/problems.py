"""The problems that every scheme is run on: small solids, smooth loads, so that errors are those of the time integration."""
from __future__ import annotations

from dataclasses import dataclass
from math import pi, sin
from pathlib import Path
from typing import Any

from studies.common.decks import Deck


FOLDER = Path(__file__).parent
SAMPLES = 10    # states that are compared, at equal distances


@dataclass(frozen=True)
class Problem:
    """A deck without `[integrator]` and `[compare]`.

    Accuracy is chosen by a number of equal steps between two of the SAMPLES states that are compared: `resolved` have omega dt
    about 0.8 for the highest frequency of the mesh; `beyond` are further ones for schemes without a limit, which may step
    over those frequencies.
    """

    name: str
    title: str
    deck: Deck
    resolved: int
    smooth: bool                    # the solution has as many derivatives in time as any scheme asks for
    exact: dict[str, Any] | None = None
    beyond: tuple[int, ...] = ()
    stiff: bool = False
    largest_error: float = 0.05     # of the asymptotic range: above, phases have gone astray

    @property
    def interval(self) -> float:
        """Between two samples, s."""
        return self.deck["run"]["t_end"] / SAMPLES


DENSITY = 1000.0    # kg/m3, of all problems

# --- a bar between two fixed ends, Poisson's ratio 0 ---
BAR_LENGTH, BAR_CELLS, BAR_MODULUS = 1.0, 8, 1e9
BAR_MODES = (1, 3, 6, 11)   # up to two thirds of the mesh's highest: errors of order 8 have to be visible
BAR_SPEED = 1e-9            # m/s; strains of 1e-12: nothing of second order is seen


def bar_frequency(mode: int) -> float:
    """Of the semi-discrete bar, rad/s: (2c/h) sin(kh/2), h the sub-edge. Rows of lumped nodes are springs and masses."""
    h = BAR_LENGTH / (2 * BAR_CELLS)
    return 2 * (BAR_MODULUS / DENSITY) ** 0.5 / h * sin(mode * pi * h / (2 * BAR_LENGTH))


def _sum(terms: list[str]) -> str:
    return " + ".join(terms)


def bar() -> Problem:
    shapes = [(f"{BAR_SPEED!r}*sin({m}*pi*x)", bar_frequency(m)) for m in BAR_MODES]
    return Problem(
        "bar", "wave in a bar", {
            "title": "integrators: elastic wave in a bar between fixed ends",
            "mesh": {"generator": "rectangle", "width": BAR_LENGTH, "height": BAR_LENGTH / BAR_CELLS,
                     "cells": [BAR_CELLS, 1]},
            "solid": {"element": "compt", "plane": "stress"},
            "material": [{"density": DENSITY, "constants": {"E": BAR_MODULUS, "nu": 0.0}}],
            "boundary": [{"on": on, "type": "displacement", "value": [0.0, "free"]} for on in ("left", "right")],
            "initial": [{"velocity": [_sum([shape for shape, _ in shapes]), 0.0]}],
            "run": {"t_end": 2 * BAR_LENGTH / (BAR_MODULUS / DENSITY) ** 0.5},
        },
        resolved=12, smooth=True,
        exact={"displacement": [_sum([f"{shape}*sin({omega!r}*t)/{omega!r}" for shape, omega in shapes]), 0.0],
               "velocity": [_sum([f"{shape}*cos({omega!r}*t)" for shape, omega in shapes]), 0.0]})


# --- anisotropic rock around a borehole, pulse of pressure ---
PULSE = 2e-3    # s; sin^8 has seven continuous derivatives where it begins and ends


def pulse(duration: float) -> Deck:
    return {"type": "expression", "expression": f"t < {duration!r} ? sin(pi*t/{duration!r})^8 : 0"}


FOLDS = "0.6*sin(0.5*x) + 0.4*cos(0.4*y)"   # of the study borehole, as its constants


def borehole() -> Problem:
    return Problem(
        "borehole", "anisotropic borehole", {
            "title": "integrators: pulse of pressure in a borehole, anisotropic rock",
            "mesh": {"generator": "plate_with_hole", "side": 6.0, "radius": 1.0, "size": [0.8, 1.5]},
            "solid": {"element": "compt", "plane": "stress"},
            "material": [{"density": DENSITY, "axes": {"angle": FOLDS}, "constants":
                          {"M_v": 0.267e9, "M_alpha": 0.8e9, "M_beta": 1.6e9, "M_psi": 0.8e9}}],
            "load": [{"on": "hole", "type": "pressure", "value": 1e6, "amplitude": pulse(PULSE)}],
            "boundary": [{"on": "outer", "type": "absorbing"}],
            "run": {"t_end": 5e-3},
        },
        resolved=9, smooth=True)


# --- a square that is nearly incompressible ---
SQUARE_SPEED = 0.5      # m/s
SQUARE_RATIO = 0.499    # Poisson's


def square() -> Problem:
    """Left and bottom edge fixed; the velocity at the start has no divergence and is 0 there."""
    return Problem(
        "square", "nearly incompressible square", {
            "title": "integrators: free vibration of a nearly incompressible square",
            "mesh": {"generator": "rectangle", "width": 1.0, "height": 1.0, "cells": [3, 3]},
            "solid": {"element": "compt", "plane": "strain"},
            "material": [{"density": DENSITY, "constants": {"E": 1e9, "nu": SQUARE_RATIO}}],
            "boundary": [{"on": on, "type": "fixed"} for on in ("left", "bottom")],
            "initial": [{"velocity": [f"{2 * SQUARE_SPEED}*x^2*y", f"{-2 * SQUARE_SPEED}*x*y^2"]}],
            "run": {"t_end": 2.5e-3},
        },
        resolved=65, smooth=True, beyond=(4, 8, 16), stiff=True,
        # a tenth of the stiff part of the motion: where that has gone astray errors saturate
        largest_error=2e-3)


# --- two bars that collide ---
IMPACT_SPEED, IMPACT_GAP = 0.5, 1e-4    # m/s of either, m
FIRST_TOUCH = IMPACT_GAP / (2 * IMPACT_SPEED)   # s
IMPACT_LENGTH, IMPACT_MODULUS = 1.0, 1e9


def impact() -> Problem:
    """VERIFICATION 4: contact lasts 2L/c, the velocities are exchanged."""
    return Problem(
        "impact", "impact of two bars", {
            "title": "integrators: two bars collide",
            "mesh": {"file": str(FOLDER / "two_bars.geo"), "parameters": {"L": IMPACT_LENGTH, "gap": IMPACT_GAP}},
            "solid": {"element": "compt", "plane": "stress"},
            "material": [{"density": DENSITY, "constants": {"E": IMPACT_MODULUS, "nu": 0.0}}],
            "contact": {"method": "potential", "friction": 0.0},
            "initial": [{"on": on, "velocity": [sign * IMPACT_SPEED, 0.0]} for on, sign in (("left", 1), ("right", -1))],
            "run": {"t_end": 3e-3},
        },
        resolved=30, smooth=False, beyond=(8, 16))


# --- a charge burns in a borehole, its gas drives the rock ---


def gas() -> Problem:
    return Problem(
        "gas", "gas-driven cavity", {
            "title": "integrators: a borehole driven by gas",
            "mesh": {"generator": "plate_with_hole", "side": 6.0, "radius": 1.0, "size": [0.8, 1.5]},
            "solid": {"element": "compt", "plane": "strain"},
            "material": [{"density": DENSITY, "constants": {"E": 1e9, "nu": 0.25}}],
            "lumped": [{"type": "gas", "name": "gas", "on": "hole", "pressure": 1e5, "gamma": 1.3, "leak": 20.0,
                        "burn": {"energy": 2e7, "time": 1e-2, "exponent": 0.7, "reference_pressure": 1e5}}],
            "boundary": [{"on": "outer", "type": "absorbing"}],
            "run": {"t_end": 5e-3},
        },
        resolved=9, smooth=True)


PROBLEMS = {problem.name: problem for problem in (bar(), borehole(), square(), impact(), gas())}
