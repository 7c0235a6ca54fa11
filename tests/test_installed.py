"""What is installed: a program of somebody else's finds it, links it and computes with it (examples/using_with_cmake)."""
from __future__ import annotations

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ["GNEISS_BUILD"])      # built, with GNEISS_INSTALL
OURS = "base|contact|fracture|io|linear|mesh|model|system|app|elements|materials|integrators"


def run(*command: str | Path, where: Path = ROOT) -> str:
    done = subprocess.run(command, cwd=where, text=True, capture_output=True)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.prefix = Path(cls.folder.name) / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)

    def configure(self, text: str, name: str) -> subprocess.CompletedProcess[str]:
        source = Path(self.folder.name) / name
        source.mkdir()
        (source / "CMakeLists.txt").write_text(text)
        return subprocess.run(["cmake", "-G", "Ninja", "-S", source, "-B", source / "build",
                               f"-DCMAKE_PREFIX_PATH={self.prefix}"], text=True, capture_output=True)

    def test_example_computes_the_wave_of_the_closed_form(self) -> None:
        build = Path(self.folder.name) / "example"
        run("cmake", "-G", "Ninja", "-S", ROOT / "examples/using_with_cmake", "-B", build,
            f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        said = run(build / "pulse")
        kinetic, stored, error = map(float, re.fullmatch(
            r"kinetic (\S+) J, stored (\S+) J, balance error (\S+)\n", said).groups())
        # a wave with the particle velocity p/(rho c): half of its energy p^2 t A/(rho c) is kinetic
        p, rho, speed, area, time = 1e6, 2500, (20e9 / 2500)**0.5, 0.5, 2e-3
        half = 0.5 * p**2 * time * area / (rho * speed)
        dispersion = 0.02      # a front as steep as this mesh carries rings behind itself
        self.assertAlmostEqual(kinetic / half, 1, delta=dispersion)
        self.assertAlmostEqual(stored / half, 1, delta=dispersion)
        self.assertLess(error, 1e-5)    # a hundredth of a step's part of the work, which pressure on a moving end has

    def test_headers_name_no_folder_that_another_project_may_have(self) -> None:
        headers = list((self.prefix / "include").rglob("*.hpp"))
        self.assertGreater(len(headers), 150)
        self.assertEqual([path.name for path in (self.prefix / "include").iterdir()], ["gneiss"])
        for header in headers:
            self.assertIsNone(re.search(rf'#include "({OURS})/', header.read_text()), header)

    def test_every_header_that_one_includes_is_there(self) -> None:
        for header in (self.prefix / "include").rglob("*.hpp"):
            for included in re.findall(r'#include "(.*)"', header.read_text()):
                self.assertTrue((self.prefix / "include" / included).exists(), f"{header}: {included}")

    def test_whoever_links_gets_the_architecture_and_no_warnings_of_ours(self) -> None:
        targets = (self.prefix / "lib").rglob("gneissTargets.cmake")
        options = re.findall(r"INTERFACE_COMPILE_OPTIONS \"(.*)\"", "".join(path.read_text() for path in targets))
        self.assertTrue(any("-march=" in option for option in options), options)
        self.assertFalse(any("-Werror" in option or "-Wall" in option for option in options), options)

    def test_unknown_component_is_named(self) -> None:
        done = self.configure("cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
                              "find_package(gneiss REQUIRED COMPONENTS solid beams)\n", "unknown")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("gneiss has no component beams", done.stderr)

    def test_program_runs_where_it_was_installed(self) -> None:
        self.assertIn("central_difference", run(self.prefix / "bin/gneiss", "list"))


if __name__ == "__main__":
    unittest.main()
