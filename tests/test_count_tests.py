"""What tests/run.sh counts, from reports as CTest and GoogleTest write them."""

import tempfile
import unittest
from pathlib import Path

from count_tests import count

CTEST = """<testsuite>
  <testcase name="model" status="run"/>
  <testcase name="program.1" status="fail"/>
  <testcase name="program.2" status="fail"/>
  <testcase name="joints" status="fail"/>
  <testcase name="deck" status="fail"/>
  <testcase name="packages" status="run"/>
  <testcase name="readers.paraview" status="notrun">
    <skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
    <system-out>..\nskipped: no pvpython\nOK</system-out>
  </testcase>
</testsuite>"""
MODEL = """<testsuites><testsuite>
  <testcase name="A_B_C" classname="Model" status="run" result="completed"/>
  <testcase name="A_B_D" classname="Model" status="run" result="skipped"><skipped message="/a/model_test.cpp:7&#x0A;has no rate"/></testcase>
  <testcase name="A_B_E" classname="Model" status="notrun" result="suppressed"/>
</testsuite></testsuites>"""
PROGRAM = """<testsuites><testsuite>
  <testcase name="A/Cst" classname="Every/Program" status="run" result="completed"><failure message=""/></testcase>
  <testcase name="B" classname="Program" status="run" result="completed"/>
</testsuite></testsuites>"""
JOINTS = """<testsuites><testsuite>
  <testcase name="A" classname="Joints" status="run" result="completed"/>
</testsuite></testsuites>"""


class TestCount(unittest.TestCase):
    def test_every_kind(self):
        with tempfile.TemporaryDirectory() as folder:
            reports = Path(folder)
            (reports / "ctest").write_text(CTEST)
            for name, text in (("model", MODEL), ("program.1", PROGRAM), ("joints", JOINTS), ("deck", JOINTS[:60])):
                (reports / f"{name}.xml").write_text(text)
            self.assertEqual(count(reports / "ctest", reports), [
                ("model.Model.A_B_C", "passed"), ("model.Model.A_B_D, has no rate", "skipped"),
                ("program.Every/Program.A/Cst", "failed"), ("program.Program.B", "passed"),
                ("program.2", "failed"),
                ("joints.Joints.A", "passed"), ("joints, whose executable failed after its tests", "failed"),
                ("deck, whose report is not whole", "failed"),
                ("packages", "passed"), ("readers.paraview, no pvpython", "skipped")])


if __name__ == "__main__":
    unittest.main()
