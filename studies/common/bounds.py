"""Compares the metrics of a summary.json with what a study has to show. A study's check_metrics.py brings the bounds."""
from __future__ import annotations

import json
import math
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Union

Asked = Union[float, bool, tuple[float, float]]

SKIPPED = "skipped"  # value of a metric whose runs need a program that is not there; the summary's `skipped` says why


def write_summary(path: str | Path, summary: dict[str, Any]) -> None:
    """Writes a study's summary, with the time. JSON has no NaN: what could not be measured is null, and keeps no bound."""
    def strict(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: strict(of) for key, of in value.items()}
        if isinstance(value, (list, tuple)):
            return [strict(of) for of in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    written = strict(summary) | {"written": time.strftime("%Y-%m-%dT%H:%M:%S%z")}
    Path(path).write_text(json.dumps(written, indent=1, allow_nan=False) + "\n")


@dataclass(frozen=True)
class Bound:
    """What is asked of a metric: a number is an upper bound, or a lower one, two are both, True or False the value itself."""

    full: Asked
    quick: Asked
    why_quick: str = ""     # why the coarse study is held to something else
    at_least: bool = False  # the numbers are lower bounds
    may_skip: bool = False  # "skipped" keeps it


def kept(bound: Bound, asked: Asked, measured: object) -> bool:
    """NaN, a missing value or one of another kind keeps no bound."""
    if bound.may_skip and measured == SKIPPED:
        return True
    if isinstance(asked, bool):
        return measured is asked
    if not isinstance(measured, (int, float)) or isinstance(measured, bool) or not math.isfinite(measured):
        return False
    if isinstance(asked, tuple):
        return asked[0] <= measured <= asked[1]
    return measured >= asked if bound.at_least else measured <= asked


def shown(value: object) -> str:
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "missing"}[value]
    if isinstance(value, tuple):
        return " to ".join(shown(v) for v in value)
    return f"{value:.3g}" if isinstance(value, (int, float)) else str(value)


def check(summary: dict, bounds: Mapping[str, Bound]) -> tuple[str, bool]:
    """The table asked/measured, and whether every bound is kept."""
    quick = summary["extent"] == "quick"
    metrics = summary["metrics"]
    lines = [f"{'metric':44} {'asked':>12} {'measured':>12}"]
    good = True
    for name, bound in bounds.items():
        asked = bound.quick if quick else bound.full
        measured = metrics.get(name)
        fine = kept(bound, asked, measured)
        good = good and fine
        wanted = shown(asked) if isinstance(asked, (bool, tuple)) else f"{'>=' if bound.at_least else '<='} {shown(asked)}"
        lines.append(f"{name:44} {wanted:>12} {shown(measured):>12}{'' if fine else '   MISSED'}")
    lines += [f"{name:44} {'reported':>12} {shown(value):>12}" for name, value in metrics.items() if name not in bounds]
    return "\n".join(lines), good


def main(arguments: list[str], bounds: Mapping[str, Bound], usage: str) -> int:
    """The command line of a check_metrics.py: one argument, the summary. Returns the exit status."""
    if len(arguments) != 1:
        print(usage, file=sys.stderr)
        return 2
    summary = json.loads(Path(arguments[0]).read_text())
    table, good = check(summary, bounds)
    print(table)
    if summary["extent"] == "quick" and any(bound.quick != bound.full for bound in bounds.values()):
        print("quick: bounds are wider than those of the full study (check_metrics.py says why)")
    for what in summary.get("skipped", []):
        print(f"skipped: {what}")
    print("every bound is kept" if good else "some bounds are missed")
    return 0 if good else 1
