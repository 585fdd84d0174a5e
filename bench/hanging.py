#!/usr/bin/env python3
"""The hanging sheet: 1 m, 0.2 kg, 2000 N/m, held at two corners, 60 frames of 1/60 s. Speed beside accuracy.

Usage: bench/hanging.py [--sizes 41,81] [--threads 1,2] [--write]
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


def scene_of(size, integrator):
    return {"version": 1, "frames": 60, "ground": None, "integrator": {"type": integrator},
            "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": size, "material": MATERIAL,
                        "pins": [{"image": [0, 0]}, {"image": [1, 0]}]}]}


def row_of(size, integrator, threads):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.json"
        scene.write_text(json.dumps(scene_of(size, integrator)))
        report, error = program.run("simulate", scene, "-o", f"{folder}/run", "--threads", threads)
        worst = 0 if error else program.largest(f"{folder}/run", "strain_p99")
    if error:
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
    options = words.parse_args()
    text = program.table(COLUMNS, [row_of(size, integrator, threads) for integrator, sizes in SIZES.items()
                                   for size in options.sizes or sizes for threads in options.threads])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "hanging", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
