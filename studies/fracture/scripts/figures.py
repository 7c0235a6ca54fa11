"""Workflow step: the figures of one experiment from what it measured."""
import json
from pathlib import Path

from studies.fracture.experiments import EXPERIMENTS

EXPERIMENTS[snakemake.params.experiment].draw(  # noqa: F821
    json.loads(Path(snakemake.input.measured).read_text()), Path("figures"))  # noqa: F821
