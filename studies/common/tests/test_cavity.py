"""Closed form of the pressurised cavity against stored digits, an independent inversion and its own limits."""
import unittest

import numpy as np
from scipy.special import kve

from studies.common.cavity import CavityStep, invert_laplace

# Plane stress, E = 1 Pa scaled away: lambda + 2G = 1, a = 1, p0 = 1, rho = 1, so c_P = 1.
CASES = {"nu=0": CavityStep(1.0, 1.0, 0.0, 1.0, 1.0), "nu=0.25": CavityStep(1.0, 1.0, 0.25, 0.75, 1.0)}


def invert_by_euler(transform, t):
    """Abate and Whitt's Euler summation of the Bromwich integral: never left of the singularities, unlike Talbot."""
    m = 15
    k = np.arange(2 * m + 1)
    beta = m * np.log(10) / 3 + 1j * np.pi * k
    xi = np.ones(2 * m + 1)
    xi[0] = 0.5
    binomial = 1.0
    xi[2 * m] = 2.0**-m
    for j in range(1, m):
        binomial *= (m - j + 1) / j
        xi[2 * m - j] = xi[2 * m - j + 1] + 2.0**-m * binomial
    eta = (-1.0) ** k * xi
    return 10 ** (m / 3) / t * float(np.sum(eta * np.real(transform(beta / t))))


class TestCavity(unittest.TestCase):
    def test_WallDisplacement_PlaneStressQuarter_ReproducesStoredDigits(self):
        # VERIFICATION 1, four decimals.
        u = CASES["nu=0.25"].displacement(1.0, [1, 2, 3.8, 6, 10])
        np.testing.assert_array_equal(np.round(u, 4), [0.8415, 1.3322, 1.5756, 1.4673, 1.3438])

    def test_WallHoopStress_Peak_ReproducesStoredDigits(self):
        # VERIFICATION 1. At the wall sigma_rr = -p0 gives u', so that hoop/p0 = -l + (1 - l^2) u, where
        # l = lambda/(lambda+2G).
        for name, expected in (("nu=0", 1.159), ("nu=0.25", 1.227)):
            case = CASES[name]
            u = case.displacement(1.0, np.linspace(0.01, 10, 4000))
            hoop = -case.lame_lambda + (1 - case.lame_lambda**2) * np.max(u)
            self.assertEqual(round(hoop, 3), expected)

    def test_Inversion_TwoMethods_Agree(self):
        # Euler summation with m = 15 in double precision carries about 1e-9.
        tolerance = 1e-8
        for case in CASES.values():
            q = case.two_g
            for rho in (1.0, 3.0, 5.0, 8.0):
                for tau in (1e-3, 0.1, 1.0, 3.0, 6.0, 10.0, 15.0):
                    for power, function in ((0, case.displacement), (1, case.velocity)):
                        expected = invert_by_euler(
                            lambda s: s ** (power - 1) * kve(1, rho * s) / (s * kve(0, s) + q * kve(1, s)), tau)
                        actual = function(rho, tau + rho - 1)[0]
                        self.assertLess(abs(actual - expected), tolerance, f"rho={rho} tau={tau} power={power}")

    def test_Inversion_KnownPair_IsExact(self):
        t = np.array([0.1, 1.0, 5.0])
        np.testing.assert_allclose(invert_laplace(lambda s: 1 / (s + 1) ** 2, t), t * np.exp(-t), rtol=0, atol=1e-12)

    def test_Velocity_AtFront_JumpsByGeometricSpreading(self):
        case = CavityStep(1e6, 1.0, 0.267e9, 0.8e9, 1000.0)
        for r in (1.0, 5.0, 8.0):
            just_behind = case.velocity(r, case.arrival(r) + 1e-9)[0]
            self.assertAlmostEqual(just_behind / case.front_jump(r), 1.0, places=5)
            self.assertEqual(case.velocity(r, case.arrival(r) - 1e-9)[0], 0.0)

    def test_Velocity_IntegratedOverTime_IsDisplacement(self):
        case = CASES["nu=0.25"]
        t = np.linspace(case.arrival(5.0), 9.0, 4001)
        v = case.velocity(5.0, t)
        v[0] = case.front_jump(5.0)
        u = np.trapz(v, t)
        self.assertAlmostEqual(u, case.displacement(5.0, t[-1])[0], places=6)  # trapezoid: h^2/12 * jump of v'

    def test_Displacement_LateTime_TendsToStaticSolution(self):
        # p0 a^2/(2 G r), reached as t^-2.
        case = CASES["nu=0"]
        self.assertAlmostEqual(case.displacement(2.0, 20.0)[0], 0.5, places=2)

    def test_FilteredVelocity_TwoRoutes_Agree(self):
        # Filtering v, and filtering u with the derivative of the Gaussian, are the same: here by differences in time.
        case, sigma, h = CASES["nu=0.25"], 0.2, 1e-4
        t = np.array([3.6, 4.0, 4.3, 6.0])
        later, earlier = (case.filtered_displacement(5.0, t + dt, sigma) for dt in (h, -h))
        slope = (later - earlier) / (2 * h)
        np.testing.assert_allclose(case.filtered_velocity(5.0, t, sigma), slope, atol=1e-7)

    def test_Radius_InsideCavity_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "inside the cavity"):
            CASES["nu=0"].displacement(0.5, 1.0)


if __name__ == "__main__":
    unittest.main()
