"""Workflow step: the metrics of all experiments and the cost of their runs, into summary.json. README.md defines each."""
import json
from pathlib import Path

from studies.common.bounds import write_summary

metrics, wall = {}, {}
for path in map(Path, snakemake.input.measured):  # noqa: F821
    for name, value in json.loads(path.read_text())["metrics"].items():
        if name in metrics:
            raise ValueError(f"two experiments measure {name}")
        metrics[name] = value
for path in map(Path, snakemake.input.runs):  # noqa: F821
    wall[path.parent.name] = json.loads(path.read_text())["timings"]["wall_s"]
write_summary(snakemake.output[0], {  # noqa: F821
    "study": "fracture", "extent": snakemake.params.profile, "metrics": metrics,  # noqa: F821
    "checked": [Path(path).stem for path in snakemake.input.checked],  # noqa: F821
    "wall_s": wall,
})
