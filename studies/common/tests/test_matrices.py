"""Folders of `gneiss matrices` are read as docs/matrices.md says they are written."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

from studies.common.matrices import read_system


class TestSystem(unittest.TestCase):
    def test_System_OfOneTriangle_IsReadWithBothTrianglesOfItsMatrix(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "system.json").write_text(json.dumps({
                "n_dof": 6, "constrained_dofs": [0, 1, 3], "nodes_m": [[0, 0], [1, 0], [0, 1]], "elements": [[0, 1, 2]]}))
            head = "%%MatrixMarket matrix coordinate real symmetric\n% a comment\n"
            (folder / "stiffness.mtx").write_text(head + "6 6 3\n1 1 2.5\n5 2 -1\n6 6 1e-3\n")
            (folder / "mass.mtx").write_text(head + "6 6 6\n" + "".join(f"{i} {i} {i}\n" for i in range(1, 7)))
            system = read_system(folder)
            self.assertEqual(system.n_dof, 6)
            np.testing.assert_array_equal(system.free, [2, 4, 5])
            expected = np.zeros((6, 6))
            expected[0, 0], expected[4, 1], expected[1, 4], expected[5, 5] = 2.5, -1, -1, 1e-3
            np.testing.assert_array_equal(system.stiffness.toarray(), expected)
            np.testing.assert_array_equal(system.mass, [1, 2, 3, 4, 5, 6])
            np.testing.assert_array_equal(system.nodes[1], [1, 0])


if __name__ == "__main__":
    unittest.main()
