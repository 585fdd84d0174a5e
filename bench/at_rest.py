#!/usr/bin/env python3
"""Sews a pattern on a body at several spacings and lets it come to rest: how long that takes, and how much memory.

Usage: bench/at_rest.py [--pattern FILE] [--body FILE] [--threads N] [--write] [SPACING ...]
"""
import argparse
import os
import pathlib
import sys
import tempfile
import time

import program

SHARED = program.ROOT.parent / "shared"
COLUMNS = ("spacing mm", "particles", "seams closed", "closed in frame", "frames until rest", "seconds, loading and export included",
           "ms per frame, median", "peak memory MB", "strain p99 %", "intersections in any frame")


def row_of(spacing, options, folder):
    words = ["garment", options.pattern, "--body", options.body, "--spacing", spacing, "--threads", options.threads]
    begin = time.monotonic()
    report, errors, used = program.run_measured(words, pathlib.Path(folder, f"{spacing:g}"))
    seconds = time.monotonic() - begin
    if report is None:
        return [f"{spacing:g}", errors.splitlines()[-1]] + [""] * (len(COLUMNS) - 2)
    seams, rests = report["seams"], "at rest in frame" in errors
    return [f"{spacing:g}", report["particles"], f"{seams['closed']} of {seams['count']}", seams["frames"],
            report["frames"] if rests else f"moves after {report['frames']}", f"{seconds:.0f}",
            f"{report['ms_per_frame']['median']:.0f}", f"{used.ru_maxrss / 1000:.0f}", f"{100 * report['strain']['p99']:.2f}",
            sum(report["intersections_found"][kind] for kind in ("self", "cloths", "bodies", "ground"))]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--pattern", type=pathlib.Path, default=SHARED / "patterns/tshirt.json")
    words.add_argument("--body", type=pathlib.Path, default=SHARED / "bodies/mean_all.obj")
    words.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("spacings", type=float, nargs="*", metavar="SPACING", help="[mm], 8 and 4 where none is given")
    options = words.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        text = program.table(COLUMNS, [row_of(spacing, options, folder) for spacing in options.spacings or (8, 4)])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "at_rest", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
