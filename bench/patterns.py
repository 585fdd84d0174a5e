#!/usr/bin/env python3
"""Sews every pattern of a folder on a body: what closed, what it took, what passed through what. A run is a process of one thread.
Pictures of the last frames, front and back, go to out/patterns.

Usage: bench/patterns.py [--patterns FOLDER] [--body FILE] [--frames N] [--jobs N] [--write] [NAME ...]
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import program

SHARED = program.ROOT.parent / "shared"
COLUMNS = ("pattern", "panels", "particles", "seams closed", "largest gap mm", "closed in frame", "processor seconds",
           "strain p99 %, worst frame", "last", "intersections in any frame", "fell off")


def run(pattern, options, folder):
    """(report or None, errors, processor seconds)."""
    words = ["garment", pattern, "--body", options.body, "--frames", options.frames, "--threads", 1, "--verify", "--quiet"]
    report, errors, used = program.run_measured(words, pathlib.Path(folder, pattern.stem))
    return report, errors, used.ru_utime + used.ru_stime


def draw(run_folder, options):
    for side, azimuth in (("front", 20), ("back", 200)):
        subprocess.run([program.PROGRAM, "render", run_folder, "-o", options.pictures / f"{run_folder.name}.{side}.png",
                        "--azimuth", str(azimuth), "--width", "480", "--height", "720"], check=True, stdout=subprocess.DEVNULL)


def row_of(pattern, options, folder):
    name = pattern.stem.removesuffix("_specification")
    panels = len(json.loads(pattern.read_text())["pattern"]["panels"])
    report, errors, seconds = run(pattern, options, folder)
    if report is None:
        return [name, panels, errors.splitlines()[-1].split(": ", 2)[-1]] + [""] * (len(COLUMNS) - 3)
    draw(pathlib.Path(folder, pattern.stem), options)
    seams, frames = report["seams"], report["seams"]["frames"]
    worst = program.largest(pathlib.Path(folder, pattern.stem), "strain_p99")
    return [name, panels, report["particles"], f"{seams['closed']} of {seams['count']}", f"{seams['largest_gap_mm']:.1f}",
            "" if frames is None else frames, f"{seconds:.0f}", f"{100 * worst:.1f}", f"{100 * report['strain']['p99']:.1f}",
            sum(report["intersections_found"][kind] for kind in ("self", "cloths", "bodies", "ground")),
            ", ".join(report["fell_off"])]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--patterns", type=pathlib.Path, default=SHARED / "patterns")
    words.add_argument("--body", type=pathlib.Path, default=SHARED / "bodies/mean_all.obj")
    words.add_argument("--frames", type=int, default=120)
    words.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    words.add_argument("--pictures", type=pathlib.Path, default=program.ROOT / "out/patterns")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*")
    options = words.parse_args()
    options.pictures.mkdir(parents=True, exist_ok=True)
    patterns = [p for p in sorted(options.patterns.glob("*.json")) if not options.names or p.stem in options.names]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        text = program.table(COLUMNS, pool.map(lambda pattern: row_of(pattern, options, folder), patterns))
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "patterns", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
