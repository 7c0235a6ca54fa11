"""The law against numbers that follow from FORMULATION 7 by hand."""
import unittest

import numpy as np

from studies.fracture.law import SOFTENING_INTEGRAL, Properties, along, softening, traction

LAW = Properties(tensile=3e6, cohesion=8e6, friction=0.5, residual_friction=0.3, G_I=80.0, G_II=240.0, penalty=1e12)


class TestSoftening(unittest.TestCase):
    def test_Softening_BeginsAtOneEndsAtZero(self):
        self.assertAlmostEqual(float(softening(0.0)), 1.0, places=12)
        self.assertAlmostEqual(float(softening(1.0)), 0.0, places=12)
        self.assertEqual(float(softening(2.0)), 0.0)

    def test_Softening_HasTheIntegralOfTheFormulation(self):
        d = np.linspace(0, 1, 20001)
        self.assertAlmostEqual(float(np.trapz(softening(d), d)), SOFTENING_INTEGRAL, places=6)


class TestTraction(unittest.TestCase):
    def path(self, angle, parts, n=4000):
        x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        end = LAW.last_lambda(x * x)
        return along([(part * end * x * LAW.opening_at_peak, part * end * y * LAW.slip_at_peak) for part in parts], n)

    def test_PureModesAndMixes_TakeTheirEnergies(self):
        for angle in (0, 30, 60, 90):
            o, s = self.path(angle, [0, 0.3, 0, 1.01])
            answer = traction(LAW, o, s)
            work = np.trapz(answer.normal, o) / LAW.G_I + np.trapz(answer.shear, s) / LAW.G_II
            self.assertAlmostEqual(float(work), 1.0, places=4)
            self.assertEqual(float(answer.damage[-1]), 1.0)

    def test_Peak_IsTheStrength(self):
        o, s = self.path(0, [0, 1])
        self.assertAlmostEqual(float(traction(LAW, o, s).normal.max()) / LAW.tensile, 1.0, places=2)
        o, s = self.path(90, [0, 1])
        self.assertAlmostEqual(float(traction(LAW, o, s).shear.max()) / LAW.cohesion, 1.0, places=2)

    def test_Unloading_IsSecant(self):
        o, s = self.path(0, [0, 0.4, 0.2])
        answer = traction(LAW, o, s)
        self.assertAlmostEqual(float(answer.normal[-1] / answer.normal[4000]), 0.5, places=9)

    def test_UnderPressure_FrictionComesOnTop(self):
        closed = -5e6 / LAW.penalty
        o, s = along([(0, 0), (closed, 0), (closed, 2 * LAW.last_lambda(0) * LAW.slip_at_peak)], 4000)
        answer = traction(LAW, o, s)
        self.assertAlmostEqual(float(answer.shear.max()) / (LAW.cohesion + 0.5 * 5e6), 1.0, places=2)
        self.assertAlmostEqual(float(answer.shear[-1]) / (0.3 * 5e6), 1.0, places=9)
        self.assertAlmostEqual(float(answer.normal[-1]), -5e6, delta=1)


if __name__ == "__main__":
    unittest.main()
