"""Decks as nested dictionaries: read, laid over one another, written as TOML."""
from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

Deck = dict[str, Any]


def read_deck(path: Path) -> Deck:
    with open(path, "rb") as file:
        return tomllib.load(file)


def overlaid(deck: Deck, changes: Deck) -> Deck:
    """A copy of the deck with the changes laid over it: tables are merged key by key, everything else is replaced.

    An array of tables takes a table as the change of its first entry.
    """
    result = copy.deepcopy(deck)
    for key, change in changes.items():
        present = result.get(key)
        if isinstance(change, dict) and isinstance(present, dict):
            result[key] = overlaid(present, change)
        elif isinstance(change, dict) and isinstance(present, list) and present and isinstance(present[0], dict):
            result[key][0] = overlaid(present[0], change)
        else:
            result[key] = copy.deepcopy(change)
    return result


def write_deck(deck: Deck, path: Path, comment: str = "") -> None:
    """Writes the deck as TOML, one section per table. Tables inside sections are written in one line."""
    lines = [f"# {line}".rstrip() for line in comment.splitlines()]
    lines += [f"{key} = {_value(value)}" for key, value in deck.items() if not _is_section(value)]
    for key, value in deck.items():
        if _is_section(value):
            for section in value if isinstance(value, list) else [value]:
                lines += ["", f"[[{key}]]" if isinstance(value, list) else f"[{key}]"]
                lines += [f"{name} = {_value(entry)}" for name, entry in section.items()]
    Path(path).write_text("\n".join(lines) + "\n")


def _is_section(value: Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and isinstance(value[0], dict))


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)  # TOML's basic strings escape as JSON's do
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], dict):
            return "[\n" + "".join(f"  {_value(v)},\n" for v in value) + "]"
        return "[" + ", ".join(_value(v) for v in value) + "]"
    raise TypeError(f"a deck holds no {type(value).__name__}")
