#!/usr/bin/env python3
"""Answers the continuous-collision queries of ../shared/ccd; what is missed and what is reported in vain, by file.

Usage: bench/ccd.py [--queries FOLDER] [--write]
"""
import argparse
import json
import pathlib
import subprocess
import sys

import program

COLUMNS = ("file", "queries", "positives", "missed", "false positives", "largest distance reported [m]", "most steps",
           "ns a query")
REPEATS = 5  # the least time counts


def counts_of(paths):
    command = [program.PROGRAM.parent / "weft-ccd", *paths]
    return min((json.loads(subprocess.check_output(command)) for _ in range(REPEATS)), key=lambda c: c["seconds"])


def row(name, counts):
    nanoseconds = 1e9 * counts["seconds"] / counts["queries"]
    return [name, counts["queries"], counts["positives"], counts["missed"], counts["false_positives"],
            f"{counts['largest_distance']:.1e}", counts["steps_max"], f"{nanoseconds:.0f}"]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--queries", type=pathlib.Path, default=program.ROOT.parent / "shared/ccd")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    paths = sorted(options.queries.glob("*.csv"))
    if not paths:
        print(f"bench: error: no queries in {options.queries}", file=sys.stderr)
        return 3
    total = counts_of(paths)
    rows = [row(path.stem, counts_of([path])) for path in paths] + [row("all", total)]
    text = program.table(COLUMNS, rows)
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "ccd", text)
    return 0 if total["missed"] == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
