"""The numbers of the study on fields that are known."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

from studies.common.fields import Frame
from studies.locking.analysis import (CHECKERBOARD_REACH, CORNER, Results, areas, checkerboard, growth_per_halving,
                                      orders, pressure, relative_difference, smoothed, stress_difference)
from studies.locking.cases import Case


def square(n: int) -> Frame:
    """The unit square cut into n x n cells of two triangles."""
    x = np.linspace(0, 1, n + 1)
    points = np.array([[a, b] for b in x for a in x])
    triangles = []
    for j in range(n):
        for i in range(n):
            k = j * (n + 1) + i
            triangles += [[k, k + 1, k + n + 2], [k, k + n + 2, k + n + 1]]
    return Frame(points, np.array(triangles))


class TestCheckerboard(unittest.TestCase):
    def test_ConstantPressure_DoesNotOscillate(self):
        frame = square(8)
        np.testing.assert_allclose(smoothed(frame, np.full(128, 3.0)), 3.0)
        self.assertLess(checkerboard(frame, np.full(128, 3.0)), 1e-14)

    def test_AlternatingPressure_IsItsAmplitudeOverTheMean(self):
        # Of the six triangles around an inner node three are up and three are down: nothing of it is left.
        frame = square(32)
        frame.points[:] = 0.5 * frame.points  # away from the corner
        values = 10.0 + 4.0 * np.tile([1.0, -1.0], 32 * 32)
        inner = np.all((frame.points[frame.triangles] % 0.5 != 0).all(axis=-1), axis=-1)
        np.testing.assert_allclose(smoothed(frame, values)[inner], 10.0)
        self.assertAlmostEqual(checkerboard(frame, values), 0.4, places=2)

    def test_NearTheCorner_NothingCounts(self):
        frame = square(8)
        near = np.hypot(*(frame.points[frame.triangles].mean(axis=1) - CORNER).T) < 0.5 * CHECKERBOARD_REACH
        values = np.ones(128)
        values[near] = 1e6
        self.assertLess(checkerboard(frame, values), 1e-14)

    def test_Areas_AddUp(self):
        self.assertAlmostEqual(areas(square(5)).sum(), 1.0)

    def test_Pressure_IsMinusTheMeanStressInThePlane(self):
        frame = square(1)
        frame.cell_data["cauchy_stress"] = np.array([[2.0, 4.0, 7.0, 8.0, 0.0, 0.0], [-1.0, 0.0, 7.0, 8.0, 0.0, 0.0]])
        np.testing.assert_array_equal(pressure(frame), [-3.0, 0.5])


class TestStressDifference(unittest.TestCase):
    def test_ScaledStress_DiffersByItsScale(self):
        one, other = square(4), square(4)
        one.cell_data["cauchy_stress"] = np.random.default_rng(1).normal(size=(32, 6))
        other.cell_data["cauchy_stress"] = 0.9 * one.cell_data["cauchy_stress"]
        self.assertAlmostEqual(stress_difference(other, one), 0.1)

    def test_OtherTriangles_AreRefused(self):
        with self.assertRaisesRegex(ValueError, "different triangles"):
            stress_difference(square(4), square(5))


class TestOrders(unittest.TestCase):
    def test_Errors_OfOrderTwo_HaveItOfEitherSign(self):
        found = orders({str(n): -3 / n**2 for n in (16, 2, 4, 8, 32)})
        self.assertEqual(list(found["orders"]), ["2-4", "4-8", "8-16", "16-32"])
        np.testing.assert_allclose(list(found["orders"].values()), 2)
        self.assertAlmostEqual(found["order"], 2)

    def test_Fit_IsOverTheLastMeshes_PairsAreOfAll(self):
        errors = {"2": 17.0} | {str(n): 1 / n for n in (4, 8, 16, 32)}
        found = orders(errors)
        self.assertAlmostEqual(found["order"], 1)
        self.assertAlmostEqual(found["orders"]["2-4"], np.log2(17 * 4))

    def test_Fit_OfTwoMeshes_IsNone(self):
        self.assertIsNone(orders({"2": 1.0, "4": 0.5})["order"])


class TestGrowth(unittest.TestCase):
    def test_Growth_OfPlaneStressAndStrain_HasTheirModulus(self):
        # ln 2 F/(E' (pi/4 - 1/2)), E' = E or E/(1 - nu^2)
        for E, nu, plane_strain in ((1e9, 0.5, False), (2e9, 0.25, False), (1e9, 0.4999, True), (3e9, 0.2, True)):
            M = E / (1 + nu)
            M_v = M * nu / (1 - 2 * nu) if plane_strain else M * nu / (1 - nu)
            modulus = E / (1 - nu**2) if plane_strain else E
            self.assertAlmostEqual(growth_per_halving(M_v, M) * modulus, np.log(2) / (np.pi / 4 - 0.5), places=9)


class TestResults(unittest.TestCase):
    def test_Compliance_IsTheWorkOfTheFullLoad_CornerIsPerForce(self):
        case = Case("corner", "strain", "compt", "crossed", 4)
        with tempfile.TemporaryDirectory() as name:
            results = Results(Path(name), Path(name))
            folder = results.of(case)
            folder.mkdir()
            # u = f/k with k = 4 N/m and the ramp of a linear solid: half of f u
            (folder / "summary.json").write_text(
                json.dumps({"status": "done", "energies_J": {"external_work": 0.5 * case.force**2 / 4}}))
            (folder / "probes.csv").write_text(
                f"t [s],corner.u_x [m],corner.u_y [m]\n0,0,0\n1,{case.force / 4},{-case.force / 4}\n")
            self.assertAlmostEqual(results.compliance(case), 0.25)
            np.testing.assert_allclose(results.corner(case), [0.25, -0.25])

    def test_Difference_IsRelativeToTheLargest(self):
        self.assertAlmostEqual(relative_difference(np.array([[1.0, 2.0]]), np.array([[1.5, -4.0]])), 1.5)


if __name__ == "__main__":
    unittest.main()
