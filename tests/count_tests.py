"""Counts what CTest ran: a GoogleTest each for itself, from the reports of their executables; everything else as one.

usage: count_tests.py CTEST_REPORT REPORTS
    CTEST_REPORT  what `ctest --output-junit` wrote
    REPORTS       folder of the executables' reports: NAME.xml of the CTest test NAME

Prints "PASSED FAILED SKIPPED", then a line for every test that failed or was skipped, with the reason where it gave one.
An executable that ended before its report counts as one failure.
"""

import sys
import xml.etree.ElementTree as xml
from pathlib import Path


def of_executable(report):
    """(name, outcome) of every GoogleTest in a report."""
    for case in xml.parse(report).iter("testcase"):
        name = f"{report.stem.split('.')[0]}.{case.get('classname')}.{case.get('name')}"
        if case.get("status") != "run":
            continue  # filtered out or another shard's
        if case.find("failure") is not None:
            yield name, "failed"
        elif case.get("result") == "skipped":
            reason = case.find("skipped").get("message", "").splitlines()[1:]  # the first line is where
            yield ", ".join([name, *filter(None, reason)]), "skipped"
        else:
            yield name, "passed"


def of_other(case):
    """(text, outcome) of a test that is no GoogleTest."""
    name, skip = case.get("name"), case.find("skipped")
    if case.get("status") == "disabled" or skip is not None and "SKIP" in skip.get("message", ""):
        lines = case.findtext("system-out", "").splitlines()  # a test may say why: "skipped: REASON"
        reasons = [line.removeprefix("skipped: ") for line in lines if line.startswith("skipped: ")]
        return ", ".join([name, *reasons]), "skipped"
    return name, "passed" if case.get("status") == "run" else "failed"


def count(ctest_report, reports):
    """(text, outcome) of every test."""
    found = []
    for case in xml.parse(ctest_report).iter("testcase"):
        name, report = case.get("name"), reports / f"{case.get('name')}.xml"
        text, outcome = of_other(case)
        if not report.exists():
            found.append((text, outcome))
            continue
        try:
            tests = list(of_executable(report))
        except xml.ParseError:
            found.append((f"{name}, whose report is not whole", "failed"))
            continue
        found += tests
        if outcome == "failed" and not any(result == "failed" for _, result in tests):
            found.append((f"{name}, whose executable failed after its tests", outcome))
    return found


def main(ctest_report, reports):
    tests = count(ctest_report, Path(reports))
    print(*(sum(outcome == each for _, outcome in tests) for each in ("passed", "failed", "skipped")))
    for each in ("failed", "skipped"):
        for text, outcome in tests:
            if outcome == each:
                print(f"      {each}: {text}")


if __name__ == "__main__":
    main(*sys.argv[1:])
