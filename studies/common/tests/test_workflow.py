"""What steps of workflows follow: the modules that their scripts import, in every study; decks that stay keep their time."""
import modulefinder
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from studies.common.workflow import ROOT, STUDIES, mesh_of, modules_of, write_decks, write_if_new

NAMES = sorted(path.parent.name for path in STUDIES.glob("*/Snakefile"))
SCRIPTS = sorted(STUDIES.glob("*/scripts/*.py"))
SNAKEMAKE = "/usr/bin/snakemake"


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name).resolve()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def put(self, name: str, text: str = "") -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path


class TestModules(InFolder):
    def found(self, script: Path) -> list[str]:
        return [str(Path(file).relative_to(self.folder)) for file in modules_of(script, root=self.folder)]

    def test_Imports_OfEveryForm_AreFollowed(self):
        for name in ("studies/__init__.py", "studies/a/__init__.py", "studies/a/unused.py", "studies/a/deep.py"):
            self.put(name)
        self.put("studies/a/plain.py", "import math\nfrom .relative import x\n")
        self.put("studies/a/relative.py", "from . import sibling\nx = 1\n")
        self.put("studies/a/sibling.py", "import studies.a.plain\n")  # in a circle
        self.put("studies/a/named.py", "def f():\n    from studies.a.deep import y\n")
        script = self.put("studies/a/scripts/s.py", "import numpy\nimport studies.a.plain\nfrom studies.a import named\n")
        self.assertEqual(self.found(script), [f"studies/{name}.py" for name in (
            "__init__", "a/__init__", "a/deep", "a/named", "a/plain", "a/relative", "a/scripts/s", "a/sibling")])

    def test_Scripts_OfAllStudies_ImportWhatPythonFinds(self):
        self.assertGreater(len(SCRIPTS), 10)
        for script in SCRIPTS:
            finder = modulefinder.ModuleFinder([str(ROOT)])
            finder.run_script(str(script))
            expected = {module.__file__ for module in finder.modules.values() if module.__file__}
            with self.subTest(script=script.relative_to(STUDIES)):
                self.assertEqual(set(modules_of(script)), expected)

    def test_Analysis_OfTheBorehole_IsAmongThem(self):
        metrics = modules_of(STUDIES / "borehole/scripts/metrics.py")
        for name in ("borehole/analysis.py", "common/signals.py", "common/results.py"):
            self.assertIn(str(STUDIES / name), metrics)


class TestRules(InFolder):
    def test_EveryStep_OfEveryStudy_FollowsWhatItsScriptImports(self):
        from snakemake.workflow import Workflow

        for name in NAMES:
            file = STUDIES / name / "Snakefile"
            workflow = Workflow(snakefile=str(file), overwrite_config={"program": sys.executable, "profile": "quick",
                                                                       "crosscheck": sys.executable})
            workflow.include(str(file), overwrite_default_target=True)
            called = set()
            for rule in workflow.rules:
                inputs = {str(item) for item in rule.input}
                scripts = {item for item in inputs if Path(item) in SCRIPTS}
                if rule.script:
                    scripts.add(str(file.parent / rule.script))
                called |= scripts
                for script in scripts:
                    with self.subTest(study=name, rule=rule.name):
                        self.assertLessEqual(set(modules_of(Path(script))), inputs)
            self.assertEqual(called, {str(script) for script in SCRIPTS if script.parents[1] == file.parent}, name)

    def test_ModuleThatHasChanged_MakesItsStepsAnew(self):
        self.put("studies/__init__.py")
        module = self.put("studies/shared.py", "VALUE = 1\n")
        self.put("script.py", "from pathlib import Path\nfrom studies.shared import VALUE\n"
                              "Path(snakemake.output[0]).write_text(str(VALUE))\n")
        self.put("Snakefile", f"import sys\nfrom pathlib import Path\nsys.path.insert(0, {str(ROOT)!r})\n"
                              "from studies.common.workflow import modules_of\n"
                              f"root = Path({str(self.folder)!r})\n"
                              "rule all:\n    input: modules_of(root / 'script.py', root=root)\n    output: 'made.txt'\n"
                              "    script: 'script.py'\n")
        command = [SNAKEMAKE, "--cores", "1", "--quiet"]
        environment = os.environ | {"PYTHONPATH": str(self.folder)}
        subprocess.run(command, check=True, capture_output=True, env=environment)
        self.assertEqual(Path("made.txt").read_text(), "1")
        module.write_text("VALUE = 2\n")
        later = time.time() + 5
        os.utime(module, (later, later))
        subprocess.run(command, check=True, capture_output=True, env=environment)
        self.assertEqual(Path("made.txt").read_text(), "2")


class TestDecks(InFolder):
    DECKS = {"one": {"title": "a", "mesh": {"file": "/somewhere/a.geo"}}, "two": {"mesh": {"generator": "rectangle"}}}

    def test_DecksThatStay_KeepTheirTime(self):
        write_decks(self.DECKS, "here")
        for path in self.folder.glob("decks/*"):
            os.utime(path, (1000, 1000))
        write_decks(self.DECKS | {"two": {"mesh": {"generator": "quadrilateral"}}}, "here")
        times = {path.name: path.stat().st_mtime for path in self.folder.glob("decks/*")}
        self.assertEqual(sorted(times), ["one.toml", "two.toml"])
        self.assertEqual(times["one.toml"], 1000)
        self.assertGreater(times["two.toml"], 1000)

    def test_File_WrittenByAnything_IsReplacedWhereItDiffers(self):
        for text in ("a", "a", "b"):
            write_if_new(self.folder / "f/x.json", lambda path, text=text: path.write_text(text))
            self.assertEqual((self.folder / "f/x.json").read_text(), text)
        self.assertEqual(len(list(self.folder.glob("f/*"))), 1)

    def test_Mesh_IsTheFileOfTheDeck(self):
        self.assertEqual(mesh_of(self.DECKS["one"]), ["/somewhere/a.geo"])
        self.assertEqual(mesh_of(self.DECKS["two"]), [])


if __name__ == "__main__":
    unittest.main()
