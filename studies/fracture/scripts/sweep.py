"""Workflow step: runs a deck once for each set of changes and keeps history.csv of each, as 0.csv, 1.csv, ..."""
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

from studies.common.decks import overlaid, read_deck, write_deck

deck, out = read_deck(Path(snakemake.input.deck)), Path(snakemake.output[0]).parent  # noqa: F821
changes = json.loads(Path(snakemake.input.changes).read_text())  # noqa: F821
out.mkdir(parents=True, exist_ok=True)
with tempfile.TemporaryDirectory() as folder:
    variant, run = Path(folder) / "variant.toml", Path(folder) / "run"
    for i, change in enumerate(changes):
        write_deck(overlaid(deck, change), variant)
        subprocess.run([snakemake.input.program, "run", variant, "--out", run, "--threads", "1", "--quiet"],  # noqa: F821
                       check=True)
        shutil.move(run / "history.csv", out / f"{i}.csv")
        shutil.rmtree(run)
Path(snakemake.output[0]).write_text(json.dumps({"runs": len(changes)}) + "\n")  # noqa: F821
