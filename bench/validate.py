#!/usr/bin/env python3
"""Runs the tests that compare with known values, the long ones too, and lists what they measured.

Usage: bench/validate.py [--write]
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import program

PROGRAMS = ("test_cloth", "test_sim")
COLUMNS = ("check", "wanted", "measured", "tolerance", "verdict")


def rows_of(report):
    """The rows that tests recorded: name|wanted|measured|tolerance."""
    for suite in report["testsuites"]:
        for test in suite["testsuite"]:
            for value in test.values():
                if isinstance(value, str) and value.count("|") == 3:
                    yield value.split("|")


def run(name, folder):
    """The rows of a test program's validation suite, in its order."""
    path = program.ROOT / "build/release/bin" / name
    out = pathlib.Path(folder) / f"{name}.json"
    subprocess.run([path, "--gtest_filter=Validation*", "--gtest_also_run_disabled_tests", f"--gtest_output=json:{out}"],
                   stdout=subprocess.DEVNULL, check=False)
    if not out.is_file():
        sys.exit(f"bench: error: {path}: no report; ./dev setup and ./dev build release first")
    return list(rows_of(json.loads(out.read_text())))


def judged(row):
    name, wanted, measured, tolerance = row
    good = abs(float(measured) - float(wanted)) <= float(tolerance)
    return [name, *(f"{float(value):.6g}" for value in (wanted, measured, tolerance)), "holds" if good else "**fails**"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        rows = [judged(row) for name in PROGRAMS for row in run(name, folder)]
    text = program.table(COLUMNS, rows)
    print(text, end="")
    if options.write:
        program.write_between_marks("docs/measured.md", "validate", text)
    if any(row[-1] != "holds" for row in rows):
        sys.exit("bench: error: a check fails")


if __name__ == "__main__":
    main()
