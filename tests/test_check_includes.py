"""The structure check finds what it is there to find."""

import tempfile
import unittest
from pathlib import Path

import check_includes

SOUND = {
    "README.md": "",
    "src/README.md": "",
    "src/base/README.md": "",
    "src/base/errors.hpp": "#include <vector>\n#include <xsimd/xsimd.hpp>\n",
    "src/system/README.md": "",
    "src/system/state.hpp": '#include "base/errors.hpp"\n#include "generated_by_the_build.hpp"\n',
    "src/mesh/README.md": "",
    "src/mesh/composite.hpp": "",
    "src/mesh/mesh.hpp": '#include "mesh/composite.hpp"\n',
    "src/model/README.md": "",
    "src/model/options.hpp": "",
    "src/model/solid.hpp": '#include "elements/cst.hpp"\n#include "mesh/mesh.hpp"\n#include <gmsh.h>\n',
    "elements/README.md": "",
    "elements/cst.hpp": '#include "mesh/composite.hpp"\n',
    "integrators/README.md": "",
    "integrators/leapfrog.cpp": '#include "system/state.hpp"\n',
    "src/io/README.md": "",
    "src/io/deck/deck.hpp": '#include "model/options.hpp"\n',
    "src/app/README.md": "",
    "src/app/main.cpp": '#include "io/deck/deck.hpp"\n',
    "tests/README.md": "",
    "tests/unit/README.md": "",
    "tests/unit/mesh/test_mesh.cpp": '#include "model/solid.hpp"\n',
    "build/release/wrong.cpp": '#include "no/such.hpp"\n',
}


class StructureCheck(unittest.TestCase):
    def findings(self, changes):
        """Findings in the sound tree after `changes`: path -> text, or None to leave the file out."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in {**SOUND, **changes}.items():
                if text is not None:
                    target = Path(folder, path)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_text(text, encoding="utf-8")
            return check_includes.check(folder)

    def assert_only_finding(self, changes, *words):
        findings = self.findings(changes)
        self.assertEqual(len(findings), 1, findings)
        for word in words:
            self.assertIn(word, findings[0])

    def test_sound_tree_has_no_findings(self):
        self.assertEqual(self.findings({}), [])

    def test_every_forbidden_direction_is_found(self):
        for path, target in [
            ("src/base/a.hpp", "system/state.hpp"),
            ("src/system/a.hpp", "model/options.hpp"),
            ("elements/a.hpp", "mesh/mesh.hpp"),
            ("elements/a.hpp", "system/state.hpp"),
            ("src/mesh/a.cpp", "model/options.hpp"),
            ("src/model/a.cpp", "io/deck/deck.hpp"),
            ("integrators/a.cpp", "elements/cst.hpp"),
            ("integrators/a.cpp", "model/options.hpp"),
            ("integrators/a.cpp", "mesh/composite.hpp"),
            ("src/io/deck/a.cpp", "mesh/mesh.hpp"),
            ("src/io/output/a.cpp", "model/options.hpp"),
            ("src/mesh/a.cpp", "io/deck/deck.hpp"),
        ]:
            with self.subTest(path=path, target=target):
                self.assert_only_finding({path: f'\n#include "{target}"\n'}, f"{path}:2:", target, "may not include")

    def test_spelling_of_the_include_does_not_hide_it(self):
        self.assert_only_finding({"src/system/a.hpp": '  #  include "src/model/options.hpp"\n'}, "may not include")

    def test_include_that_is_no_path_from_the_root_is_found(self):
        self.assert_only_finding({"src/model/a.cpp": '#include "solid.hpp"\n'}, "src/model/a.cpp:1:", "solid.hpp")
        self.assert_only_finding({"src/model/a.cpp": '#include "model/gone.hpp"\n'}, "model/gone.hpp")

    def test_folder_without_a_layer_is_found(self):
        self.assert_only_finding({"src/new/a.hpp": "", "src/new/README.md": ""}, "src/new/a.hpp", "no layer")

    def test_sources_do_not_include_tests(self):
        self.assert_only_finding(
            {"src/model/a.cpp": '#include "tests/support/bar.hpp"\n', "tests/support/bar.hpp": "",
             "tests/support/README.md": ""}, "tests/support/bar.hpp")

    def test_foreign_library_in_base_is_found(self):
        self.assert_only_finding({"src/base/a.hpp": "#include <fmt/format.h>\n"}, "<fmt/format.h>", "xsimd/")

    def test_long_file_is_found(self):
        lines = check_includes.MAX_LINES
        self.assertEqual(self.findings({"elements/cst.cpp": "\n" * lines}), [])
        self.assert_only_finding({"elements/cst.cpp": "\n" * (lines + 1)}, "elements/cst.cpp", str(lines + 1))

    def test_missing_readme_is_found(self):
        for folder in ("src/", "src/mesh/", "elements/", ""):
            with self.subTest(folder=folder):
                self.assert_only_finding({folder + "README.md": None}, (folder or ".").rstrip("/"), "README.md")

    def test_wrong_folder_is_a_finding(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("wrong folder", check_includes.check(folder)[0])


if __name__ == "__main__":
    unittest.main()
