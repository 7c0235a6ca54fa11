"""What the study promises about its cases: loads with the right resultant, nodes where a load begins, one deck each."""
import unittest

from studies.locking.analysis import LOCKING_TABLE
from studies.locking.cases import (CONSTANTS, ELEMENTS, FAMILIES, FORCES, PATTERNS, PLANES, PLANS, SIDE_TRACTION, SPREAD_LENGTH,
                                   Case, deck, reference_deck, vibration_deck)


class TestPlans(unittest.TestCase):
    def test_Names_OfDifferentCases_Differ(self):
        for plan in PLANS.values():
            cases = plan.all_cases()
            self.assertEqual(len({case.name for case in cases}), len(cases))

    def test_FullPlan_HasSixRefinementsOfEveryMesh(self):
        plan = PLANS["full"]
        for family in FAMILIES:
            self.assertGreaterEqual(len(plan.corner[family]), 6)
        for levels in (plan.spread, plan.finite, plan.inf_sup):
            self.assertGreaterEqual(len(levels), 6)

    def test_FullPlan_HasEveryElementOnSixRefinementsOfEveryMesh(self):
        plan = PLANS["full"]
        ours = [(case, case.element) for case in plan.all_cases() if case.solver == "newton" and case.size == "small"]
        sizes: dict = {}
        for case, element in ours + plan.peers():
            sizes.setdefault((case.load, case.plane, element, case.family), set()).add(case.n)
        for element in (*ELEMENTS, "p1", "p2", "taylor_hood"):
            for family in FAMILIES:
                for load, plane in (("corner", "stress"), ("corner", "strain"), ("spread", "strain")):
                    self.assertGreaterEqual(len(sizes[load, plane, element, family]), 6, (load, plane, element, family))

    def test_Table_IsMeasuredAsAWhole(self):
        for plan in PLANS.values():
            there = set(plan.all_cases())
            for element, column in LOCKING_TABLE.items():
                for n in column:
                    self.assertIn(Case("corner", "strain", element, "uniform_right", n), there)

    def test_WhatIsCompared_IsRun(self):
        for plan in PLANS.values():
            there = set(plan.all_cases())
            for case, element in plan.peers():
                self.assertIn(case, there)
                self.assertEqual(element == "p1", case.element == "cst")
            for which in [*PLANES, "sides"]:
                self.assertLessEqual(set(plan.map_cases(which)), there)
            self.assertLessEqual({v.n for v in plan.vibrations()}, {case.n for case in plan.spectrum_cases()})
            for relaxed, newton in plan.relaxation_pairs():
                self.assertIn(newton, there)
                self.assertEqual(deck(relaxed) | {"title": "", "integrator": None},
                                 deck(newton) | {"title": "", "integrator": None})


class TestDecks(unittest.TestCase):
    def test_SpreadLoad_HasTheForceOfTheCorner_AndBeginsAtNodes(self):
        for plan in PLANS.values():
            for n in plan.spread:
                self.assertEqual(2 * n * SPREAD_LENGTH % 1, 0)  # sub-edges are 1/(2 n)
        what = deck(Case("spread", "strain", "compt", "alternating", 8))
        (load,), (part,) = what["load"], what["mesh"]["parts"]
        self.assertEqual((part["from"], part["to"]), ([1 - SPREAD_LENGTH] * 2, [1, 1]))
        self.assertEqual(load["on"], part["name"])
        self.assertEqual([2 * SPREAD_LENGTH * t for t in load["value"]], [FORCES["small"], -FORCES["small"]])

    def test_CornerForce_IsOnTheCorner(self):
        for family in FAMILIES:
            what = deck(Case("corner", "stress", "cst", family, 4, "finite"))
            self.assertEqual(what["load"], [{"on": "top_right", "type": "nodal_force", "value": [1e6, -1e6],
                                             "amplitude": {"type": "ramp", "end": 1.0}}])
            self.assertEqual([b["on"] for b in what["boundary"]], ["left", "bottom"])
            self.assertEqual(what["mesh"].get("cells"), [4, 4] if family in PATTERNS else None)

    def test_Centre_IsWithTheDirectMap_TheOthersAreNot(self):
        centre, mean, cst = (deck(Case("corner", "strain", element, "crossed", 4))
                             for element in ("centre", "compt", "cst"))
        self.assertEqual((centre["solid"]["volumetric"], centre["material"][0]["stress_map"]), ("centre", "direct"))
        self.assertNotIn("volumetric", mean["solid"])
        self.assertEqual((mean["solid"]["element"], cst["solid"]["element"]), ("compt", "cst"))

    def test_Constants_AreThoseOfThePaper(self):
        # (15), (16) with E = 1 GPa; the paper prints four digits
        for plane, nu in (("stress", 0.5), ("strain", 0.4999)):
            M = 1e9 / (1 + nu)
            M_v = nu * 1e9 / (1 - nu**2) if plane == "stress" else nu * 1e9 / ((1 + nu) * (1 - 2 * nu))
            constants = deck(Case("corner", plane, "cst", "free", 4))["material"][0]["constants"]
            self.assertEqual(constants, CONSTANTS[plane])
            self.assertAlmostEqual(constants["M_alpha"] / M, 1, delta=1e-4)
            self.assertAlmostEqual(constants["M_v"] / M_v, 1, delta=1e-4)

    def test_Sides_AreSqueezedByTheSamePressure(self):
        what = deck(Case("sides", "strain", "cst", "uniform_right", 4, nu=0.25))
        self.assertEqual({load["on"]: load["value"] for load in what["load"]},
                         {"left": [SIDE_TRACTION, 0.0], "right": [-SIDE_TRACTION, 0.0]})
        self.assertEqual(what["boundary"], [{"on": "bottom", "type": "fixed"}])
        self.assertEqual(what["material"][0]["constants"], {"E": 1e9, "nu": 0.25})

    def test_Reference_IsTheSpreadLoadOnAnotherMesh(self):
        ours, its = deck(Case("spread", "strain", "compt", "free", 8)), reference_deck()
        for section in ("solid", "material", "load", "boundary"):
            self.assertEqual(ours[section], its[section])
        self.assertEqual(ours["mesh"]["parts"], its["mesh"]["parts"])

    def test_Vibration_IsFree(self):
        what = vibration_deck(PLANS["full"].vibrations()[0])
        self.assertNotIn("load", what)
        self.assertEqual(what["integrator"]["type"], "central_difference")


if __name__ == "__main__":
    unittest.main()
