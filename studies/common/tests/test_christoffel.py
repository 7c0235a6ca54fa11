"""Wave speeds and arrivals against stored digits, the isotropic limit and the wave surface."""
import unittest

import numpy as np

from studies.common.christoffel import Stiffness

SET_0 = Stiffness.from_munjiza(0.0, 1e9, 2e9, 1e9, 1000.0)            # constants (19) with (20)
SET_25 = Stiffness.from_munjiza(0.267e9, 0.8e9, 1.6e9, 0.8e9, 1000.0)  # constants (22) with (23)
ISOTROPIC = Stiffness.from_munjiza(0.267e9, 0.8e9, 0.8e9, 0.8e9, 1000.0)
MEASURED_DIRECTIONS = np.radians(np.linspace(0, 90, 13))


class TestChristoffel(unittest.TestCase):
    def test_GroupSpeed_ThreeDirections_ReproducesStoredDigits(self):
        # VERIFICATION 2, one decimal.
        for stiffness, expected in ((SET_0, [1000.0, 1081.1, 1414.2]), (SET_25, [1033.0, 1099.4, 1366.4])):
            speeds = [round(stiffness.group_speed_along(np.radians(d)), 1) for d in (0, 45, 90)]
            self.assertEqual(speeds, expected)

    def test_GroupVelocity_AnyNormal_IsGradientOfPhaseSpeed(self):
        # v(k) is homogeneous of degree 1: V = dv/dk, here by central differences of |k| v(angle of k).
        h = 1e-6
        for mode in ("qP", "qS"):
            for angle in np.radians([5.0, 30.0, 61.0]):
                def omega(k1, k2):
                    return np.hypot(k1, k2) * SET_25.phase_speed(np.arctan2(k2, k1), mode)
                k = np.array([np.cos(angle), np.sin(angle)])
                slope = [(omega(k[0] + h, k[1]) - omega(k[0] - h, k[1])) / (2 * h),
                         (omega(k[0], k[1] + h) - omega(k[0], k[1] - h)) / (2 * h)]
                np.testing.assert_allclose(SET_25.group_velocity(angle, mode), slope, rtol=1e-7)

    def test_Arrival_Isotropic_IsDistanceOverSpeed(self):
        c = np.sqrt(1.067e9 / 1000)
        for angle in MEASURED_DIRECTIONS:
            self.assertAlmostEqual(ISOTROPIC.arrival(angle, 5.0, 1.0), 4.0 / c, places=12)

    def test_Arrival_OnTheWaveSurface_IsItsTime(self):
        # The front a n + t V(n) is the envelope that the maximum describes: the arrival at its points is t.
        t, radius = 5e-3, 1.0
        for stiffness in (SET_0, SET_25):
            for x in stiffness.front(t, radius, n_points=25):
                arrival = stiffness.arrival(np.arctan2(x[1], x[0]), float(np.hypot(*x)), radius)
                self.assertAlmostEqual(arrival / t, 1.0, places=9)

    def test_Arrival_OffAxis_IsNotThatOfThePointSource(self):
        angle = np.radians(60.0)
        point_source = 4.0 / SET_0.group_speed_along(angle)
        self.assertGreater(abs(SET_0.arrival(angle, 5.0, 1.0) / point_source - 1), 0.005)

    def test_Arrival_InsideCavity_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "inside the cavity"):
            SET_0.arrival(0.0, 0.5, 1.0)


if __name__ == "__main__":
    unittest.main()
