"""Free vibrations of small amplitude: eigenvalues of the undamped pencil, and how fast an explicit run grows."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigvals

from studies.common.matrices import System

Array = NDArray[np.float64]


def asymmetry(system: System) -> float:
    """Largest entry of the stiffness less its transpose, over the largest entry; the free degrees of freedom."""
    stiffness = system.stiffness[system.free][:, system.free]
    return float(abs(stiffness - stiffness.T).max() / abs(stiffness).max())


def frequencies(system: System) -> NDArray[np.complex128]:
    """omega of K phi = omega^2 M phi on the free degrees of freedom, rad/s, by ascending real part. The imaginary part
    is the rate at which one of a pair of modes grows. All eigenvalues, dense: for small systems."""
    stiffness = system.stiffness[system.free][:, system.free].toarray()
    scale = system.mass[system.free] ** -0.5
    omega = np.sqrt(eigvals(stiffness * np.outer(scale, scale)).astype(complex))
    return omega[np.argsort(omega.real)]


def flutter(omega: NDArray[np.complex128]) -> float:
    """Largest Im omega/Re omega; 0 where every motion stays bounded."""
    return float(np.max(np.abs(omega.imag) / omega.real))


def growth_rate(t: ArrayLike, kinetic_energy: ArrayLike) -> float:
    """Rate of the exponential growth of the velocity over the second half of a run, 1/s, by least squares."""
    t, kinetic_energy = np.asarray(t, dtype=float), np.asarray(kinetic_energy, dtype=float)
    late = t > 0.5 * (t[0] + t[-1])
    return float(0.5 * np.polyfit(t[late], np.log(kinetic_energy[late]), 1)[0])
