"""What the study promises about its cases: names, closed forms, one key from joints to splitting."""
import unittest

import numpy as np

from studies.fracture.cases import checked_decks, decks, sweeps
from studies.fracture.experiments import (CHECKED, EXPERIMENTS, bending, branching, brazilian, contact, dcb,
                                          kalthoff, shear_box, speed)
from studies.fracture.experiments.joint import HALF, LAW, turning_points


class TestDecks(unittest.TestCase):
    def test_EveryCase_HasItsOwnNameAndTitle(self):
        for profile in ("full", "quick"):
            found = decks(profile) | checked_decks(profile)
            self.assertEqual(len(found), sum(len(m.cases(profile)) for m in [*EXPERIMENTS.values(), *CHECKED.values()]))
            for name, deck in found.items():
                self.assertTrue(deck["title"].startswith("fracture: "), name)

    def test_Figures_AreMadeOnce(self):
        figures = [figure for module in EXPERIMENTS.values() for figure in module.FIGURES]
        self.assertEqual(len(figures), len(set(figures)))

    def test_Method_IsOneKey(self):
        for module in (branching, kalthoff):
            a, b = (module.deck("compt", 1e-3, method) for method in ("intrinsic", "extrinsic"))
            self.assertEqual(b["fracture"], {"method": "extrinsic"})
            self.assertEqual({k: v for k, v in a.items() if k not in ("fracture", "title")},
                             {k: v for k, v in b.items() if k not in ("fracture", "title")})

    def test_EveryTenthFrame_IsTheLastOneToo(self):
        # the others lose their fields, and the last one is drawn
        for module in (branching, kalthoff):
            self.assertAlmostEqual(module.T_END / module.FRAME / 10 % 1, 0.0)

    def test_Sweeps_HaveEnoughGapsAndTheirStep(self):
        for profile in ("full", "quick"):
            found = sweeps(profile)
            self.assertEqual(len(found), 2 * (contact.HALVINGS[profile] + 1))
            self.assertGreaterEqual(contact.GAPS[profile], 32)
            for name, (_, changes) in found.items():
                self.assertEqual(len({c["mesh"]["parameters"]["gap"] for c in changes}), contact.GAPS[profile], name)
        self.assertEqual(contact.HALVINGS["full"], 4)

    def test_Masses_AreAskedForCasesThatRun(self):
        self.assertLessEqual(set(contact.MATRICES), set(contact.cases("quick")))


class TestBodies(unittest.TestCase):
    def test_Parts_AreWhatElementsJoin(self):
        number = contact.parts(7, np.array([[5, 2, 1], [1, 3, 5], [0, 4, 6]]))
        self.assertEqual([number[i] == number[2] for i in range(7)], [False, True, True, True, False, True, False])
        self.assertEqual(number[4], number[6])


class TestClosedForms(unittest.TestCase):
    def test_Joint_PathsEndWhereNothingHolds(self):
        o, s = turning_points("opening")[-1]
        self.assertGreater(o, LAW.last_lambda(1.0) * LAW.opening_at_peak)
        self.assertEqual(s, 0)
        self.assertLess(o, 0.1 * HALF)

    def test_Dcb_LoadOfAGrowingCrack_KeepsItsEnergyRelease(self):
        for crack in (5 * dcb.ARM, 20 * dcb.ARM):
            opening = dcb.opening_at(crack)
            force = dcb.load(opening)
            beam = dcb.beam_length(opening, force)
            self.assertAlmostEqual(float(beam), crack + dcb.CHI * dcb.ARM)
            self.assertAlmostEqual(float(12 * force**2 * beam**2 / (dcb.YOUNG * dcb.ARM**3)), dcb.SEAM["G_I"])

    def test_BothMethods_OneKeyApart(self):
        for first, second in ((shear_box.deck(m, "cst", 8) for m in shear_box.METHODS),
                              (bending.breaking_deck(m, 10) for m in bending.METHODS["full"])):
            self.assertNotEqual(first["fracture"], second["fracture"])
            self.assertEqual({k: v for k, v in first.items() if k not in ("fracture", "title")},
                             {k: v for k, v in second.items() if k not in ("fracture", "title")})

    def test_ShearBox_StrengthIsThatOfTheSeam(self):
        self.assertAlmostEqual(shear_box.PEAK, 20e3)
        self.assertAlmostEqual(shear_box.RESIDUAL, 8e3)

    def test_Bending_SoftensFromTheStrengthToNothing(self):
        opening = np.linspace(0, 4e-4, 4001)
        traction = bending.softened(opening)
        self.assertAlmostEqual(float(traction[0]), bending.SEAM["tensile"])
        self.assertEqual(float(traction[-1]), 0.0)
        self.assertAlmostEqual(float(np.trapz(traction, opening)) / bending.SEAM["G_I"], 1.0, places=4)

    def test_Disc_NarrowArc_IsThePointLoad(self):
        across, along = brazilian.centre_stress(1.0)
        point = 2 * brazilian.force_of(1.0) / (np.pi * 2 * brazilian.RADIUS)
        self.assertAlmostEqual(across / point, 1.0, delta=0.05)
        self.assertAlmostEqual(along / point, -3.0, delta=0.05)

    def test_Lag_IsTheDelay(self):
        t = np.linspace(0, 1, 1000)
        pulse = lambda at: np.exp(-(((t - at) / 0.05) ** 2))
        self.assertAlmostEqual(speed.lag(t, pulse(0.3), 0.8 * pulse(0.6234)), 0.3234, places=4)


if __name__ == "__main__":
    unittest.main()
