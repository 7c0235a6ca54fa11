"""Eigenvalues of steps from sequences that are known."""
import unittest
from math import cos, pi, sin

import numpy as np

from studies.integrators.modes import Course, elongation_and_damping, principal, step_eigenvalues


def course(values: list[complex], weights: list[complex], n: int = 16) -> Course:
    """(omega q, p) whose parts turn and decay by the eigenvalues."""
    k = np.arange(n)
    z = sum(weight * value**k for value, weight in zip(values, weights))
    return Course(k * 1.0, z.real[:, None], z.imag[:, None])


class Eigenvalues(unittest.TestCase):
    def test_OneTurningMode(self):
        value = 0.97 * complex(cos(0.4), sin(0.4))
        found = principal(step_eigenvalues(course([value], [1.0]), 0, 2))
        self.assertAlmostEqual(abs(found - value), 0, 12)

    def test_ASpuriousThird_IsToldFromThePrincipalOne(self):
        value = 0.97 * complex(cos(0.4), sin(0.4))
        found = principal(step_eigenvalues(course([value, -0.3], [1.0, 0.2 + 0.1j]), 0, 3))
        self.assertAlmostEqual(abs(found - value), 0, 9)

    def test_AModeThatIsGone_IsMeasuredBeforeItIs(self):
        """Rows of nothing but round-off of others would tell anything."""
        value = 0.05 * complex(cos(1.0), sin(1.0))
        what = course([value], [1.0])
        noise = 1e-9 * np.cos(np.arange(16.0))[:, None]
        found = principal(step_eigenvalues(Course(what.t, what.omega_q + noise, what.p), 0, 2))
        self.assertLess(abs(found - value), 1e-4)


class PeriodAndDamping(unittest.TestCase):
    def test_CentralDifferences_TurnTooFast(self):
        """sin(W/2) = y/2 and no damping; the damping ratio of exp(-0.1 + i) is 0.1."""
        y = 2 * sin(pi / 12)
        elongation, damping = elongation_and_damping(complex(cos(pi / 6), sin(pi / 6)), y)
        self.assertAlmostEqual(elongation, y / (pi / 6) - 1, 14)
        self.assertAlmostEqual(damping, 0, 14)
        self.assertAlmostEqual(elongation_and_damping(np.exp(-0.1 + 1j), 1.0)[1], 0.1, 14)


if __name__ == "__main__":
    unittest.main()
