"""Reads what a run leaves in its folder: probes.csv, history.csv, summary.json; orders of errors over several runs."""
from __future__ import annotations

import csv
import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_HEADING = re.compile(r"^\s*(?P<name>[^\[]*?)\s*(\[(?P<unit>[^\]]*)\])?\s*$")


@dataclass
class Table:
    """Columns by name, without their unit; `t` (s) is the first."""

    columns: dict[str, Array]
    units: dict[str, str]

    @property
    def t(self) -> Array:
        return self.columns["t"]

    def __getitem__(self, name: str) -> Array:
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}; there are {', '.join(list(self.columns)[:8])}, ...") from None


def read_table(path: Path) -> Table:
    """Reads a table of a run: the first row holds headings "name [unit]", the others numbers."""
    with open(path, newline="") as file:
        headings = next(csv.reader(file))
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    matches = [_HEADING.match(h) for h in headings]
    if any(m is None for m in matches) or values.shape[1] != len(headings):
        raise ValueError(f"{path}: headings and columns do not fit")
    names = [m["name"] for m in matches]
    return Table({n: values[:, i] for i, n in enumerate(names)}, {m["name"]: m["unit"] or "" for m in matches})


def read_summary(folder: Path) -> dict[str, Any]:
    """summary.json of a run's folder; ValueError if the run did not come to its end."""
    summary = json.loads((Path(folder) / "summary.json").read_text())
    if summary.get("status") != "done":
        raise ValueError(f"{folder}: status {summary.get('status')!r}, {summary.get('message', 'no message')}")
    return summary


def find_number(summary: dict[str, Any], name: str) -> float:
    """The number called `name` in a summary, wherever its group; KeyError if there is none or more than one."""
    found = []

    def search(group: dict[str, Any]) -> None:
        for key, value in group.items():
            if isinstance(value, dict):
                search(value)
            elif key == name:
                found.append(value)

    search(summary)
    if len(found) != 1 or not isinstance(found[0], (int, float)):
        raise KeyError(f"{name!r}: found {found} in the summary, expected one number")
    return float(found[0])


def observed_order(sizes: list[float], errors: list[float]) -> float:
    """Slope of log(error) against log(size), by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])
