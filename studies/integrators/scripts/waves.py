"""Speeds of P and S waves on regular meshes of CST and COMPT, lumped mass, over direction and wavelength; one against a run.

usage: waves.py PROGRAM PROFILE OUT.json
"""
from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import curve_fit

from studies.common.decks import Deck, write_deck
from studies.common.matrices import System, read_system
from studies.common.results import read_table
from studies.integrators.bloch import Period, period_in, speed

ELEMENTS = ("cst", "compt")
PATTERNS = ("uniform_right", "alternating", "crossed")
PERIOD = {"uniform_right": 1, "alternating": 2, "crossed": 1}  # cells
CELLS = 6                       # of the patch: the period in its middle is coupled to nothing on the boundary
H = 0.5                         # sub-edge over cell: what h means throughout
DENSITY = 1000.0
RATIOS = (0.3, 0.49)            # Poisson's
PLOTTED = (4.0, 6.0, 10.0)      # wavelengths over h, of curves over direction
DIRECTIONS = {"full": 5, "quick": 15}                       # degrees between two
WAVELENGTHS = np.geomspace(2.5, 40.0, 25)                   # over h; 20 among them
AXES = (0.0, 22.5, 45.0, 90.0, 135.0)                       # degrees, of curves over wavelength
RUN_MODE, RUN_CELLS, RUN_PERIODS = 3, 4, 12                 # of the standing wave: half waves along the patch


def lame(nu: float) -> tuple[float, float]:
    """lambda, G over Young's modulus of 1e9 Pa, plane strain."""
    return 1e9 * nu / ((1 + nu) * (1 - 2 * nu)), 1e9 / (2 * (1 + nu))


def speeds(nu: float) -> dict[str, float]:
    lam, shear = lame(nu)
    return {"P": float(np.sqrt((lam + 2 * shear) / DENSITY)), "S": float(np.sqrt(shear / DENSITY))}


def deck(element: str, pattern: str, nu: float, cells: int) -> Deck:
    """A patch of cells of 1 m."""
    return {
        "title": f"integrators: waves, {element}, {pattern}",
        "mesh": {"generator": "rectangle", "width": float(cells), "height": float(cells), "cells": [cells, cells],
                 "pattern": pattern},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": 1e9, "nu": nu}}],
        "run": {"t_end": 1.0},
    }


def matrices(program: str, what: Deck, folder: Path) -> System:
    write_deck(what, folder / "waves.toml")
    subprocess.run([program, "matrices", str(folder / "waves.toml"), "--out", str(folder / "matrices")], check=True,
                   stdout=subprocess.DEVNULL)
    system = read_system(folder / "matrices")
    return system


def polarised(kind: str, direction: float) -> np.ndarray:
    along = np.array([np.cos(direction), np.sin(direction)])
    return along if kind == "P" else np.array([-along[1], along[0]])


def relative_speed(period: Period, nu: float, kind: str, wavelength: float, degrees: float) -> float:
    """c_h/c at a wavelength over h."""
    direction = np.radians(degrees)
    return speed(period, wavelength * H, direction, polarised(kind, direction)) / speeds(nu)[kind]


def standing_wave(program: str, element: str, folder: Path) -> dict[str, float]:
    """Frequency of a P wave between smooth walls, crossed mesh: mirror images of it are the wave itself. Measured in a run and
    by Bloch's theorem, rad/s."""
    nu, length = RATIOS[0], float(RUN_CELLS)
    k = RUN_MODE * np.pi / length
    what = deck(element, "crossed", nu, RUN_CELLS)
    what["boundary"] = [{"on": on, "type": "displacement", "value": value} for on, value in
                        (("left", [0.0, "free"]), ("right", [0.0, "free"]), ("bottom", ["free", 0.0]),
                         ("top", ["free", 0.0]))]
    what["initial"] = [{"velocity": [f"1e-9*sin({k!r}*x)", 0.0]}]
    t_end = RUN_PERIODS * 2 * np.pi / (k * speeds(nu)["P"])
    what["run"] = {"t_end": float(t_end)}
    what["integrator"] = {"type": "verlet", "composition": "mclachlan_5", "safety": 0.3}
    points = np.linspace(0.0, length, 2 * RUN_CELLS + 1)[1:-1]
    what["output"] = {"history": 1e-12, "rows": "steps", "probes": [{"name": f"p{i}", "at": [float(x), 1.0]} for i, x in enumerate(points)]}
    write_deck(what, folder / "standing.toml")
    subprocess.run([program, "run", str(folder / "standing.toml"), "--overwrite", "--out", str(folder / "standing"), "--threads",
                    "1", "--quiet"], check=True)
    table = read_table(folder / "standing" / "probes.csv")
    q = sum(np.sin(k * x) * table[f"p{i}.v_x"] for i, x in enumerate(points))
    period = period_in(matrices(program, deck(element, "crossed", nu, CELLS), folder), (2.0, 2.0), 1.0)
    bloch = k * speed(period, 2 * np.pi / k, 0.0, np.array([1.0, 0.0]))
    (_, omega), _ = curve_fit(lambda t, a, omega: a * np.cos(omega * t), table.t, q, p0=(q[0], bloch))
    return {"run": float(omega), "bloch": float(bloch), "continuum": float(k * speeds(nu)["P"])}


def main(program: str, profile: str, out: str) -> None:
    directions = [float(d) for d in range(0, 181, DIRECTIONS[profile])]
    found: dict[str, Any] = {"direction": directions, "wavelength": WAVELENGTHS.tolist(), "meshes": [], "standing": {}}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for element in ELEMENTS:
            for pattern in PATTERNS:
                for nu in RATIOS:
                    system = matrices(program, deck(element, pattern, nu, CELLS), folder)
                    period = period_in(system, (2.0, 2.0), float(PERIOD[pattern]))
                    for kind in "PS":
                        found["meshes"].append({
                            "element": element, "pattern": pattern, "nu": nu, "wave": kind,
                            "over_direction": {f"{w:g}": [relative_speed(period, nu, kind, w, d) for d in directions]
                                               for w in PLOTTED},
                            "over_wavelength": {f"{d:g}": [relative_speed(period, nu, kind, w, d) for w in WAVELENGTHS]
                                                for d in AXES}})
            found["standing"][element] = standing_wave(program, element, folder)
    Path(out).write_text(json.dumps(found) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
