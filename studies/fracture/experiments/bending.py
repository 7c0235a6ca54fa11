"""A notched beam in three-point bending (Petersson's geometry): the load it bears, by sides that open and by joints that are there
from the start, against the same mesh with a seam that is rigid up to its strength, solved here."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.sparse.linalg as sparse_linalg
from numpy.typing import NDArray
from scipy.optimize import root

from studies.common import style
from studies.common.bounds import SKIPPED
from studies.common.decks import Deck
from studies.common.matrices import System, read_system
from studies.common.results import read_table
from studies.fracture.law import SOFTENING_INTEGRAL, softening

SPAN, DEPTH, THICKNESS, NOTCH = 2.0, 0.2, 0.05, 0.1  # m
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2400.0          # plane stress
SEAM = {"tensile": 3.33e6, "cohesion": 10e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 124.0, "G_II": 400.0}
BULK = {"tensile": 1e9, "cohesion": 1e9, "friction": 0.0, "residual_friction": 0.0, "G_I": 1e7, "G_II": 1e7}
LOADED = 0.02            # m, half of the length under the load
DEFLECTION = 0.6e-3      # m, at the end: the peak comes at some 0.2 mm
STEPS = 120
PENALTY = 20.0
CELLS = {"full": (10, 20), "quick": (10,)}  # along the depth
METHODS = {"full": ("extrinsic", "intrinsic"), "quick": ("extrinsic",)}  # joints on every edge are slow at rest


def mesh(cells: int, half: bool) -> Deck:
    length = SPAN / 2 if half else SPAN
    return {"generator": "rectangle", "width": length, "height": DEPTH, "cells": [round(length / DEPTH) * cells, cells],
            "pattern": "alternating",
            "parts": [{"name": "load", "of": "top", "from": [SPAN / 2 - LOADED, DEPTH],
                       "to": [SPAN / 2 if half else SPAN / 2 + LOADED, DEPTH]}]}


def breaking_deck(method: str, cells: int) -> Deck:
    lines = [{"name": "notch", "from": [SPAN / 2, 0.0], "to": [SPAN / 2, NOTCH]},
             {"name": "seam", "from": [SPAN / 2, NOTCH], "to": [SPAN / 2, DEPTH]}]
    return {
        "title": f"fracture: notched beam in bending, {method}, {cells} cells",
        "mesh": mesh(cells, half=False) | {"lines": lines},
        "solid": {"element": "compt", "plane": "stress", "thickness": THICKNESS},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": BULK}],
        "fracture": {"method": method, "penalty": PENALTY},
        "crack": [{"on": "notch"}],
        "interface": [{"on": "seam", "strength": SEAM}],
        "boundary": [{"on": "bottom_left", "type": "fixed"},
                     {"on": "bottom_right", "type": "displacement", "value": ["free", 0.0]},
                     {"on": "load", "type": "displacement", "value": ["free", -DEFLECTION],
                      "amplitude": {"type": "ramp", "end": 1.0}}],
        "integrator": {"type": "quasi_static", "step": 1 / STEPS, "longest": 1 / STEPS},
        "run": {"t_end": 1.0},
        "output": {"history": 1e-9, "rows": "steps"},
    }


def half_deck(cells: int) -> Deck:
    """The left half, its plane of symmetry free: what is solved here stands on its stiffness."""
    return {
        "title": f"fracture: half a beam, {cells} cells",
        "mesh": mesh(cells, half=True),
        "solid": {"element": "compt", "plane": "stress", "thickness": THICKNESS},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}}],
        "boundary": [{"on": "bottom_left", "type": "fixed"},
                     {"on": "load", "type": "displacement", "value": ["free", -1e-9], "amplitude": {"type": "ramp", "end": 1.0}}],
        "integrator": {"type": "quasi_static"},
        "run": {"t_end": 1.0},
    }


def half_name(cells: int) -> str:
    return f"bending-half-{cells}"


def name(method: str, cells: int) -> str:
    return f"bending-{method}-{cells}"


def cases(profile: str) -> dict[str, Deck]:
    found = {name(method, cells): breaking_deck(method, cells) for method in METHODS[profile] for cells in CELLS[profile]
             if method == "extrinsic" or cells == CELLS["quick"][0]}
    return found | {half_name(cells): half_deck(cells) for cells in CELLS["quick"]}


MATRICES = [half_name(cells) for cells in CELLS["quick"]]


def condensed(system: System) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Stiffness of the half between what moves: the nodes above the notch along x, from the notch upwards, and the load along -y,
    N/m, shape (n + 1, n + 1); and the lengths, m, that these nodes stand for."""
    x, y = system.nodes.T
    eps = 1e-9
    seam = np.nonzero((np.abs(x - SPAN / 2) < eps) & (y > NOTCH - eps))[0]
    seam = seam[np.argsort(y[seam])]
    pressed = np.nonzero((np.abs(y - DEPTH) < eps) & (x > SPAN / 2 - LOADED - eps))[0]
    foot = np.argmin(np.hypot(x, y))
    moved = np.concatenate([2 * seam, 2 * pressed + 1, [2 * foot + 1]])
    rest = np.setdiff1d(np.arange(system.n_dof), moved)
    k = system.stiffness.tocsc()
    inner = sparse_linalg.splu(k[rest][:, rest])
    coupling = k[rest][:, moved].toarray()
    of_moved = k[moved][:, moved].toarray() - coupling.T @ inner.solve(coupling)
    shape = np.zeros((len(moved), len(seam) + 1))  # the load moves its nodes alike, the foot stays
    shape[:len(seam), :len(seam)] = np.eye(len(seam))
    shape[len(seam):-1, -1] = -1.0
    ends = y[seam]
    length = np.zeros(len(seam))
    length[:-1] += np.diff(ends) / 2
    length[1:] += np.diff(ends) / 2
    return shape.T @ of_moved @ shape, length


def softened(opening: NDArray[np.float64]) -> NDArray[np.float64]:
    """Traction of an end that began at the strength, Pa."""
    return SEAM["tensile"] * softening(np.clip(SOFTENING_INTEGRAL * SEAM["tensile"] / SEAM["G_I"] * opening, 0.0, 1.0))


def static_curve(system: System) -> NDArray[np.float64]:
    """Deflection, m, and load, N, of the whole beam, shape (n, 2): the seam's nodes are rigid up to f_t and soften from there. The opening
    at the notch leads; the next node opens where its force reaches its strength."""
    k, length = condensed(system)
    area, strength = THICKNESS * length, SEAM["tensile"]
    opened, curve = 1, [(0.0, 0.0)]
    state = np.zeros(1)  # openings of opened nodes but the first, and the deflection
    for tip in np.linspace(1e-8, 6e-5, 1500):
        while True:
            def balance(unknown: NDArray[np.float64], n: int = opened) -> NDArray[np.float64]:
                opening = np.concatenate([[tip], unknown[:n - 1]])
                # each half moves by half of the opening away from the plane
                moved = np.concatenate([-opening / 2, np.zeros(len(length) - n), unknown[-1:]])
                return ((k @ moved)[:n] - area[:n] * softened(opening)) / (area[:n] * strength)

            start = np.concatenate([state[:-1], np.zeros(opened - len(state)), state[-1:]])
            found = root(balance, start, tol=1e-10)
            if not found.success:
                return np.array(curve)
            moved = np.concatenate([[-tip / 2], -found.x[:-1] / 2, np.zeros(len(length) - opened), found.x[-1:]])
            force = k @ moved
            if opened < len(length) and force[opened] >= area[opened] * strength:
                opened += 1
                continue
            state = found.x
            break
        curve.append((moved[-1], 2 * force[-1]))
    return np.array(curve)


def measure(runs: Path, profile: str) -> dict:
    curves, peaks = {}, {}
    for case in cases(profile):
        if case.startswith("bending-half"):
            continue
        reactions = read_table(runs / case / "reactions.csv")
        curves[case] = {"deflection": (DEFLECTION * reactions.t).tolist(), "load": (-reactions["load.R_y"]).tolist()}
        peaks[case] = float(np.max(curves[case]["load"]))
    coarse = CELLS["quick"][0]
    reference = static_curve(read_system(runs / half_name(coarse) / "matrices"))
    peak = float(reference[:, 1].max())
    return {"curves": curves, "reference": reference.tolist(), "metrics": {
        "bending_peak_reference_N": peak,
        **{f"bending_peak_error_{method}": abs(peaks[name(method, coarse)] / peak - 1) if method in METHODS[profile] else SKIPPED
           for method in METHODS["full"]},
        **{f"{case.replace('-', '_').replace('bending', 'bending_peak')}_N": value for case, value in peaks.items()}}}


FIGURES = ["bending.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, panel = style.plt.subplots(figsize=(style.FULL_WIDTH * 0.6, 2.8))
    reference = np.array(measured["reference"])
    panel.plot(reference[:, 0] * 1e3, reference[:, 1], "k--", lw=0.9, label="rigid seam, static")
    for (case, curve), colour in zip(measured["curves"].items(), style.CYCLE):
        panel.plot(np.array(curve["deflection"]) * 1e3, curve["load"], color=colour, label=case.removeprefix("bending-").replace("-", ", ") + " cells")
    panel.set(xlabel="deflection [mm]", ylabel="load [N]", xlim=(0, DEFLECTION * 1e3), ylim=(0, None))
    panel.legend()
    style.save(figure, figures / "bending.png")
