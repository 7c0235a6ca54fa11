"""VTK's own reader reads every frame of a run, where VTK for Python is installed."""
import importlib.util
import sys
import unittest

import numpy as np

from tests.readers.run_and_compare import AgainstOurReader, run_interpreter


@unittest.skipUnless(importlib.util.find_spec("vtkmodules"), "VTK for Python is not installed (Debian package python3-vtk9)")
class TestVtk(AgainstOurReader):
    def test_Frames_OfMeshAndCracks_AreReadToTheBit(self):
        frames = self.frames("raw") + self.frames("base64")
        run_interpreter(sys.executable, "dump_by_vtk.py", self.top, *(path for _, path in frames))
        for number, (t, path) in enumerate(frames):
            with self.subTest(path=path):
                self.compare_dump(path, t, np.load(self.top / f"{number}.npz"))


if __name__ == "__main__":
    unittest.main()
