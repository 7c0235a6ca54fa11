"""What the workflows share: decks that keep their time where they stay the same, and what a step has to follow.

Snakemake makes a step anew where one of its inputs is newer than what it made. A script's own inputs are the files that it
reads and the modules that it imports, those that they import among them.
"""
from __future__ import annotations

import ast
from pathlib import Path
from typing import Callable, Iterable, Mapping

from studies.common.decks import Deck, write_deck

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "studies"


def write_decks(decks: Mapping[str, Deck], written_from: str) -> None:
    """Writes decks/NAME.toml into the present folder. To be called as the workflow is read: whatever a deck is made from, its
    run follows the deck."""
    for name, deck in decks.items():
        write_if_new(Path("decks") / f"{name}.toml",
                     lambda path, deck=deck: write_deck(deck, path, f"Written by the workflow from {written_from}."))


def write_if_new(path: Path, write: Callable[[Path], object]) -> None:
    """Writes a file by `write`. One that stays the same keeps its time."""
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(f".{path.name}.new")
    write(new)
    if path.exists() and path.read_bytes() == new.read_bytes():
        new.unlink()
    else:
        new.rename(path)


def mesh_of(deck: Deck) -> list[str]:
    """The file that a deck has its mesh from, if there is one."""
    return [deck["mesh"]["file"]] if "file" in deck["mesh"] else []


def modules_of(*scripts: Path, root: Path = ROOT) -> list[str]:
    """The scripts and every file of studies/ that they import, directly or not, as sorted absolute paths.

    @param root  folder in which studies/ lies
    """
    found: set[Path] = set()
    waiting = [Path(script).resolve() for script in scripts]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found.add(file)
        for module in _imported(file, root):
            waiting += _files(module, root)
    return sorted(map(str, found))


def _imported(file: Path, root: Path) -> Iterable[str]:
    """Names of what a file imports; of `from a import b` both a and a.b, which may be a module or not."""
    package = list(file.relative_to(root).parts[:-1])
    for node in ast.walk(ast.parse(file.read_text(), str(file))):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            parent = package[:len(package) - node.level + 1] if node.level else []
            module = ".".join(parent + ([node.module] if node.module else []))
            yield module
            yield from (f"{module}.{name.name}" for name in node.names)


def _files(module: str, root: Path) -> list[Path]:
    """The file of a module of studies/, with the __init__.py of every package on the way to it."""
    parts = module.split(".")
    if parts[0] != STUDIES.name:
        return []
    inits = [root.joinpath(*parts[:k], "__init__.py") for k in range(1, len(parts) + 1)]
    return [file for file in [*inits, root.joinpath(*parts).with_suffix(".py")] if file.is_file()]
