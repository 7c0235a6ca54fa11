"""Orders from made-up runs; what is kept of them."""
import math
import unittest
from pathlib import Path

from studies.integrators.analysis import Run, disagreement, explanation, failures, in_range, order


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


def failed(scheme: str, setting: str, message: str, status: str = "failed") -> Run:
    return Run(scheme, setting, status, message, Path("."), math.nan, 0.0, 0.0, 0, 0, 0.1)


class Failures(unittest.TestCase):
    KINK = "arkode cannot go on from t = 7.5e-05 s: ARK_CONV_FAILURE; the last good state, t = 7.5e-05 s, is in x"

    def test_RefusalsOfCompositions_AreExplained(self):
        name, message = "verlet_suzuki_5_velocity", "which takes steps back in time; damage cannot be undone"
        self.assertIn("cracks", explanation(failed(name, "", message, "refused"), "cantilever"))
        self.assertEqual(explanation(failed(name, "", message, "refused"), "bar"), "")
        self.assertEqual(explanation(failed(name, "", "out of memory"), "cantilever"), "")
        self.assertEqual(explanation(failed("verlet_single_velocity", "", message, "refused"), "cantilever"), "")

    def test_LongStepsOverTheTouch_AreExplained_OthersNot(self):
        name = "kvaerno_5_3_4"
        self.assertIn("kink", explanation(failed(name, "dt = 3.75e-05", self.KINK), "impact"))
        for scheme, setting, message in (
                (name, "dt = 5e-06", self.KINK),                                    # a step that is resolved
                (name, "dt = 3.75e-05", self.KINK.replace("7.5e-05", "2e-03")),     # long after the touch
                ("arkode_implicit", "rtol = 1e-06", self.KINK),                     # steps of its own choice
                ("newmark", "dt = 3.75e-05", self.KINK)):
            self.assertEqual(explanation(failed(scheme, setting, message), "impact"), "", (scheme, setting))

    def test_Failures_ListThem(self):
        found = failures({"some": [run(9, 1e-3)], "newmark": [failed("newmark", "dt = 1", "why")]}, "bar")
        self.assertEqual([(entry["scheme"], entry["explained"]) for entry in found], [("newmark", "")])


if __name__ == "__main__":
    unittest.main()
