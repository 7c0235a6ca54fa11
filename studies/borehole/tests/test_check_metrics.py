"""The checker lets good summaries pass and no others."""
import math
import unittest

from studies.borehole.check_metrics import BOUNDS, check


def summary(extent="full", **changes):
    metrics = {name: getattr(bound, extent) for name, bound in BOUNDS.items()} | changes
    return {"extent": extent, "metrics": {k: v for k, v in metrics.items() if v is not None}}


class TestCheck(unittest.TestCase):
    def test_Metrics_AtTheirBounds_Pass(self):
        for extent in ("full", "quick"):
            self.assertTrue(check(summary(extent))[1])

    def test_Metrics_PastABound_MissingOrNotANumber_Fail(self):
        for value in (1.0, math.nan, None, True, "0.001"):
            with self.subTest(value=value):
                table, good = check(summary(cavity_solution_l2_max=value))
                self.assertFalse(good)
                self.assertEqual(table.count("MISSED"), 1)

    def test_Flags_OfTheWrongKind_Fail(self):
        for value in (False, 1, None):
            self.assertFalse(check(summary(threads_bitwise_identical=value))[1])

    def test_Metrics_WithoutBound_AreReported(self):
        self.assertIn("reported", check(summary(cavity_solution_l2_max_raw=0.3))[0])


if __name__ == "__main__":
    unittest.main()
