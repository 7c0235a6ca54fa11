"""The checker lets good summaries pass and no others."""
import contextlib
import io
import json
import math
import tempfile
import unittest
from pathlib import Path

from studies.common.bounds import SKIPPED, Bound, check, main, write_summary

BOUNDS = {
    "error": Bound(0.02, 0.08),
    "order": Bound(1.5, 1.2, at_least=True),
    "identical": Bound(True, True),
    "difference": Bound(1e-8, 1e-8, may_skip=True),
}


def summary(extent="full", **changes):
    metrics = {name: getattr(bound, extent) for name, bound in BOUNDS.items()} | changes
    return {"extent": extent, "metrics": {k: v for k, v in metrics.items() if v is not None}}


class TestWriteSummary(unittest.TestCase):
    def test_WhatCouldNotBeMeasured_IsNull_AndKeepsNoBound(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "summary.json"
            write_summary(path, {"extent": "full", "metrics": {"error": math.nan, "order": 2.0}, "details": {"slopes": [1.0, math.inf]}})
            read = json.loads(path.read_text(), parse_constant=lambda name: self.fail(f"{name} is no JSON"))
        self.assertEqual(read["metrics"], {"error": None, "order": 2.0})
        self.assertEqual(read["details"], {"slopes": [1.0, None]})
        self.assertFalse(check(read, {"error": BOUNDS["error"]})[1])


class TestCheck(unittest.TestCase):
    def test_TwoNumbers_AreBothBounds(self):
        bounds = {"angle": Bound((60.0, 80.0), (50.0, 90.0))}
        for extent, value, good in (("full", 60, True), ("full", 81.0, False), ("full", 59.9, False), ("quick", 81.0, True),
                                    ("full", math.nan, False)):
            text, found = check({"extent": extent, "metrics": {"angle": value}}, bounds)
            self.assertEqual(found, good, (extent, value))
        self.assertIn("60 to 80", text)

    def test_Metrics_AtTheirBounds_Pass(self):
        for extent in ("full", "quick"):
            self.assertTrue(check(summary(extent), BOUNDS)[1])

    def test_Metrics_PastABound_MissingOrNotANumber_Fail(self):
        for value in (1.0, math.nan, None, True, "0.001", SKIPPED):
            with self.subTest(value=value):
                table, good = check(summary(error=value), BOUNDS)
                self.assertFalse(good)
                self.assertEqual(table.count("MISSED"), 1)

    def test_LowerBounds_AreThat(self):
        self.assertTrue(check(summary(order=2.0), BOUNDS)[1])
        self.assertFalse(check(summary(order=1.4), BOUNDS)[1])
        self.assertTrue(check(summary("quick", order=1.4), BOUNDS)[1])

    def test_Flags_OfTheWrongKind_Fail(self):
        for value in (False, 1, None):
            self.assertFalse(check(summary(identical=value), BOUNDS)[1])

    def test_Skipped_PassesWhereItMay(self):
        self.assertTrue(check(summary(difference=SKIPPED), BOUNDS)[1])
        self.assertFalse(check(summary(difference=None), BOUNDS)[1])

    def test_Metrics_WithoutBound_AreReported(self):
        self.assertIn("reported", check(summary(raw=0.3), BOUNDS)[0])


class TestMain(unittest.TestCase):
    def call(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = main(list(arguments), BOUNDS, "usage: check_metrics.py")
        return status, out.getvalue(), err.getvalue()

    def test_Status_SaysWhetherBoundsAreKept_AndWhatWasSkipped(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "summary.json"
            path.write_text(json.dumps(summary(difference=SKIPPED) | {"skipped": ["deal.II is not installed"]}))
            status, out, _ = self.call(str(path))
            self.assertEqual(status, 0)
            self.assertIn("skipped: deal.II is not installed", out)
            path.write_text(json.dumps(summary(error=1.0)))
            self.assertEqual(self.call(str(path))[0], 1)

    def test_WrongUse_IsTwo(self):
        status, _, err = self.call()
        self.assertEqual(status, 2)
        self.assertIn("usage", err)


if __name__ == "__main__":
    unittest.main()
