"""The numbers of the study on histories that are known: the closed form itself, shifted, scaled and sampled."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from studies.borehole import analysis
from studies.borehole.analysis import (Results, all_histories_difference, cavity, cavity_errors, front_speed_error,
                                       rotation_difference)
from studies.borehole.cases import FRONT_RADII, PROBE_RADIUS, Case, deck, probes

ISOTROPIC = Case("isotropic", 0.25, "horizontal", 100)


class TestAnalysis(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.results = Results(Path(holder.name))

    def write(self, case: Case, scale=1.0, delay=0.0):
        """probes.csv of a run that follows the closed form of ISOTROPIC in every direction."""
        exact = cavity(ISOTROPIC)
        t = np.arange(0, deck(case)["run"]["t_end"] + 1e-9, 1e-5)
        radii = {float(p["name"].split("_")[0][1:]) for p in probes(case)}
        signals = {r: (exact.displacement(r, t - delay), exact.velocity(r, t - delay)) for r in radii}
        names, columns = ["t [s]"], [t]
        for probe in probes(case):
            u, v = signals[float(probe["name"].split("_")[0][1:])]
            c, s = np.array(probe["at"]) / np.hypot(*probe["at"])
            for kind, unit, signal in (("u", "m", u), ("v", "m/s", v)):
                for suffix, part in (("x", c), ("y", s), ("r", 1.0)):
                    names.append(f"{probe['name']}.{kind}_{suffix} [{unit}]")
                    columns.append(scale * part * signal)
        folder = self.results.of(case)
        folder.mkdir()
        np.savetxt(folder / "probes.csv", np.stack(columns, -1), delimiter=",", header=",".join(names), comments="",
                   fmt="%.17g")

    def test_CavityErrors_OfTheClosedForm_AreThoseOfItsSampling(self):
        self.write(ISOTROPIC)
        errors = cavity_errors(self.results, ISOTROPIC)
        # Rows 10 us apart place the front within half a row: 5 us of the filter's 200 us.
        self.assertLess(errors["velocity"], 5e-3)
        self.assertLess(errors["displacement"], 1e-4)

    def test_CavityErrors_OfAScaledSignal_AreTheScale(self):
        self.write(ISOTROPIC, scale=1.1)
        errors = cavity_errors(self.results, ISOTROPIC)
        self.assertAlmostEqual(errors["displacement"], 0.1, places=3)
        self.assertAlmostEqual(errors["peak"], 0.1, places=2)

    def test_RotationDifference_OfAScaledRun_IsTheScale(self):
        turned = ISOTROPIC.of(axes="turned")
        self.write(ISOTROPIC)
        self.write(turned, scale=0.98)
        for key, value in rotation_difference(self.results, turned, ISOTROPIC).items():
            self.assertAlmostEqual(value, 0.02, msg=key)

    def test_FrontSpeedError_OfTheClosedForm_IsSmall_OfALateOne_Too(self):
        # A constant delay moves both radii alike. The shape behind the front changes with r: a tenth of sigma.
        for name, delay in (("on time", 0.0), ("late", 1e-4)):
            with self.subTest(name):
                case = ISOTROPIC if delay == 0 else ISOTROPIC.of(sub_edge_mm=99)
                self.write(case, delay=delay)
                error = front_speed_error(self.results, case, 30.0)
                way = (FRONT_RADII[-1] - FRONT_RADII[0]) / error["exact_speed"]
                self.assertLess(abs(error["error"]), 0.1 * case.filter_sigma / way)

    def test_AllHistories_DifferentRows_AreRefused(self):
        shifted = ISOTROPIC.of(variant="hypo")
        self.write(ISOTROPIC)
        self.write(shifted)
        self.assertEqual(all_histories_difference(self.results, shifted, shifted), 0.0)
        path = self.results.of(shifted) / "probes.csv"
        path.write_text("\n".join(path.read_text().splitlines()[:-1]) + "\n")
        analysis._table.cache_clear()
        with self.assertRaisesRegex(ValueError, "different times"):
            all_histories_difference(self.results, shifted, ISOTROPIC)

    def test_Cavity_OfAnAnisotropicCase_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "not isotropic"):
            cavity(Case("anisotropic", 0.0, "horizontal", 100))

    def test_Probe_OfThePaper_IsThere(self):
        self.assertIn(PROBE_RADIUS, FRONT_RADII)


if __name__ == "__main__":
    unittest.main()
