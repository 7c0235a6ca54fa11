"""Headers of the SUNDIALS that is not installed here, made from those that are: of 7.1 from 6.4, of 6.4 from 7.1.

usage: other_api.py INCLUDE_DIR 6|7 OUTPUT_DIR     INCLUDE_DIR: where arkode/arkode.h is; 6|7: what it is to become

What gneiss compiles against them uses no name that only one of the two has, but behind linear/sundials_api.hpp. A
change that matches nothing is an error: the headers are others than the table was written for.
"""

import re
import sys
from pathlib import Path

FOLDERS = ["arkode", "cvode", "ida", "kinsol", "nvector", "sundials", "sunlinsol", "sunmatrix", "sunnonlinsol"]

# Of a stepper's functions 7.1 has kept these, and has changed Resize; all others are ARKODE's there.
OF_A_STEPPER = "Create|ReInit|Resize|Set(?:Explicit|Implicit|ImEx|Table|Coupling|PreInner|PostInner)|Coupling|Inner"

# What it is to become -> (files, pattern, replacement), in this order.
CHANGES = {
    "7": [
        ("*/*.h*", r"\b(real|boolean)type\b", r"sun\1type"),
        ("*/*.h*", r"\b(?:SUN_NLS|SUNLS|SUNMAT)_SUCCESS\b", "SUN_SUCCESS"),
        ("*/*.h", r"SUNDIALS_EXPORT int \w+SetErrFile\([^;]*;", ""),
        ("arkode/arkode_*step.h", rf"\b(?:ARK|MRI)Step(?!{OF_A_STEPPER})(\w+)\(", r"ARKode\1("),
        ("sundials/sundials_context.h", r"(?=SUNDIALS_EXPORT int SUNContext_SetLogger)",
         "SUNDIALS_EXPORT int SUNContext_ClearErrHandlers(SUNContext);\n"),
    ],
    "6": [
        ("*/*.h", r"\bSUN_SUCCESS\b", "SUN_NLS_SUCCESS"),
        ("arkode/*.h", r'SUNDIALS_DEPRECATED_EXPORT_MSG\(\s*"[^"]*"\s*\)', "SUNDIALS_EXPORT"),
        ("arkode/arkode.h", r"SUNDIALS_EXPORT [\w ]+\*? ?ARKode\w+\([^;]*;", ""),
        ("*/*.h", r"(?=SUNDIALS_EXPORT void ?\* ?(ARKStep|MRIStep|CVode|IDA|KIN)Create\()",
         r"SUNDIALS_EXPORT int \1SetErrFile(void*, FILE*);" "\n"),
        ("sundials/sundials_context.h", r"SUNDIALS_EXPORT\s+SUNErrCode SUNContext_ClearErrHandlers\([^;]*;", ""),
    ],
}


def converted(headers, to):
    """`headers`, text by path, with the names of SUNDIALS `to`."""
    headers = dict(headers)
    for files, pattern, replacement in CHANGES[to]:
        found = 0
        for path in [path for path in headers if Path(path).match(files)]:
            headers[path], count = re.subn(pattern, replacement, headers[path])
            found += count
        if found == 0:
            raise ValueError(f"nothing in {files} matches {pattern}: these are headers of another SUNDIALS")
    return headers


def main(include_dir, to, output_dir):
    paths = [path for folder in FOLDERS for path in sorted(Path(include_dir, folder).rglob("*.h*"))]
    headers = {str(path.relative_to(include_dir)): path.read_text() for path in paths}
    for path, text in converted(headers, to).items():
        target = Path(output_dir, path)
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.is_file() or target.read_text() != text:  # what is unchanged is not compiled anew
            target.write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
