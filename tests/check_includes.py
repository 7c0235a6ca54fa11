#!/usr/bin/env python3
"""Checks the structure of the source tree: who may include whom, length of files, a README.md in every folder.

usage: check_includes.py [ROOT]     exit status 0 and one line, or 1 and one line per finding

The rules are the three tables below; docs/architecture.md says why they are as they are.
"""

import os
import re
import sys
from pathlib import Path

# Folder of a layer -> what its files may include besides themselves: whole layers, or single headers.
# Every folder of src/ is named here; tests may include everything.
POINT = ["materials/point.hpp", "materials/viscous_stress.hpp"]  # what passes between an element and a law
# plain structs that a deck is read into, and the kind of a file that it names
OPTIONS = ["src/mesh/mesh_options.hpp", "src/mesh/mesh_file_kind.hpp", "src/model/options.hpp"]
MAY_INCLUDE = {
    "src/base": [],
    "src/system": ["src/base"],
    "src/linear": ["src/base"],
    "materials": ["src/base"],
    "elements": ["src/base", "src/mesh/composite.hpp", *POINT],
    "src/mesh": ["src/base"],
    "src/model": ["src/base", "src/system", "materials", "elements", "src/mesh"],
    "src/contact": ["src/base", "src/system", "materials", "elements", "src/mesh", "src/model"],
    "src/fracture": ["src/base", "src/system", "materials", "elements", "src/mesh", "src/model"],
    "integrators": ["src/base", "src/system", "src/linear"],
    "src/io/deck": ["src/base", "materials/elastic_constants.hpp", "materials/out_of_plane.hpp", "src/model/formula.hpp",
                    "src/model/formula_grammar.hpp", *OPTIONS],
    "src/io/output": ["src/base"],
    "src/io/report": ["src/base"],
    "src/app": ["src/base", "src/system", "materials", "elements", "src/mesh", "src/model", "src/contact",
                "src/fracture", "integrators", "src/io"],
    "examples": [],  # of an installed gneiss, <gneiss/...>
}

# Headers of other projects that a layer may use; a layer that is not named here may use any.
MAY_USE = {
    "src/base": ["xsimd/"],
    "src/system": [],
}

MAX_LINES = 500  # one sitting
SOURCES = {".cpp", ".hpp", ".py", ".sh", ".cmake", ".smk"}
NOT_OURS = {"build", "results", "__pycache__"}  # and every folder whose name starts with a dot
README_DEPTH = 2  # src/mesh needs one, tests/unit/mesh does not: tests/unit/README.md speaks for it

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
STANDARD = re.compile(r"^([a-z0-9_]+|[a-z]+intrin\.h)$")  # <vector> and intrinsics, but not <fcntl.h>


def source_files(root):
    """All our source files, as sorted paths relative to root."""
    found = []
    for folder, subfolders, names in os.walk(root):
        subfolders[:] = [s for s in subfolders if s not in NOT_OURS and not s.startswith(".")]
        for name in names:
            path = Path(folder, name)
            if path.suffix in SOURCES or name in ("CMakeLists.txt", "Snakefile"):
                found.append(path.relative_to(root))
    return sorted(found)


def layer_of(path):
    """The layer that a file belongs to, or None."""
    return next((layer for layer in MAY_INCLUDE if Path(layer) in path.parents), None)


def resolve(root, name):
    """The file that a quoted include means: a path from the root, or from src/. None if there is no such file."""
    return next((base / name for base in (Path("src"), Path()) if (root / base / name).is_file()), None)


def check_include(root, path, layer, quoted, name):
    """What is wrong with one include of a file of a layer, or None."""
    if not quoted:
        allowed = MAY_USE.get(layer)
        if allowed is not None and not STANDARD.match(name) and not name.startswith(tuple(allowed)):
            return f"{layer} may not use <{name}>, only {', '.join(allowed) or 'the standard library'}"
        return None
    target = resolve(root, name)
    if target is None:
        if "/" not in name and not (root / path.parent / name).exists():
            return None  # written by the build, no file of the tree
        return f'"{name}" is not a path from the root or from src/'
    if layer_of(target) in (layer, None) and target.parts[0] != "tests":
        return None
    for allowed in MAY_INCLUDE[layer]:
        if target == Path(allowed) or Path(allowed) in target.parents:
            return None
    return f'{layer} may not include "{name}"; it may include {", ".join(MAY_INCLUDE[layer]) or "nothing of ours"}'


def check_includes(root, files):
    findings = []
    for path in files:
        layer = layer_of(path)
        if path.suffix not in (".cpp", ".hpp") or path.parts[0] == "tests":
            continue
        if layer is None:
            findings.append(f"{path}: belongs to no layer; give its folder a line in tests/check_includes.py")
            continue
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), start=1):
            match = INCLUDE.match(line)
            if match and (wrong := check_include(root, path, layer, match[1] == '"', match[2])):
                findings.append(f"{path}:{number}: {wrong}")
    return findings


def check_lengths(root, files):
    findings = []
    for path in files:
        lines = len((root / path).read_text(encoding="utf-8").splitlines())
        if lines > MAX_LINES:
            findings.append(f"{path}: {lines} lines, at most {MAX_LINES}: split it by subject")
    return findings


def check_readmes(root, files):
    """Every folder on the way to a source file has a README.md, down to README_DEPTH; the root too."""
    folders = {parent for path in files for parent in path.parents if len(parent.parts) <= README_DEPTH}
    return [f"{folder}: no README.md that says what lives here" for folder in sorted(folders)
            if not (root / folder / "README.md").is_file()]


def check(root):
    """All findings of a tree, one line of text each."""
    root = Path(root)
    files = source_files(root)
    if not files:
        return [f"{root}: no source files: wrong folder?"]
    return check_includes(root, files) + check_lengths(root, files) + check_readmes(root, files)


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    findings = check(root)
    for finding in findings:
        print(finding)
    if not findings:
        print(f"structure: {len(source_files(root))} files, nothing to object to")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
