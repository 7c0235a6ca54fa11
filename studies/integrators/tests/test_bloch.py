"""Waves of a lattice of springs, in closed form."""
import unittest
from pathlib import Path

import numpy as np
import scipy.sparse as sparse

from studies.common.matrices import System
from studies.integrators.bloch import period_in, speed

K, M, N = 3.0, 2.0, 7   # N/m along each bond, kg, nodes along a side; pitch 1 m


class Lattice(System):
    """Square lattice whose bonds hold both components alike: omega = 2 (k/m)^1/2 (sin^2(kx/2) + sin^2(ky/2))^1/2."""

    @property
    def stiffness(self):
        index = np.arange(N * N).reshape(N, N)
        bonds = np.concatenate([np.stack([index[:, :-1].ravel(), index[:, 1:].ravel()], -1),
                                np.stack([index[:-1].ravel(), index[1:].ravel()], -1)])
        A = sparse.lil_matrix((2 * N * N, 2 * N * N))
        for a, b in bonds:
            for c in (0, 1):
                i, j = 2 * a + c, 2 * b + c
                A[i, i] += K
                A[j, j] += K
                A[i, j] -= K
                A[j, i] -= K
        return A.tocsr()

    @property
    def mass(self):
        return np.full(2 * N * N, M)


def lattice() -> System:
    nodes = np.array([[x, y] for y in range(N) for x in range(N)], dtype=float)
    return Lattice(Path("."), nodes, np.empty((0, 3), dtype=int), np.arange(2 * N * N))


def exact(wavelength: float, angle: float) -> float:
    k = 2 * np.pi / wavelength * np.array([np.cos(angle), np.sin(angle)])
    return float(2 * np.sqrt(K / M) * np.linalg.norm(np.sin(k / 2)) / np.linalg.norm(k))


class Speeds(unittest.TestCase):
    def test_OneNode_IsTheClosedForm(self):
        period = period_in(lattice(), (3.0, 3.0), 1.0)
        for wavelength, angle in ((3.0, 0.0), (5.0, 0.7), (10.0, 2.2)):
            self.assertAlmostEqual(speed(period, wavelength, angle, np.array([1.0, 0.0])), exact(wavelength, angle), 12)

    def test_APeriodOfFour_PicksTheSameBranch(self):
        period = period_in(lattice(), (2.0, 2.0), 2.0)
        self.assertEqual(len(period.nodes), 4)
        self.assertAlmostEqual(speed(period, 5.0, 0.7, np.array([0.0, 1.0])), exact(5.0, 0.7), 12)

    def test_AMeshThatDoesNotRepeat_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "does not repeat"):
            period_in(lattice(), (2.0, 2.0), 1.5)


if __name__ == "__main__":
    unittest.main()
