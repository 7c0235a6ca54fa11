"""The analysis against closed forms and against the law integrated step by step."""
import unittest

import numpy as np

from studies.blast.analysis import Cracks, consistency, expected, largest_jump, orientation, worst_balance
from studies.blast.cases import CAVITY, STRENGTH, Case
from studies.common.results import Table
from studies.fracture.law import Properties, traction

ROUND_OFF = 1e-12
TRAPEZOIDAL = 2e-6  # of the table of the softening's integral
PENALTY = 1e12      # Pa/m
INTRINSIC, EXTRINSIC = Case("isotropic", "intrinsic"), Case("isotropic", "extrinsic")


def cracks(damage: float, fracture_i: float, fracture_ii: float, stronger: float = 1.0) -> Cracks:
    """One edge of 0.5 m."""
    ends = np.array([[[CAVITY[0] + 5, CAVITY[1]], [CAVITY[0] + 5.5, CAVITY[1]]]])
    both = np.ones((1, 2))
    return Cracks(ends, np.zeros((1, 2, 2)), damage * both, fracture_i * both, fracture_ii * both,
                  stronger * STRENGTH["tensile"] * both, stronger * STRENGTH["cohesion"] * both, np.array([[PENALTY]]),
                  np.array([0.5]), np.array([1e-3 if damage >= 1 else np.inf]))


def of_end(case: Case, edge: Cracks) -> float:
    return float(expected(case, edge)[0, 1])


def led(*places: tuple[float, float], steps: int = 6001) -> tuple[float, float, float]:
    """Damage and losses (J/m2) in opening and in sliding of the law, led from (o, s) = 0 straight to places, m."""
    law = Properties(*(STRENGTH[key] for key in ("tensile", "cohesion", "friction", "residual_friction", "G_I", "G_II")),
                     penalty=PENALTY)
    stops = np.array([(0.0, 0.0), *places])
    part = np.linspace(0, 1, steps)[1:, None]
    way = np.concatenate([stops[:1], *(a + part * (b - a) for a, b in zip(stops, stops[1:]))])
    answer = traction(law, *way.T)
    lost = [float(np.sum(0.5 * (t[1:] + t[:-1]) * np.diff(d)) - 0.5 * t[-1] * d[-1])
            for t, d in zip((answer.normal, answer.shear), way.T)]
    return float(answer.damage[-1]), lost[0], lost[1]


class TestExpected(unittest.TestCase):
    BY_STEPS = 1e-4  # of the law's integration

    def test_CompleteFailure_TakesTheEnergyOfItsMode(self):
        for edge, energy in ((cracks(1, 1, 0), STRENGTH["G_I"]), (cracks(1, 0, 1), STRENGTH["G_II"])):
            self.assertAlmostEqual(of_end(INTRINSIC, edge) / energy, 1, delta=TRAPEZOIDAL)

    def test_MixedFailure_FulfilsTheLinearCriterion(self):
        total = of_end(INTRINSIC, cracks(1, 0.3, 0.7))
        self.assertAlmostEqual(0.3 * total / STRENGTH["G_I"] + 0.7 * total / STRENGTH["G_II"], 1, delta=TRAPEZOIDAL)

    def test_Extrinsic_LosesTheEnergyOfItsOffsetToo(self):
        offset = (1.5 * STRENGTH["tensile"]) ** 2 / PENALTY / 2
        found = of_end(EXTRINSIC, cracks(1, 1, 0, stronger=1.5))
        self.assertAlmostEqual(found / (STRENGTH["G_I"] + offset), 1, delta=TRAPEZOIDAL)

    def test_Written_EntersByTheRatioOfItsModesAlone(self):
        for case in (INTRINSIC, EXTRINSIC):
            one, other = (of_end(case, cracks(0.4, scale * 2, scale * 3)) for scale in (1, 50))
            self.assertAlmostEqual(one / other, 1, delta=ROUND_OFF)

    def test_Undamaged_NothingIsLost(self):
        for case in (INTRINSIC, EXTRINSIC):
            self.assertEqual(of_end(case, cracks(0, 0, 0)), 0)

    def test_Softening_IsTheWorkOfTheLawLessWhatIsStored(self):
        for place in ((1e-4, 0.0), (0.0, 1e-4), (5e-5, 5e-5)):
            damage, *lost = led(place)
            self.assertTrue(0.1 < damage < 0.9)
            self.assertAlmostEqual(of_end(INTRINSIC, cracks(damage, *lost)) / sum(lost), 1, delta=self.BY_STEPS)

    def test_ModeThatTurns_MissesTheClosedForm(self):
        damage, *lost = led((5e-5, 0.0), (5e-5, 1e-3))
        self.assertEqual(damage, 1)
        self.assertGreater(abs(of_end(INTRINSIC, cracks(1, *lost)) / sum(lost) - 1), 0.2)


class TestConsistency(unittest.TestCase):
    def test_EndsThatFollowTheLaw_AreConsistent(self):
        for damage, *lost in ((1.0, STRENGTH["G_I"], 0.0), led((5e-5, 5e-5))):
            found = consistency(INTRINSIC, cracks(damage, *lost), 0.5 * sum(lost))  # 0.5 m2
            self.assertAlmostEqual(found.files, 0, delta=ROUND_OFF)
            for difference in (found.all_ends, found.failed, found.softening, found.by_end):
                self.assertAlmostEqual(difference, 0, delta=TestExpected.BY_STEPS)

    def test_LedgerWithMore_IsMissedByThat(self):
        found = consistency(INTRINSIC, cracks(1, STRENGTH["G_I"], 0), 0.5 * STRENGTH["G_I"] / 0.9)
        for difference in (found.all_ends, found.files):
            self.assertAlmostEqual(difference, -0.1, delta=TRAPEZOIDAL)
        self.assertAlmostEqual(found.failed, 0, delta=TRAPEZOIDAL)

    def test_EndsThatHaveDissipatedTooMuch_AreMissedWhateverTheLedger(self):
        found = consistency(INTRINSIC, cracks(1, 1.1 * STRENGTH["G_I"], 0), 0.5 * 1.1 * STRENGTH["G_I"])
        self.assertAlmostEqual(found.files, 0, delta=ROUND_OFF)
        for difference in (found.all_ends, found.failed, -found.by_end):
            self.assertAlmostEqual(difference, 1 / 1.1 - 1, delta=TRAPEZOIDAL)

    def test_Excess_IsThatOfTheEnds(self):
        self.assertAlmostEqual(consistency(EXTRINSIC, cracks(1, 300, 0, stronger=1.2), 150).excess, 0.2, delta=ROUND_OFF)


class TestOrientation(unittest.TestCase):
    def test_Parallel_IsTheirDirectionWhicheverWayTheyRun(self):
        found = orientation(np.radians([170.0, -10.0, 350.0]), np.array([1.0, 2.0, 3.0]))
        self.assertAlmostEqual(found.mean, -10, delta=1e-9)
        self.assertAlmostEqual(found.concentration, 1, delta=ROUND_OFF)

    def test_EveryDirectionAlike_HasNoConcentration(self):
        self.assertAlmostEqual(orientation(np.linspace(0, np.pi, 37)[:-1], np.ones(36)).concentration, 0, delta=ROUND_OFF)

    def test_Length_Weighs(self):
        found = orientation(np.radians([0.0, 90.0]), np.array([3.0, 1.0]))
        self.assertAlmostEqual(found.mean, 0, delta=1e-9)
        self.assertAlmostEqual(found.concentration, 0.5, delta=ROUND_OFF)


class TestLedger(unittest.TestCase):
    history = Table({"t": np.array([0.0, 1.0, 2.0, 3.0]), "external_work": np.array([0.0, 1e-5, 1.0, 1.0]),
                     "balance_error": np.array([0.0, 1.0, -2e-3, 1e-3]), "left_over": np.array([0.0, 0.0, -2e-3, 1e-3])}, {})

    def test_Balance_CountsOnceEnergyHasEntered(self):
        self.assertAlmostEqual(worst_balance(self.history), 2e-3, delta=ROUND_OFF)

    def test_Jump_HasItsTimeAndSign(self):
        t, jump = largest_jump(self.history)
        self.assertEqual(t, 3.0)
        self.assertAlmostEqual(jump, 3e-3, delta=ROUND_OFF)


if __name__ == "__main__":
    unittest.main()
