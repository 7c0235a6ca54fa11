"""Workflow step: what one experiment measures from its runs, into a JSON file."""
import json
from pathlib import Path

from studies.fracture.experiments import EXPERIMENTS

module = EXPERIMENTS[snakemake.wildcards.experiment]  # noqa: F821
Path(snakemake.output[0]).write_text(json.dumps(  # noqa: F821
    module.measure(Path("cases"), snakemake.params.profile)))  # noqa: F821
