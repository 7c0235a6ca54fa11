"""Workflow step: every figure of the study."""
from pathlib import Path

from studies.blast.figures import draw

draw(Path("cases"), Path("figures"))
