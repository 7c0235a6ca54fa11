"""What run.sh shows of a study under way: at once, whatever comes later."""
import select
import subprocess
import unittest
from pathlib import Path

PROGRESS = Path(__file__).parents[1] / "progress.sh"
TALK = """Building DAG of jobs...
Job stats:
Job 3: run isotropic

[Mon Nov 30 03:00:00 2026]
1 of 20 steps (5%) done
Select jobs to execute...
"""


class TestProgress(unittest.TestCase):
    def show(self, text: str) -> list[str]:
        shown = subprocess.run([PROGRESS], input=text, capture_output=True, text=True, check=True)
        return [line.strip() for line in shown.stdout.splitlines()]

    def test_Beginnings_AndHowFar_AreShown_TheRestIsNot(self):
        self.assertEqual(self.show(TALK), ["Job 3: run isotropic", "1 of 20 steps (5%) done"])

    def test_FirstError_ShowsEverythingAfterIt(self):
        self.assertEqual(self.show(TALK + "Error in rule run:\n  log: a.log\nlast without a break")[2:],
                         ["Error in rule run:", "log: a.log", "last without a break"])

    def test_Line_IsShownBeforeTheNextOneIsThere(self):
        with subprocess.Popen([PROGRESS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            process.stdin.write("Job 1: run first\n")
            process.stdin.flush()
            patience = 60  # s; it is there at once, but for a busy machine
            ready, _, _ = select.select([process.stdout], [], [], patience)
            self.assertTrue(ready, "nothing shown while the next line is waited for")
            self.assertEqual(process.stdout.readline().strip(), "Job 1: run first")
            process.stdin.close()


if __name__ == "__main__":
    unittest.main()
