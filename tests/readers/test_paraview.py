"""ParaView reads both series of a run and computes von Mises' stress of it, where it is installed."""
import itertools
import os
import shutil
import unittest

import numpy as np

from tests.readers.run_and_compare import AgainstOurReader, run_interpreter

PVPYTHON = os.environ.get("GNEISS_PVPYTHON") or shutil.which("pvpython")
ROUND_OFF = 1e-12  # of some ten operations on stresses, relative to the largest one


def von_mises(stress):
    """Of rows XX YY ZZ XY YZ XZ."""
    xx, yy, zz, xy, yz, xz = stress.T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + yz**2 + xz**2))


@unittest.skipUnless(PVPYTHON, "ParaView is not installed (no pvpython in the PATH, no $GNEISS_PVPYTHON)")
class TestParaView(AgainstOurReader):
    def test_Series_AreReadToTheBitAndMisesStressIsTheFormulas(self):
        for data, name in itertools.product(("raw", "base64"), ("fields", "cracks")):
            frames = self.series(name, data)
            dumps = self.top / f"{data}_{name}"
            dumps.mkdir()
            run_interpreter(PVPYTHON, "dump_by_paraview.py", self.top / data / f"{name}.pvd", dumps)
            self.assertEqual(len(list(dumps.iterdir())), len(frames))
            for number, (t, path) in enumerate(frames):
                with self.subTest(path=path):
                    found = np.load(dumps / f"{number}.npz")
                    self.assertEqual(float(found["timestep"]), t)
                    self.compare_dump(path, t, found)
                    if name == "fields":
                        mises = von_mises(found["cell:cauchy_stress"])
                        np.testing.assert_allclose(found["mises"], mises, rtol=0, atol=ROUND_OFF * mises.max())


if __name__ == "__main__":
    unittest.main()
