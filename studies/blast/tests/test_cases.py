"""What the decks promise: the paper's tables, and bedding that follows the interfaces of the mesh."""
import re
import unittest

import numpy as np

from studies.blast.cases import (CASES, CAVITY, CONSTANTS, DEPTH, FOLDER, INTERFACES, RADIUS, SIZES, WIDTH, Case, bedding,
                                 deck, height)


class TestDecks(unittest.TestCase):
    def test_Materials_AreAdmissible(self):
        for layers in CONSTANTS.values():
            for M_v, M_alpha, M_beta, M_psi in layers:
                self.assertGreater(np.linalg.det([[M_v + M_alpha, M_v], [M_v, M_v + M_beta]]), 0)
                self.assertGreater(M_psi, 0)

    def test_Kinds_DifferInMaterialsAlone(self):
        one, other = deck(Case("anisotropic"), "full"), deck(Case("isotropic"), "full")
        for key in set(one) - {"title", "material"}:
            self.assertEqual(one[key], other[key])

    def test_Geometry_HasTheParametersAndTheBumpOfTheDeck(self):
        text = (FOLDER / "blast.geo").read_text()
        for profile in SIZES:
            for name in deck(Case("isotropic"), profile)["mesh"]["parameters"]:
                self.assertIsNotNone(re.search(rf"\b{name}\b", text), name)
        self.assertIn("Sin(2*Pi*(x/width + 0.375))", text)

    def test_Cases_HaveTheirOwnNames(self):
        for name, case in CASES.items():
            self.assertEqual(name, case.name)
        self.assertEqual(len({case.name for case in CASES.values()}), len(CASES))

    def test_SecondMesh_DiffersInParametersOfTheMeshAlone(self):
        one, other = deck(Case("isotropic"), "full"), deck(Case("isotropic", mesh=2), "full")
        self.assertNotEqual(one["mesh"]["parameters"], other["mesh"]["parameters"])
        for key in set(one) - {"title", "mesh", "output"}:
            self.assertEqual(one[key], other[key])

    def test_Interfaces_KeepApartFromEachOtherTheSurfaceAndTheCavity(self):
        x = np.linspace(-WIDTH / 2, WIDTH / 2, 200)
        heights = [np.zeros_like(x), *[np.array([height(k, a) for a in x]) for k in range(len(INTERFACES))],
                   np.full_like(x, -DEPTH)]
        for above, below in zip(heights, heights[1:]):
            self.assertGreater((above - below).min(), 5.0)
        for k in (0, 1):
            away = np.hypot(x - CAVITY[0], heights[k + 1] - CAVITY[1])
            self.assertGreater(away.min(), 2 * RADIUS)
        self.assertTrue(height(1, CAVITY[0]) < CAVITY[1] < height(0, CAVITY[0]), "the cavity is in layer 2")

    def test_Bedding_RunsFromTopToBottom(self):
        lines = bedding()
        self.assertEqual(len(lines), 5)
        self.assertEqual([line[0][1] for line in (lines[0], lines[-1])], [0.0, -DEPTH])


if __name__ == "__main__":
    unittest.main()
