"""cmake/install_debian_packages.sh against a Debian of scripts that stand in for apt-get, apt-cache and dpkg-query."""
from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[1] / "cmake/install_debian_packages.sh"
INSTALLED = "installed"     # in the folder of the scripts: packages that are there, one per line
CALLS = "calls"             # what apt-get was asked for

DPKG_QUERY = """#!/bin/bash
printf '%s\\n' "$@" | grep -xFf "$here/installed" | sed 's/^/installed /'
"""
APT_CACHE = """#!/bin/bash
! grep -qx -- "${@: -1}" "$here/unknown" 2>/dev/null
"""
APT_GET = """#!/bin/bash
echo "$*" >>"$here/calls"
packages=()
simulate=0
while [[ $# -gt 0 ]]; do
    case $1 in
        -s) simulate=1 ;;
        -o) shift ;;
        -*) ;;
        update) exit 0 ;;
        install) ;;
        *) packages+=("$1") ;;
    esac
    shift
done
if ((simulate)); then
    cat "$here/removals" 2>/dev/null
    printf 'Inst %s (1 Debian)\\n' "${packages[@]}"
else
    echo "what packages say while they are set up"
    [[ -f /dev/stdout ]] || { echo "stdout is no file" >&2; exit 100; }
    for percent in 0 4.2 50 100; do
        echo "pmstatus:somepackage:$percent:Installing" >&3
    done
    printf '%s\\n' "${packages[@]}" >>"$here/installed"
fi
"""
SUDO = """#!/bin/bash
[[ $1 != -n ]] || shift
exec "$@"
"""


class Machine(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = Path(folder.name)
        for name, text in {"dpkg-query": DPKG_QUERY, "apt-cache": APT_CACHE, "apt-get": APT_GET, "sudo": SUDO}.items():
            (self.here / name).write_text(text)
            (self.here / name).chmod(0o755)
        (self.here / INSTALLED).write_text("")
        (self.here / CALLS).write_text("")

    def install(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        environment = os.environ | {"here": str(self.here), "TMPDIR": str(self.here),
                                    "PATH": f"{self.here}:{os.environ['PATH']}"}
        return subprocess.run([SCRIPT, *arguments], env=environment, text=True, stdin=subprocess.DEVNULL,
                              capture_output=True)

    def packages(self, *arguments: str) -> list[str]:
        done = self.install("--list", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()

    def installed(self) -> list[str]:
        return (self.here / INSTALLED).read_text().split()

    def test_sets_are_nested_and_a_run_asks_for_no_test_library(self) -> None:
        build, run, crosscheck, tests = (self.packages(name) for name in ("build", "run", "crosscheck", "tests"))
        self.assertLess(set(build), set(run))
        self.assertEqual(set(run) - set(build), {"python3-numpy", "python3-scipy", "python3-matplotlib", "snakemake"})
        self.assertLess(set(run), set(crosscheck))
        self.assertLess(set(crosscheck), set(tests))
        self.assertEqual(self.packages(), tests)
        self.assertFalse({"libgtest-dev", "libgmock-dev", "libbenchmark-dev", "libdeal.ii-dev"} & set(run))
        self.assertEqual(set(crosscheck) - set(run), {"libdeal.ii-dev"})

    def test_bare_machine_gets_its_set_and_nothing_else(self) -> None:
        done = self.install("run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(self.installed()), sorted(self.packages("run")))

    def test_progress_is_shown_in_tenths_and_what_packages_say_is_not(self) -> None:
        done = self.install("run")
        self.assertEqual(done.returncode, 0, done.stderr)
        shown = [line.split()[-2] for line in done.stdout.splitlines() if "installed" in line]
        self.assertEqual(shown, ["0", "50", "100"])
        self.assertNotIn("what packages say", done.stdout)

    def test_what_is_there_is_not_asked_for_again(self) -> None:
        run = self.packages("run")
        (self.here / INSTALLED).write_text("\n".join(run) + "\n")
        done = self.install("run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.here / CALLS).read_text(), "")
        (self.here / INSTALLED).write_text("\n".join(run[1:]) + "\n")
        self.assertEqual(self.install("run").returncode, 0)
        self.assertEqual(self.installed(), [*run[1:], run[0]])

    def test_package_of_the_user_would_go_nothing_is_done(self) -> None:
        (self.here / "removals").write_text("Remv python3-paraview [5.11.0] (1 Debian)\nRemv paraview [5.11.0]\n")
        done = self.install("run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("would remove python3-paraview paraview: nothing was done", done.stderr)
        self.assertEqual(self.installed(), [])

    def test_package_that_no_archive_has_is_named(self) -> None:
        (self.here / "unknown").write_text("snakemake\n")
        done = self.install("run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt's lists do not have snakemake", done.stderr)
        self.assertEqual(self.installed(), [])

    def test_unknown_set_is_wrong_use(self) -> None:
        for arguments in (["everything"], ["run", "tests"], ["--list", "all"]):
            done = self.install(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("usage:", done.stderr)


if __name__ == "__main__":
    unittest.main()
