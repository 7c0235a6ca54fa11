"""Speeds of plane waves on a regular mesh: the stencil of a period, taken out of assembled matrices, under Bloch's theorem.

With u = b_j exp(i k.x) at every node that repeats node j of the period, K(k) b = omega^2 M b. Of all branches the wave is
the one whose b is closest to a constant along the polarisation.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from studies.common.matrices import System

Array = NDArray[np.float64]

LEAST_OVERLAP = 0.8


@dataclass(frozen=True)
class Period:
    """Nodes of one period (n, 2) m, their masses (n), and their couplings: rows (2n) against nodes at `others` (m, 2) m, which
    repeat the period's node `of`."""

    nodes: Array
    mass: Array
    others: Array
    of: NDArray[np.int64]
    stiffness: Array    # (2n, 2m)


def period_in(system: System, origin: tuple[float, float], size: float) -> Period:
    """The nodes in [origin, origin + size) in both directions; all they are coupled to has to be in the mesh, free."""
    at = (system.nodes - np.array(origin)) / size
    tiny = 1e-9
    whole = np.floor(at + tiny)
    inside = np.nonzero(np.all(whole == 0, axis=1))[0]
    K = system.stiffness[np.stack([2 * inside, 2 * inside + 1], -1).ravel()]
    coupled = np.unique(K.nonzero()[1] // 2)
    # which of the period's nodes each of them repeats
    relative = at[coupled] - whole[coupled]
    distance = np.linalg.norm(relative[:, None, :] - at[inside][None, :, :], axis=2)
    of = np.argmin(distance, axis=1)
    if np.any(distance[np.arange(coupled.size), of] > 1e-6):
        raise ValueError("the mesh does not repeat itself with this period")
    columns = np.stack([2 * coupled, 2 * coupled + 1], -1).ravel()
    return Period(system.nodes[inside], system.mass[2 * inside], system.nodes[coupled], of, K[:, columns].toarray())


def frequencies(period: Period, k: Array) -> tuple[Array, NDArray[np.complex128]]:
    """omega of all branches, rad/s, and their shapes M^1/2 b in columns."""
    n = len(period.nodes)
    D = np.zeros((2 * n, 2 * n), dtype=complex)
    phases = np.exp(1j * (period.others @ k))
    for m, j in enumerate(period.of):
        D[:, 2 * j:2 * j + 2] += period.stiffness[:, 2 * m:2 * m + 2] * phases[m]
    # u_m = b_j exp(i k.x_m): constant b is a plane wave; a row is the force at its own place, of phase exp(i k.x_row)
    here = np.repeat(np.exp(-1j * (period.nodes @ k)), 2)
    scale = np.repeat(period.mass, 2) ** -0.5
    D = (here * scale)[:, None] * D * scale[None, :]
    D = 0.5 * (D + D.conj().T)
    values, vectors = np.linalg.eigh(D)
    return np.sqrt(np.maximum(values, 0)), vectors


def speed(period: Period, wavelength: float, direction: float, polarisation: Array) -> float:
    """omega/|k| of the branch whose shape is closest to a plane wave polarised so, m/s; NaN where none is: short waves of
    several branches mix."""
    k = 2 * np.pi / wavelength * np.array([np.cos(direction), np.sin(direction)])
    omega, shapes = frequencies(period, k)
    wave = (np.sqrt(period.mass)[:, None] * polarisation[None, :]).ravel()
    overlap = np.abs(wave @ shapes.conj()) / np.linalg.norm(wave)
    best = int(np.argmax(overlap))
    return float(omega[best] / np.linalg.norm(k)) if overlap[best] > LEAST_OVERLAP else float("nan")
