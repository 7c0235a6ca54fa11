"""What a scheme does to the natural vibrations of a small assembled mesh, measured from runs of the program.

Every node is a probe. Modes of `gneiss matrices` take displacements and velocities apart; strains are so small that modes
do not feel each other. Of each mode a run of equal steps gives (omega q, p) step by step, and these give the eigenvalues
of the step.
"""
from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from studies.common.decks import Deck, write_deck
from studies.common.matrices import read_system
from studies.common.results import Table, read_table

Array = NDArray[np.float64]

FOLDER = Path(__file__).parent
SPEED = 1e-9            # m/s at the start; strains of 1e-12
RIGID = 1e-4            # of the largest frequency: below are the motions of the rigid body
MATERIAL = {"density": 1000.0, "constants": {"E": 1e9, "nu": 0.3}}
MESHES: dict[str, Deck] = {
    "one composite": {"file": str(FOLDER / "one_composite.geo")},
    "square": {"generator": "rectangle", "width": 1.0, "height": 1.0, "cells": [2, 2]},
}


def deck(mesh: str, nodes: Array | None = None) -> Deck:
    """Free, nothing damped; the velocity at the start has a part in every mode."""
    found: Deck = {
        "title": f"integrators: natural vibrations, {mesh}",
        "mesh": MESHES[mesh],
        "solid": {"element": "compt", "plane": "strain"},
        "material": [MATERIAL],
        "initial": [{"velocity": [f"{SPEED}*(sin(7*x + 3*y) + x*y)", f"{SPEED}*cos(5*x - 4*y + 1)"]}],
        "run": {"t_end": 1.0, "most_energy_gained": 0.0},  # growth is what is looked for
        "output": {"history": 1.0, "rows": "steps"},
    }
    if nodes is not None:
        found["output"]["probes"] = [{"name": f"n{i}", "at": [float(x), float(y)]} for i, (x, y) in enumerate(nodes)]
    return found


@dataclass(frozen=True)
class Modes:
    """Nodes (n, 2) m; frequencies (m) rad/s, ascending; shapes times mass (2n, m): what takes a mode out of a motion."""

    nodes: Array
    omega: Array
    take: Array

    def of(self, table: Table, kind: str) -> Array:
        """Coordinates of the modes, (rows, m): kind u or v."""
        motion = np.stack([table[f"n{i}.{kind}_{axis}"] for i in range(len(self.nodes)) for axis in "xy"], -1)
        return motion @ self.take


def modes_of(program: str, mesh: str, folder: Path) -> Modes:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "matrices.toml"
    write_deck(deck(mesh), path)
    subprocess.run([program, "matrices", str(path), "--out", str(folder / "matrices")], check=True,
                   stdout=subprocess.DEVNULL)
    system = read_system(folder / "matrices")
    scale = system.mass**-0.5
    K = system.stiffness.toarray() * np.outer(scale, scale)
    values, vectors = eigh(0.5 * (K + K.T))
    elastic = values > (RIGID**2) * values[-1]
    return Modes(system.nodes, np.sqrt(values[elastic]), (vectors / scale[:, None])[:, elastic])


@dataclass(frozen=True)
class Course:
    """Of every mode at the times of a run: (omega q, p) with q'' = -omega^2 q, shape (rows, m) each."""

    t: Array
    omega_q: Array
    p: Array


def run(program: str, mesh: str, modes: Modes, keys: dict[str, Any], t_end: float, row: float, folder: Path) -> Course | str:
    """One run; what the program says where it refuses or fails. row: time between two rows, s; every step has its own
    where it is shorter than a step."""
    what = deck(mesh, modes.nodes)
    what["run"]["t_end"] = t_end
    what["output"]["history"] = row
    what["integrator"] = keys
    if keys["type"] == "mri":
        what["contact"] = {"method": "potential", "friction": 0.0}  # there has to be some; nothing touches
    path = folder / "run.toml"
    write_deck(what, path)
    ended = subprocess.run([program, "run", str(path), "--overwrite", "--out", str(folder / "run"), "--threads", "1", "--quiet"],
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        return ended.stderr.strip().splitlines()[-1] if ended.stderr.strip() else f"exit code {ended.returncode}"
    table = read_table(folder / "run" / "probes.csv")
    return Course(table.t, modes.omega * modes.of(table, "u"), modes.of(table, "v"))


def equal_steps(program: str, mesh: str, modes: Modes, keys: dict[str, Any], dt: float, n: int, folder: Path) -> Course | str:
    return run(program, mesh, modes, keys | {"dt": dt}, n * dt, dt, folder)


# Where a step leaves next to nothing of a mode, later rows are the round-off of the others.
GONE = 1e-5


def alive(course: Course, mode: int, least: int) -> Array:
    """(omega q, p) of a mode, shape (2, rows), as long as it is there."""
    y = np.stack([course.omega_q[:, mode], course.p[:, mode]])
    gone = np.nonzero(np.linalg.norm(y, axis=0) < GONE * np.linalg.norm(y[:, 0]))[0]
    return y[:, :max(least, int(gone[0]))] if gone.size else y


def step_matrix(course: Course, mode: int) -> Array:
    """The 2 x 2 matrix that takes (omega q, p) over a step, by least squares over all of them."""
    y = alive(course, mode, 4)
    size = np.linalg.norm(y[:, :-1], axis=0)    # every step counts the same, though it may grow or decay
    return np.linalg.lstsq((y[:, :-1] / size).T, (y[:, 1:] / size).T, rcond=None)[0].T


def step_eigenvalues(course: Course, mode: int, n_values: int) -> NDArray[np.complex128]:
    """Of a step of a scheme that carries `n_values` numbers per mode: 2, or 3 with an acceleration of its own. Then (omega
    q, p) alone do not tell the next state, but both follow the recurrence of the characteristic polynomial."""
    if n_values == 2:
        return np.linalg.eigvals(step_matrix(course, mode))
    y = alive(course, mode, 2 * n_values + 1)
    rows = [np.concatenate([y[:, k:k + n_values] / np.max(np.abs(y[:, k:k + n_values + 1])),
                            y[:, k + n_values:k + n_values + 1] / np.max(np.abs(y[:, k:k + n_values + 1]))], axis=1)
            for k in range(y.shape[1] - n_values)]
    rows = np.concatenate(rows)
    coefficients = np.linalg.lstsq(rows[:, :-1], rows[:, -1], rcond=None)[0]
    return np.roots([1.0, *(-coefficients[::-1])])


def principal(values: NDArray[np.complex128]) -> complex:
    """The one of the complex pair of the largest modulus that has a positive imaginary part; a real one if none is complex."""
    complex_ones = values[np.abs(values.imag) > 1e-9]
    found = complex_ones if complex_ones.size else values
    largest = found[np.argmax(np.abs(found))]
    return complex(largest.real, abs(largest.imag))


def elongation_and_damping(value: complex, y: float) -> tuple[float, float]:
    """T_numerical/T - 1 and the damping ratio -ln|lambda|/arg(lambda) of a step with omega dt = y."""
    phase = float(np.angle(value))
    return y / phase - 1, -float(np.log(abs(value))) / phase
