"""The numerical inf-sup test [Chapelle and Bathe, Computers and Structures 47 (1993); Bathe, Finite Element Procedures,
(4.207)].

A nearly incompressible solid is as good as its pressures are controlled: with b(q, v) = int q div v, the constant

    beta_h = min over q of max over v of b(q, v)/(|v| |q|)

must stay away from zero as the mesh is refined. Pressures are what the element takes its volume by: one per composite
(CST: one per triangle). |q| is the L2 norm, |v|^2 = int eps(v):eps(v), which is as good as H1 where the supports hold
(Korn). In matrices beta_h^2 is the smallest eigenvalue of B T^-1 B^T q = beta^2 S q, with B the integral of div v over
each element, S their areas and T the stiffness with M_v = 0, M_alpha = M_beta = M_psi = 1 Pa.

B is taken from the mesh and proved against the program: its stiffness must grow by exactly B^T S^-1 B from M_v = 0 to
M_v = 1 Pa.
"""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from studies.common.matrices import System, read_system

Array = NDArray[np.float64]

NORM_CONSTANTS = {"M_alpha": 1.0, "M_beta": 1.0, "M_psi": 1.0}  # Pa, beside M_v = 0 or 1
SAME_MATRIX = 1e-12   # of the largest entry: differences of stiffnesses of order one
NO_CONTROL = 1e-8     # beta_h^2 below it is zero: round-off times the condition of T, with room
LARGEST_DENSE = 600   # pressures


@dataclass(frozen=True)
class InfSup:
    beta: float             # square root of the smallest eigenvalue that is not zero
    n_pressures: int
    n_without_control: int  # zero eigenvalues: pressures that no displacement sees; with a free edge there should be none


def divergence(system: System) -> tuple[sparse.csr_matrix, Array]:
    """B, shape (n_elements, n_dof): integrals of div v over each element, m; and the areas, m2.

    The sides are straight from node to node, so that the integral is half the sum of v x chord around the element.
    """
    elements = system.elements
    following, preceding = np.roll(elements, -1, axis=1), np.roll(elements, 1, axis=1)
    chord = system.nodes[following] - system.nodes[preceding]  # across each node, shape (n_elements, nodes, 2)
    x = system.nodes[elements]
    area = 0.25 * np.sum(x[..., 0] * chord[..., 1] - x[..., 1] * chord[..., 0], axis=1)
    rows = np.repeat(np.arange(len(elements)), elements.shape[1])
    entries = sparse.coo_matrix((np.concatenate([0.5 * chord[..., 1].ravel(), -0.5 * chord[..., 0].ravel()]),
                                 (np.concatenate([rows, rows]),
                                  np.concatenate([2 * elements.ravel(), 2 * elements.ravel() + 1]))),
                                shape=(len(elements), system.n_dof))
    return entries.tocsr(), area


def inf_sup(without_volume: Path, with_volume: Path, all_eigenvalues: bool = False) -> InfSup:
    """From what `gneiss matrices` wrote for the same mesh with M_v = 0 and M_v = 1 Pa and NORM_CONSTANTS.

    all_eigenvalues: where many pressures are without control (CST), the smallest of the others is found among all.
    """
    system, other = read_system(without_volume), read_system(with_volume)
    if not np.array_equal(system.elements, other.elements):
        raise ValueError(f"{without_volume} and {with_volume} are of different meshes")
    B, area = divergence(system)
    norm, volume = system.stiffness, other.stiffness - system.stiffness
    by_mesh = B.T @ sparse.diags(1 / area) @ B
    difference = abs(volume - by_mesh).max()
    if not difference <= SAME_MATRIX * abs(volume).max():
        raise ValueError(f"{with_volume}: the stiffness does not grow with M_v as one pressure per element says, off by "
                         f"{difference:g} of {abs(volume).max():g}")
    free = system.free
    scaled = (sparse.diags(area**-0.5) @ B)[:, free].tocsr()
    norm = norm[free][:, free].tocsc()
    dense = all_eigenvalues or len(area) <= LARGEST_DENSE
    values = eigenvalues(scaled, norm) if dense else smallest_eigenvalues(scaled, norm)
    controlled = values[values > NO_CONTROL]
    if controlled.size == 0:
        raise ValueError(f"{with_volume}: the {len(values)} smallest eigenvalues are all zero")
    return InfSup(float(np.sqrt(controlled[0])), len(area), int(np.sum(values <= NO_CONTROL)))


def eigenvalues(B: sparse.csr_matrix, T: sparse.csc_matrix) -> Array:
    """Of B T^-1 B^T, ascending."""
    return eigh(B @ factors(T).solve(B.T.toarray()), eigvals_only=True)


def smallest_eigenvalues(B: sparse.csr_matrix, T: sparse.csc_matrix) -> Array:
    """The first two of them, by Lanczos' method.

    It iterates with (B T^-1 B^T + s)^-1 = 1/s - B (T + B^T B/s)^-1 B^T/s^2 [Woodbury].
    """
    n = B.shape[0]
    shift = 0.01  # eigenvalues are of order 0.1 to 1
    stiff = factors((T + B.T @ B / shift).tocsc())
    inverse = LinearOperator((n, n), lambda q: q / shift - B @ stiff.solve(B.T @ q) / shift**2, dtype=float)
    largest = eigsh(inverse, k=2, which="LM", tol=1e-8, return_eigenvectors=False)
    return np.sort(1 / largest - shift)


def factors(matrix: sparse.csc_matrix):
    """Of a symmetric positive definite matrix: pivots stay on the diagonal."""
    # SuperLU's relaxed supernodes and panels cost thirty times the rest in its symmetric mode.
    return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, relax=1, panel_size=1,
                options={"SymmetricMode": True})
