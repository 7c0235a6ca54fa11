"""The inf-sup test on systems whose constants are known."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.io import mmwrite

from studies.common.matrices import System
from studies.locking.inf_sup import divergence, eigenvalues, inf_sup, smallest_eigenvalues

NODES = np.array([[0, 0], [1, 0.1], [2, 0], [1.2, 1.1], [0, 2], [-0.1, 1]], dtype=float)  # of one composite


def composite() -> System:
    return System(Path("."), NODES, np.array([[0, 1, 2, 3, 4, 5]]), np.arange(12))


class TestDivergence(unittest.TestCase):
    def test_AffineField_HasItsTraceTimesTheArea(self):
        B, area = divergence(composite())
        x, y = NODES.T
        exact = 0.5 * sum(x[i] * y[(i + 1) % 6] - x[(i + 1) % 6] * y[i] for i in range(6))
        self.assertAlmostEqual(area[0], exact)
        H = np.array([[0.3, -2.0], [0.7, 1.1]])
        self.assertAlmostEqual((B @ (NODES @ H.T).ravel())[0], np.trace(H) * exact)


class TestEigenvalues(unittest.TestCase):
    def test_Lanczos_FindsTheSmallestOfAll(self):
        random = np.random.default_rng(5)
        B = sparse.random(40, 120, density=0.1, random_state=5, format="csr") + sparse.eye(40, 120, format="csr")
        T = sparse.diags(random.uniform(1, 3, 120)) + sparse.diags([0.2, 0.2], [-1, 1], shape=(120, 120))
        np.testing.assert_allclose(smallest_eigenvalues(B.tocsr(), T.tocsc()), eigenvalues(B.tocsr(), T.tocsc())[:2],
                                   rtol=1e-6)


class TestInfSup(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def write(self, name: str, stiffness) -> Path:
        folder = self.folder / name
        folder.mkdir()
        mmwrite(folder / "stiffness.mtx", sparse.coo_matrix(stiffness))
        (folder / "system.json").write_text(json.dumps({"n_dof": 12, "constrained_dofs": [0, 1],
                                                        "nodes_m": NODES.tolist(), "elements": [[0, 1, 2, 3, 4, 5]]}))
        return folder

    def test_OneComposite_WithTheUnitNorm_IsTheNormOfItsDivergence(self):
        B, area = divergence(composite())
        b = B.toarray()[0]
        found = inf_sup(self.write("0", np.eye(12)), self.write("1", np.eye(12) + np.outer(b, b) / area[0]))
        self.assertAlmostEqual(found.beta, np.linalg.norm(b[2:]) / np.sqrt(area[0]))
        self.assertEqual((found.n_pressures, found.n_without_control), (1, 0))

    def test_AnotherVolumetricPart_IsRefused(self):
        with self.assertRaisesRegex(ValueError, "one pressure per element"):
            inf_sup(self.write("0", np.eye(12)), self.write("1", 2 * np.eye(12)))


if __name__ == "__main__":
    unittest.main()
