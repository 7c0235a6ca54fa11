"""The Gaussian filter against exact convolutions; norms and crossings on signals known in closed form."""
import unittest

import numpy as np
from scipy.special import erf

from studies.common.signals import first_crossing, gaussian_filter, gaussian_filter_from_front, peak, relative_l2


class TestGaussianFilter(unittest.TestCase):
    def test_Filter_UnevenSamplesOfARamp_IsExact(self):
        # A ramp that starts at 1: Gaussian of a ramp is sigma (z Phi + phi), with no error from the sampling.
        t = np.concatenate([[0.0, 0.3, 1.0], np.sort(np.random.default_rng(1).uniform(1.0, 12.0, 40))])
        sigma, at = 0.2, np.linspace(0.2, 10, 30)
        z = (at - 1) / sigma
        exact = sigma * (z * 0.5 * (1 + erf(z / np.sqrt(2))) + np.exp(-z**2 / 2) / np.sqrt(2 * np.pi))
        np.testing.assert_allclose(gaussian_filter(t, np.maximum(t - 1, 0), sigma, at), exact, atol=1e-12)

    def test_Filter_Cosine_IsDampedByItsFrequency(self):
        # exp(-(omega sigma)^2/2), times the linear interpolation's 1 - (omega h)^2/12.
        omega, sigma, h = 30.0, 0.04, 1e-3
        t = np.arange(0, 6, h)
        at = np.linspace(2, 4, 50)
        exact = np.exp(-0.5 * (omega * sigma) ** 2) * np.cos(omega * at)
        np.testing.assert_allclose(gaussian_filter(t, np.cos(omega * t), sigma, at), exact, atol=(omega * h) ** 2 / 10)

    def test_Filter_SeveralColumns_EachOnItsOwn(self):
        t = np.linspace(0, 1, 101)
        both = np.stack([np.sin(t), t**2], -1)
        filtered = gaussian_filter(t, both, 0.05)
        np.testing.assert_allclose(filtered[:, 1], gaussian_filter(t, t**2, 0.05), rtol=0, atol=1e-14)

    def test_FilterFromFront_Step_IsTheErrorFunction(self):
        t = np.linspace(0, 3, 31)
        exact = 0.5 * (1 + erf((t - 1) / (0.2 * np.sqrt(2))))
        np.testing.assert_allclose(gaussian_filter_from_front(np.ones_like, 1.0, t, 0.2), exact, atol=1e-12)

    def test_Filter_TimesNotIncreasing_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "increase"):
            gaussian_filter([0, 1, 1], [0, 0, 0], 0.1)


class TestMeasures(unittest.TestCase):
    def test_RelativeL2_ScaledSignal_IsTheScale(self):
        t = np.linspace(0, 1, 11)
        self.assertAlmostEqual(relative_l2(t, 1.01 * np.sin(t), np.sin(t)), 0.01)

    def test_Peak_BetweenSamples_IsTheParabolas(self):
        t = np.arange(0, 3, 0.5)
        at, height = peak(t, 4 - (t - 1.2) ** 2)
        self.assertAlmostEqual(at, 1.2)
        self.assertAlmostEqual(height, 4.0)

    def test_FirstCrossing_BetweenSamples_IsInterpolated(self):
        self.assertAlmostEqual(first_crossing([0, 1, 2, 3], [0, 0, 1, 0], 0.25), 1.25)

    def test_FirstCrossing_NeverReached_IsAnError(self):
        with self.assertRaisesRegex(ValueError, "stays below"):
            first_crossing([0, 1], [0, 1], 2)


if __name__ == "__main__":
    unittest.main()
