"""Orders from made-up runs; what is kept of them."""
import math
import unittest
from pathlib import Path

from studies.integrators.analysis import Run, disagreement, failures, in_range, order


def run(steps: int, error: float, status: str = "done", scheme: str = "some", message: str = "") -> Run:
    return Run(scheme, f"{steps}", status, message, Path("."), error, 0.0, 0.0, steps, steps, 0.1)


class Orders(unittest.TestCase):
    def test_PowerLaw_HasItsExponent(self):
        runs = [run(n, 30.0 * n**-3.0) for n in (20, 40, 80)]
        self.assertAlmostEqual(order(runs, 1e-12, 0.05, 10), 3, 12)

    def test_WhatLiesOutsideOfTheRange_IsLeftOut(self):
        """Too coarse, too wrong, near the reference, failed."""
        good = [run(100, 1e-3), run(200, 2.5e-4)]
        runs = [run(5, 1e-2), run(50, 0.2), *good, run(400, 1e-9), run(300, math.nan, "failed")]
        self.assertEqual(in_range(runs, 1e-9, 0.05, 10), good)
        self.assertAlmostEqual(order(runs, 1e-9, 0.05, 10), 2, 12)

    def test_OneSetting_IsNoOrder(self):
        self.assertTrue(math.isnan(order([run(100, 1e-3)], 1e-9, 0.05, 10)))

    def test_Disagreement_IsTheLargerOne(self):
        self.assertEqual(disagreement({"tight": [run(9, 1e-11)], "witness": [run(9, 3e-11)]}), 3e-11)


class Failures(unittest.TestCase):
    def test_RefusalsOfCompositions_AreExplained_OthersNot(self):
        name = "verlet_suzuki_5_velocity"
        found = failures({name: [run(0, math.nan, "refused", name, "which takes steps back in time")]}, "cantilever")
        self.assertIn("cracks", found[0]["explained"])
        for problem, message in (("bar", "which takes steps back in time"), ("cantilever", "out of memory")):
            self.assertEqual(failures({name: [run(0, math.nan, "failed", name, message)]}, problem)[0]["explained"], "")


if __name__ == "__main__":
    unittest.main()
