"""What the figures of the study share: names in words, and which case a file belongs to."""
from __future__ import annotations

from pathlib import Path

from studies.borehole.cases import PLANS, Case
from studies.common import style

TITLES = {"horizontal": "horizontal", "turned": "45°", "general": "general #1", "general_turned": "general #2"}
COLOURS = {"horizontal": style.BLUE, "turned": style.ORANGE, "general": style.GREEN, "general_turned": style.RED}

_BY_NAME = {case.name: case for plan in PLANS.values() for case in plan.all_cases()}


def case_of_file(path: str | Path) -> Case:
    """The case whose name is that of the file or of its folder."""
    path = Path(path)
    return _BY_NAME[path.stem if path.stem in _BY_NAME else path.parent.name]


def materials_title(case: Case) -> str:
    return f"{case.material} material, ν = {case.nu:.2f}, sub-edges of {case.sub_edge_mm} mm"
