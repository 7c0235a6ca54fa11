"""A run of gneiss whose files are compared, bit by bit, with what a reader of others finds in them."""
import os
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

from studies.common.fields import read_vtu

# A plate in plane strain that is pulled apart: no crack in the first frame, some in the last one.
DECK = """
title = "a plate torn apart, for readers"
mesh = { generator = "rectangle", width = 0.04, height = 0.02, cells = [8, 4] }
solid = { plane = "strain", element = "compt" }
boundary = [{ on = "left", type = "velocity", value = [-2, 0] }, { on = "right", type = "velocity", value = [2, 0] }]
initial = [{ velocity = ["100*(x - 0.02)", 0] }]
fracture = { method = "intrinsic" }
run = { t_end = 4e-5 }
output = { fields = 1e-5 }

[[material]]
density = 2500
constants = { E_alpha = 30e9, E_beta = 20e9, nu_alpha_beta = 0.25, nu_p_alpha = 0.15, G = 9e9 }
axes = { angle = 0.3 }
strength = { tensile = 10e6, cohesion = 30e6, friction = 0.6, residual_friction = 0.4, G_I = 20, G_II = 60 }
"""

UNITS = {"TimeValue": "s", "Points": "m", "displacement": "m", "velocity": "m/s", "speed": "m/s",
         "cauchy_stress": "Pa", "munjiza_stress": "Pa", "end_opening": "m", "time_of_failure": "s", "penalty": "Pa/m",
         "dissipated_fracture": "J/m2"}


class AgainstOurReader(unittest.TestCase):
    """The files of one run, for all tests of a class."""

    @classmethod
    def setUpClass(cls):
        cls.top = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="gneiss_readers_")))
        (cls.top / "case.toml").write_text(DECK)
        for data in ("raw", "base64"):
            subprocess.run([os.environ["GNEISS_PROGRAM"], "run", cls.top / "case.toml", "--out", cls.top / data, "--quiet",
                            "--set", f"output.vtu_data={data}"], check=True, timeout=250)

    def series(self, name, data):
        """Times (s) and files of NAME.pvd; more than one frame."""
        folder = self.top / data
        entries = list(ElementTree.parse(folder / f"{name}.pvd").getroot().iter("DataSet"))
        self.assertGreater(len(entries), 2)
        return [(float(entry.attrib["timestep"]), folder / entry.attrib["file"]) for entry in entries]

    def frames(self, data):
        """All frames of a run; those of cracks begin without any cell."""
        frames = self.series("fields", data) + self.series("cracks", data)
        first, *_, last = self.series("cracks", "raw")
        self.assertEqual(len(read_vtu(first[1]).types), 0)
        self.assertGreater(len(read_vtu(last[1]).types), 0)
        return frames

    def expected_in(self, path):
        """What a file holds, by our reader, which reads the raw ones; the runs are the same to the bit."""
        return read_vtu(self.top / "raw" / path.name)

    def compare(self, path, points, connectivity, point_data, cell_data):
        """What another reader has found in a file."""
        ours = self.expected_in(path)
        np.testing.assert_array_equal(np.asarray(points)[:, :2], ours.points)
        np.testing.assert_array_equal(np.ravel(connectivity), ours.connectivity)
        for found, expected in ((point_data, ours.point_data), (cell_data, ours.cell_data)):
            self.assertEqual(sorted(found), sorted(expected))
            for name, values in expected.items():
                self.assertEqual(found[name].dtype, values.dtype, name)
                np.testing.assert_array_equal(found[name], values, err_msg=name)

    def compare_dump(self, path, t, dump):
        """The same for what dump_by_vtk.py wrote; names of components and units too."""
        part = {key: {name.split(":", 1)[1]: dump[name] for name in dump.files if name.startswith(key + ":")}
                for key in ("point", "cell", "unit", "names")}
        self.compare(path, dump["points"], dump["connectivity"], part["point"], part["cell"])
        self.assertEqual(float(dump["time"]), t)
        for name, unit in part["unit"].items():
            if name in UNITS:
                self.assertEqual(str(unit), UNITS[name], name)
        if "cauchy_stress" in part["cell"]:
            self.assertEqual(str(part["names"]["cauchy_stress"]), "XX YY ZZ XY YZ XZ")
            self.assertEqual(str(part["unit"]["cauchy_stress"]), "Pa")


def run_interpreter(interpreter, script, *arguments):
    """Runs a script of this folder by another interpreter; its errors are ours."""
    done = subprocess.run([interpreter, Path(__file__).with_name(script), *arguments], capture_output=True, text=True,
                          timeout=250)
    if done.returncode != 0:
        raise AssertionError(f"{interpreter} {script}: {done.stdout}{done.stderr}")
