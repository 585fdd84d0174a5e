#!/usr/bin/env python3
"""What the strain limiter lends: the rise of energy of hanging sheets that nothing drives, in m g L.

A sheet of 1 m and 33 x 33 samples hangs by two corners and swings for 240 frames. Told is how far kinetic and potential energy
rise beyond their least value so far, the worst of all frames; 0 is right. --passes 0 tells what each method does by itself. The
soft springs of two_level are its own, so its sums hold kinetic energy and height alone.

Usage: bench/limiter_energy.py [--frames 240] [--methods multigrid,desbrun] [--passes N]
"""
import argparse
import csv
import itertools
import json
import pathlib
import sys
import tempfile

import program

METHODS = ("multigrid", "desbrun", "two_level", "two_level as printed", "explicit")
SUBSTEPS, LIMITS, SHEARS, DENSITIES = (4, 16), (0.001, 0.01, 0.05), (0, 20, 200), (0.02, 1)
STRETCH = 2000
# Explicit Euler bears no more at four substeps: N/m a kg/m^2, in both, in proportion.
EXPLICIT_STRETCH_A_DENSITY = 10
EXPLICIT_PASSES = 60
GRAVITY = 9.81


def material_of(method, shear, density, limit):
    stretch = EXPLICIT_STRETCH_A_DENSITY * density if method == "explicit" else STRETCH
    return {"density": density, "stretch": stretch, "shear": shear * stretch / STRETCH, "strain_limit": limit}


def integrator_of(method, passes):
    integrator = {"type": method.split()[0]}
    if method.endswith("as printed"):
        integrator["as_printed"] = True
    if passes is None and method == "explicit":
        passes = EXPLICIT_PASSES
    return integrator if passes is None else {**integrator, "limiter_passes": passes}


def energies(folder, method, density):
    """One a frame [J]; 0 at the start."""
    with open(folder / "frames.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if method.startswith("two_level"):
        return [0] + [float(row["kinetic_energy"]) + density * GRAVITY * float(row["com_y"]) for row in rows]
    return [0] + [float(row["kinetic_energy"]) + float(row["potential_energy"]) for row in rows]


def largest_rise(values):
    least = itertools.accumulate(values, min)
    return max(value - low for value, low in zip(values, least))


def rise_of(method, material, substeps, options):
    scene = {"version": 1, "frames": options.frames, "substeps": substeps, "ground": None,
             "integrator": integrator_of(method, options.passes),
             "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": 33, "material": material, "self_collision": False,
                         "pins": [{"image": [0, 0]}, {"image": [1, 0]}]}]}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(scene))
        _, error = program.run("simulate", folder / "scene.json", "-o", folder / "run", "--threads", 1)
        if error:
            return "runs away" if "ran away" in error else error
        density = material["density"]
        return largest_rise(energies(folder / "run", method, density)) / (density * GRAVITY)


def cell(rise):
    return rise if isinstance(rise, str) else f"{rise:.1e}" if rise < 0.01 else f"{rise:.2f}"


def row_of(method, substeps, limit, options):
    rises = [rise_of(method, material_of(method, shear, density, limit), substeps, options)
             for shear in SHEARS for density in DENSITIES]
    print(method, substeps, limit, *map(cell, rises), file=sys.stderr, flush=True)
    return [method, substeps, f"{100 * limit:g} %", *map(cell, rises)]


def options_of():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--frames", type=int, default=240)
    words.add_argument("--methods", type=lambda text: text.split(","), default=METHODS)
    words.add_argument("--substeps", type=lambda text: [int(word) for word in text.split(",")], default=SUBSTEPS)
    words.add_argument("--passes", type=int, help="of the limiter, instead of each method's own; 0: none")
    return words.parse_args()


def main():
    options = options_of()
    columns = ["method", "substeps", "limit", *(f"shear {shear} N/m, {density} kg/m^2" for shear in SHEARS for density in DENSITIES)]
    print(program.table(columns, [row_of(method, substeps, limit, options) for method in options.methods
                                  for substeps in options.substeps for limit in LIMITS]), end="")


if __name__ == "__main__":
    main()
