"""Amplification matrices and stability functions against what papers print."""
import cmath
import unittest
from math import inf, sqrt

import numpy as np

from studies.integrators.schemes import SCHEMES, fixed
from studies.integrators.theory import eigenvalues, stability_function, stability_limit


class Limits(unittest.TestCase):
    def limit(self, name: str) -> float:
        scheme = SCHEMES[name]
        return stability_limit(scheme.integrator, scheme.explicit, 4.0)

    def test_ClosedForms(self):
        self.assertAlmostEqual(self.limit("central_difference"), 2, 9)
        self.assertAlmostEqual(self.limit("newmark_linear"), sqrt(12), 9)
        self.assertAlmostEqual(self.limit("knoth_wolke_3_3"), sqrt(3), 6)    # of every table of order 3 in three stages
        self.assertAlmostEqual(self.limit("zonneveld_5_3_4"), sqrt(8), 6)    # classical order 4
        # Noh and Bathe (2013): 2/sqrt((1 - p)(3p - 1))
        self.assertAlmostEqual(self.limit("noh_bathe"), 2 / sqrt(0.46 * 0.62), 5)

    def test_WhatHasNone(self):
        for name in ("newmark", "generalized_alpha", "bathe_0", "kvaerno_5_3_4"):
            self.assertEqual(self.limit(name), inf)
        # |R(iy)|^2 = 1 + y^4/4 of Heun's method
        self.assertEqual(self.limit("heun_euler_2_1_2"), 0)


class Steps(unittest.TestCase):
    def test_EigenvaluesAreExp_ToTheOrder(self):
        """The error of the principal eigenvalue falls as y^(p + 1), or faster."""
        for scheme in fixed():
            with self.subTest(scheme=scheme.name):
                coarse = 0.5 if scheme.order > 5 else 0.1   # high orders have to stand out of round-off
                errors = [abs(eigenvalues(scheme.integrator, y, scheme.explicit)[0] - exact)
                          for y in (coarse, coarse / 2) for exact in [self.nearest(scheme, y)]]
                self.assertGreater(np.log2(errors[0] / errors[1]), scheme.order + 0.7)

    @staticmethod
    def nearest(scheme, y: float) -> complex:
        value = eigenvalues(scheme.integrator, y, scheme.explicit)[0]
        return cmath.exp(1j * y) if value.imag > 0 else cmath.exp(-1j * y)

    def test_DampingAtInfinity_IsAsAsked(self):
        """At infinite frequency the radius is rho_inf."""
        for name, rho in (("generalized_alpha", 0.8), ("generalized_alpha_0", 0.0), ("bathe", 0.8), ("bathe_0", 0.0)):
            radius = max(abs(eigenvalues(SCHEMES[name].integrator, 1e6)))
            self.assertAlmostEqual(radius, rho, 2)

    def test_AdditiveTables_TakeTheirImplicitHalf(self):
        """L-stable, which explicit halves are not."""
        self.assertLess(abs(stability_function("ark548l2sab_8_4_5", True, -1e8)), 1e-3)


if __name__ == "__main__":
    unittest.main()
