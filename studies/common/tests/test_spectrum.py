"""Frequencies and growth of systems that are known."""
import unittest
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from studies.common.spectrum import asymmetry, flutter, frequencies, growth_rate


@dataclass
class Pair:
    """Two oscillators coupled without symmetry: K/m = [[1, c], [-c, 1]] has the eigenvalues 1 + ic, 1 - ic."""

    coupling: float
    m: float = 2.0

    @property
    def free(self):
        return np.array([0, 1])

    @property
    def stiffness(self):
        return sparse.csr_matrix(self.m * np.array([[1.0, self.coupling], [-self.coupling, 1.0]]))

    @property
    def mass(self):
        return np.array([self.m, self.m])


class TestSpectrum(unittest.TestCase):
    def test_UncoupledPair_HasItsFrequency_AndNoFlutter(self):
        omega = frequencies(Pair(0.0))
        np.testing.assert_allclose(omega, [1, 1])
        self.assertEqual(flutter(omega), 0)

    def test_CoupledPair_Flutters(self):
        omega = frequencies(Pair(0.1))
        exact = np.sqrt(1 + 0.1j)
        self.assertAlmostEqual(flutter(omega), exact.imag / exact.real)

    def test_Asymmetry_IsThatOfTheStiffness_OverItsLargestEntry(self):
        self.assertEqual(asymmetry(Pair(0.0)), 0)
        self.assertAlmostEqual(asymmetry(Pair(0.1)), 0.2)

    def test_Growth_OfAGrowingOscillation_IsItsRate(self):
        t = np.linspace(0, 10, 4001)
        velocity = np.exp(0.7 * t) * np.sin(20 * t) + 5  # something else at first
        self.assertAlmostEqual(growth_rate(t, 0.5 * velocity**2 + np.exp(1.4 * t)), 0.7, places=2)


if __name__ == "__main__":
    unittest.main()
