#!/usr/bin/env python3
"""Sews a pattern on a body at several spacings and lets it come to rest: how long that takes, and how much memory.

Usage: bench/at_rest.py [--pattern FILE] [--body FILE] [--threads N] [--write] [SPACING ...]
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import program

SHARED = program.ROOT.parent / "shared"
COLUMNS = ("spacing mm", "particles", "seams closed", "closed in frame", "frames until rest", "seconds, loading and export included",
           "ms per frame, median", "peak memory MB", "strain p99 %", "intersections in any frame")


def run(spacing, options, folder):
    """(report, errors, seconds, peak memory in MB)."""
    out = pathlib.Path(folder, f"{spacing:g}")
    words = [program.PROGRAM, "garment", options.pattern, "--body", options.body, "-o", out, "--spacing", spacing,
             "--threads", options.threads, "--json"]
    begin = time.monotonic()
    with open(f"{out}.json", "w+", encoding="utf-8") as report, open(f"{out}.txt", "w+", encoding="utf-8") as errors:
        child = subprocess.Popen(list(map(str, words)), stdout=report, stderr=errors)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        report.seek(0)
        errors.seek(0)
        return json.loads(report.read()), errors.read(), time.monotonic() - begin, used.ru_maxrss / 1000


def row_of(spacing, options, folder):
    report, errors, seconds, megabytes = run(spacing, options, folder)
    seams, rests = report["seams"], "at rest in frame" in errors
    return [f"{spacing:g}", report["particles"], f"{seams['closed']} of {seams['count']}", seams["frames"],
            report["frames"] if rests else f"moves after {report['frames']}", f"{seconds:.0f}",
            f"{report['ms_per_frame']['median']:.0f}", f"{megabytes:.0f}", f"{100 * report['strain']['p99']:.2f}",
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
