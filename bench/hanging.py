#!/usr/bin/env python3
"""The hanging sheet: 1 m, 0.2 kg, 2000 N/m, held at two corners, 60 frames of 1/60 s. Speed beside accuracy. With --named, of
cotton by the default integrator at all sizes, and of every other named fabric at one of them.

Usage: bench/hanging.py [--named] [--sizes 41,81] [--threads 1,2] [--write]
"""
import argparse
import json
import pathlib
import sys
import tempfile

import program

COLUMNS = ("integrator", "samples", "threads", "ms a frame", "strain p99 %, worst frame", "last", "largest %, worst frame", "last",
           "fall of the centre at frame 30, m", "residual, median", "state hash")
# Beyond, the others take minutes.
SIZES = {"newton": [41, 81, 129, 257, 513], "implicit": [41, 81, 129, 257], "two_level": [41, 81, 129, 257], "multigrid": [41, 81, 129, 257, 513, 1025]}
MATERIAL = {"density": 0.2, "stretch": 2000, "shear": 2000}
NAMED_COLUMNS = ("fabric", "samples", "threads", "ms a frame", "us a particle", "cotton = 1", "iterations a frame",
                 "strain p99 %, worst frame", "fall of the centre at frame 30, m", "energy gained, m g L")
NAMED_SIZES = [41, 65, 81, 129, 257, 513, 1025]
COMPARED_SIZE = 129
OTHERS = ("silk", "wool", "denim", "leather", "linen", "jersey", "chiffon", "canvas")


def run(size, threads, material, integrator="newton"):
    """(report, worst 99th percentile of strain, iterations a frame), or (None, the error, 0)."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.json"
        scene.write_text(json.dumps({
            "version": 1, "frames": 60, "ground": None, "integrator": {"type": integrator},
            "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": size, "material": material,
                        "pins": [{"image": [0, 0]}, {"image": [1, 0]}]}]}))
        report, error = program.run("simulate", scene, "-o", f"{folder}/run", "--threads", threads)
        if error:
            return None, error, 0
        iterations = program.column_of(f"{folder}/run", "iterations")
        return report, program.largest(f"{folder}/run", "strain_p99"), sum(iterations) / len(iterations)


def named_rows(sizes, team_sizes):
    """Of cotton, then of the others at one size, with times over cotton's there."""
    cotton, rows = {}, []
    for fabric, size, threads in [*(("cotton", size, threads) for size in sizes for threads in team_sizes),
                                  *((fabric, COMPARED_SIZE, threads) for fabric in OTHERS for threads in team_sizes)]:
        report, worst, iterations = run(size, threads, fabric)
        if report is None:
            sys.exit(f"hanging: {worst}")
        time, centre = report["ms_per_frame"]["median"], report["centre_of_mass"]
        if fabric == "cotton":
            cotton[size, threads] = time
        over = cotton.get((size, threads))
        rows.append([fabric, f"{size} x {size}", threads, f"{time:.2f}", f"{1000 * time / size**2:.2f}",
                     f"{time / over:.2f}" if over else "", f"{iterations:.1f}", f"{100 * worst:.2f}",
                     f"{centre[0][1] - centre[30][1]:.3f}", f"{report['energy_gained_mgl']:.1e}"])
    return rows


def row_of(size, integrator, threads):
    report, worst, _ = run(size, threads, MATERIAL, integrator)
    if report is None:
        error = worst
        return [integrator, f"{size} x {size}", threads, error.split(": ", 2)[-1]] + [""] * (len(COLUMNS) - 4)
    strain, centre = report["strain"], report["centre_of_mass"]
    return [integrator, f"{size} x {size}", threads, f"{report['ms_per_frame']['median']:.2f}",
            f"{100 * worst:.1f}", f"{100 * strain['p99']:.1f}", f"{100 * report['strain_worst']['max']:.1f}",
            f"{100 * strain['max']:.1f}",
            f"{centre[0][1] - centre[30][1]:.3f}", f"{report['residual']['median']:.1e}", report["state_hash"]]


def numbers(text):
    return [int(word) for word in text.split(",")]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sizes", type=numbers, help="instead of each integrator's own")
    words.add_argument("--threads", type=numbers, default=[1, 2])
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("--named", action="store_true", help="cotton, and the other named fabrics, by the default integrator")
    options = words.parse_args()
    if options.named:
        text = program.table(NAMED_COLUMNS, named_rows(options.sizes or NAMED_SIZES, options.threads))
        print(text)
        if options.write:
            program.write_between_marks("docs/measured.md", "hanging_fabrics", text)
        return 0
    text = program.table(COLUMNS, [row_of(size, integrator, threads) for integrator, sizes in SIZES.items()
                                   for size in options.sizes or sizes for threads in options.threads])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "hanging", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
