"""What the study promises about its cases: fields that turn as a whole, no reflection in a window, one deck each."""
import unittest
from math import cos, pi, sin, sqrt

import numpy as np

from studies.borehole.cases import (AXES, CAVITY_RADIUS, DIRECTIONS, FILTER_FACTOR, FRONT_RADII, PLANS, PROBE_RADIUS,
                                    ROTATION_PAIRS, TURN, WINDOW_END, Case, deck, fastest_speed, probe_name, probes)


def angle_at(axes, x, y):
    formula = AXES[axes]
    return eval(formula, {"sin": sin, "cos": cos, "sqrt": sqrt, "pi": pi, "x": x, "y": y}) \
        if isinstance(formula, str) else formula


class TestAxes(unittest.TestCase):
    def test_TurnedField_AtTurnedPoints_IsTheFieldTurned(self):
        for unturned, turned in ROTATION_PAIRS:
            for x, y in np.random.default_rng(3).uniform(-9, 9, (50, 2)):
                c, s = cos(pi / 4), sin(pi / 4)
                self.assertAlmostEqual(angle_at(turned, c * x - s * y, s * x + c * y), angle_at(unturned, x, y) + pi / 4)
            self.assertAlmostEqual(TURN[turned] - TURN[unturned], pi / 4)

    def test_Probes_OfTheTurnedCase_AreTurned(self):
        for unturned, turned in ROTATION_PAIRS:
            at = {axes: {p["name"]: p["at"] for p in probes(Case("isotropic", 0.0, axes, 100))}
                  for axes in (unturned, turned)}
            for degrees in DIRECTIONS:
                name = probe_name(PROBE_RADIUS, degrees)
                a, b = (complex(*at[axes][name]) for axes in (unturned, turned))
                self.assertAlmostEqual(b / a, complex(cos(pi / 4), sin(pi / 4)))


class TestCases(unittest.TestCase):
    def test_Plans_Main_AreTheSixteenRuns(self):
        for plan in PLANS.values():
            self.assertEqual(len({case.name for case in plan.main_cases()}), 16)
            self.assertEqual(len({case.name for case in plan.all_cases()}), len(plan.all_cases()))

    def test_FilterWidth_IsThatOfTheIssueOfTheStudy(self):
        self.assertAlmostEqual(Case("anisotropic", 0.0, "turned", 100).filter_sigma, 2e-4)
        self.assertAlmostEqual(Case("isotropic", 0.25, "turned", 100).filter_sigma, FILTER_FACTOR * 5 / sqrt(1.067e6))

    def test_Window_EndsBeforeAnyReflection(self):
        # No way from the cavity to the outer boundary and on to a probe is shorter than side - a - r, no wave is faster
        # than the fastest phase speed. Beyond 4 sigma the filter weighs nothing that could be seen.
        for case in PLANS["full"].all_cases():
            described = deck(case)
            side, end = described["mesh"]["side"], described["run"]["t_end"]
            reach = 4 * case.filter_sigma
            self.assertLess(WINDOW_END + reach, (side - CAVITY_RADIUS - PROBE_RADIUS) / fastest_speed(case))
            self.assertLess(WINDOW_END + reach, end)

    def test_LastFront_PassesItsProbe_BeforeAnyReflection(self):
        # The half-peak crossing is within 2 sigma of the arrival.
        for nu in (0.0, 0.25):
            case = Case("anisotropic", nu, "horizontal", 25)
            latest = case.stiffness.arrival(0.0, FRONT_RADII[-1], CAVITY_RADIUS) + 2 * case.filter_sigma
            reflected = (deck(case)["mesh"]["side"] - CAVITY_RADIUS - FRONT_RADII[-1]) / fastest_speed(case)
            self.assertLess(latest, reflected)

    def test_Variants_ChangeOneThing(self):
        base = Case("anisotropic", 0.25, "general", 50)
        expected = {"1kPa": [("load", "value")], "direct": [("material", "stress_map")], "two_threads": [],
                    "hypo": [("integrator", "dt"), ("material", "form")],
                    "cst": [("integrator", "dt"), ("solid", "element")]}
        for variant, changes in expected.items():
            found = []
            for section, value in deck(base.of(variant=variant)).items():
                if section in ("title", "output"):
                    continue
                new, old = (v[0] if isinstance(v, list) else v for v in (value, deck(base)[section]))
                found += [(section, key) for key in new if new[key] != old.get(key)]
            self.assertEqual(sorted(found), changes, variant)


if __name__ == "__main__":
    unittest.main()
