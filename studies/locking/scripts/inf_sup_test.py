"""The inf-sup constant of a case's mesh and element.

usage: inf_sup_test.py PROGRAM CASE.toml OUT.json [--all-eigenvalues]
"""
from __future__ import annotations

import dataclasses
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from studies.locking.inf_sup import NORM_CONSTANTS, inf_sup


def main(program: str, deck: str, out: str, *options: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for M_v in (0.0, 1.0):
            constants = ", ".join(f"{name} = {value}" for name, value in ({"M_v": M_v} | NORM_CONSTANTS).items())
            subprocess.run([program, "matrices", deck, "--threads", "1", "--out", f"{folder}/{M_v:g}", "--set",
                            f"material.0.constants={{ {constants} }}"], check=True)
        found = inf_sup(Path(folder) / "0", Path(folder) / "1", "--all-eigenvalues" in options)
    Path(out).write_text(json.dumps(dataclasses.asdict(found)) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
