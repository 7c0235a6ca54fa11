"""Complex frequencies, and the asymmetry of the stiffness, of a case's mesh and element for the Poisson's ratios of the study.

usage: eigenvalues.py PROGRAM CASE.toml OUT.json

OUT.json maps each ratio to {"omega": [[Re omega, Im omega], ...] rad/s, "asymmetry": of the largest entry}.
"""
from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from studies.common.matrices import read_system
from studies.locking.cases import SIDE_MODULUS, SIDE_RATIOS
from studies.common.spectrum import asymmetry, frequencies


def main(program: str, deck: str, out: str) -> None:
    found = {}
    for nu in SIDE_RATIOS:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "matrices", deck, "--threads", "1", "--out", folder, "--set",
                            f"material.0.constants={{ E = {SIDE_MODULUS}, nu = {nu} }}"], check=True)
            system = read_system(Path(folder))
            found[f"{nu:g}"] = {"omega": [[omega.real, omega.imag] for omega in frequencies(system)],
                                "asymmetry": asymmetry(system)}
    Path(out).write_text(json.dumps(found) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
