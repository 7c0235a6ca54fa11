"""The analysis against closed forms and against the law integrated step by step."""
import unittest

import numpy as np

from studies.blast.analysis import (Cracks, dissipation, expected_energy, largest_jump, layer_of, orientation, penalties,
                                    worst_balance, written_energy)
from studies.blast.cases import CAVITY, CONSTANTS, GPA, PENALTY, STRENGTH, Case
from studies.common.results import Table
from studies.fracture.law import Properties, traction

ROUND_OFF = 1e-12
TRAPEZOIDAL = 2e-6  # of the table of the softening's integral


def cracks(damage: float, mode: float, failed: bool, fracture: float = 0.0) -> Cracks:
    """One edge of 0.5 m in layer 2."""
    ends = np.array([[[CAVITY[0] + 5, CAVITY[1]], [CAVITY[0] + 5.5, CAVITY[1]]]])
    both = np.ones((1, 2))
    return Cracks(ends, np.zeros((1, 2, 2)), damage * both, np.sqrt(mode) * 1e-4 * both, np.sqrt(1 - mode) * 1e-4 * both,
                  fracture * both, np.array([mode]), np.array([1e-3 if failed else np.inf]))


class TestDissipation(unittest.TestCase):
    penalty = np.array([1e12])

    def test_CompleteFailure_TakesTheEnergyOfItsMode(self):
        for omega, energy in ((1.0, STRENGTH["G_I"]), (0.0, STRENGTH["G_II"])):
            found = dissipation(np.array([1.0]), np.array([omega]), self.penalty, STRENGTH, extrinsic=False)
            self.assertAlmostEqual(float(found[0]) / energy, 1, delta=TRAPEZOIDAL)

    def test_MixedFailure_FulfilsTheLinearCriterion(self):
        omega = 0.3
        total = float(dissipation(np.array([1.0]), np.array([omega]), self.penalty, STRENGTH, extrinsic=False)[0])
        a_i, a_ii = (STRENGTH[key] ** 2 for key in ("tensile", "cohesion"))
        opening = omega * a_i / (omega * a_i + (1 - omega) * a_ii) * total
        self.assertAlmostEqual(opening / STRENGTH["G_I"] + (total - opening) / STRENGTH["G_II"], 1, delta=TRAPEZOIDAL)

    def test_Extrinsic_LosesTheEnergyOfItsOffsetToo(self):
        found = dissipation(np.array([1.0]), np.array([1.0]), self.penalty, STRENGTH, extrinsic=True)
        offset = STRENGTH["tensile"] ** 2 / self.penalty / 2
        self.assertAlmostEqual(float((found / (STRENGTH["G_I"] + offset))[0]), 1, delta=TRAPEZOIDAL)

    def test_Undamaged_NothingIsLost(self):
        for extrinsic in (False, True):
            self.assertEqual(float(dissipation(np.zeros(1), np.ones(1), self.penalty, STRENGTH, extrinsic)[0]), 0)

    def test_Softening_IsTheWorkOfTheLawLessWhatIsStored(self):
        law = Properties(*(STRENGTH[key] for key in ("tensile", "cohesion", "friction", "residual_friction", "G_I", "G_II")),
                         penalty=float(self.penalty[0]))
        opening = np.linspace(0, 0.4 * law.last_lambda(1.0) * law.opening_at_peak, 20001)
        answer = traction(law, opening, np.zeros_like(opening))
        work = np.sum(0.5 * (answer.normal[1:] + answer.normal[:-1]) * np.diff(opening))
        lost = work - 0.5 * answer.normal[-1] * opening[-1]
        found = dissipation(answer.damage[-1:], np.ones(1), self.penalty, STRENGTH, extrinsic=False)
        self.assertAlmostEqual(float(found[0]) / lost, 1, delta=1e-4)  # the law's integration by steps


class TestEdges(unittest.TestCase):
    def test_Energy_IsLengthTimesThicknessTimesTheLaw(self):
        edge = cracks(1.0, 1.0, failed=True, fracture=300.0)
        self.assertAlmostEqual(float(expected_energy(Case("isotropic", "intrinsic"), edge)[0]), 0.5 * 300, delta=1e-2)
        self.assertAlmostEqual(float(written_energy(edge)[0]), 0.5 * 300, delta=ROUND_OFF * 150)

    def test_Mode_OfSofteningEdgesIsTheOneTheyHave(self):
        for mode in (0.0, 1.0):
            failed, soft = (expected_energy(Case("isotropic"), cracks(0.999999, mode, state)) for state in (True, False))
            self.assertAlmostEqual(float(failed[0] / soft[0]), 1, delta=1e-6)

    def test_Layers_CountFromTheTop(self):
        points = np.array([[0.0, -1.0], list(CAVITY), [0.0, -45.0], [0.0, -79.0]])
        np.testing.assert_array_equal(layer_of(points), [0, 1, 2, 3])

    def test_Penalty_IsThatOfTheLayer(self):
        M_v, M_alpha = CONSTANTS["isotropic"][1][:2]
        found = penalties(Case("isotropic"), cracks(1.0, 1.0, True))[0]
        self.assertAlmostEqual(found / (PENALTY * (M_v + M_alpha) * GPA / 0.5), 1, delta=ROUND_OFF)


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
