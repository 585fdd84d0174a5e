#!/usr/bin/env python3
"""Cusick's drape test of every named material and of five fabrics whose drape was measured: drape coefficients, folds.

The five fabrics have B found at one size of image, which the others then drape with.

Usage: bench/drape.py [--sizes 33,65,129] [--fit-size 65] [--starts 20] [--fit-starts 5] [--integrator implicit]
                      [--only NAME,...] [--write]
"""
import argparse
import json
import subprocess
import sys

import program

# Published ranges of the drape coefficient in percent; none: not known.
NAMED = {"cotton": "60 to 76", "silk": "20 to 40", "wool": "40 to 70", "denim": "70 to 90", "leather": "47 to 70",
         "linen": "", "jersey": "", "chiffon": "", "canvas": ""}
# Mass [g/m^2], drape coefficient [%] and its spread between specimens [gong24].
MEASURED = {"cotton, white": (59, 46.1, 4.0), "cotton, blue": (192, 64.4, 4.0), "viscose, white": (213, 15.9, 0.7),
            "cotton, pink": (114, 57.9, 2.9), "wool, red": (274, 77.7, 2.0)}


def drape(options, size, starts, *words):
    command = [program.PROGRAM.parent / "weft_bench_drape", "--size", size, "--starts", starts, *words]
    if options.integrator:
        command += ["--integrator", options.integrator]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stderr.strip(), file=sys.stderr)
        return None
    return json.loads(done.stdout)


def micro(bending):
    warp, weft = (f"{1e6 * value:.3g}" for value in bending)
    return warp if warp == weft else f"{warp} / {weft}"


def cell(result):
    return "-" if result is None else f"{100 * result['coefficient']:.1f} +- {100 * result['spread']:.1f} ({result['folds']:.1f})"


def named_row(options, name):
    results = [drape(options, size, options.starts, "--material", name) for size in options.sizes]
    return results, [name, "", NAMED[name], micro(results[0]["bending"]), *map(cell, results)]


def measured_row(options, name):
    mass, wanted, spread = MEASURED[name]
    fitted = drape(options, options.fit_size, options.fit_starts, "--mass", mass, "--fit", wanted)
    if fitted is None:  # out of reach at that size
        return [], [name, mass, f"{wanted} +- {spread}", "-", *("-" for _ in options.sizes)]
    bending = 1e6 * fitted["bending"][0]
    results = [drape(options, size, options.starts, "--mass", mass, "--bending", bending) for size in options.sizes]
    return results, [name, mass, f"{wanted} +- {spread}", micro(fitted["bending"]), *map(cell, results)]


def parsed():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sizes", type=lambda text: [int(word) for word in text.split(",")], default=[33, 65, 129])
    words.add_argument("--fit-size", type=int, default=65)
    words.add_argument("--starts", type=int, default=20)
    words.add_argument("--fit-starts", type=int, default=5)
    words.add_argument("--integrator", choices=("implicit",), help="instead of the library's default")
    words.add_argument("--only", type=lambda text: text.split(","), help="fabrics; 'measured' stands for the five")
    words.add_argument("--write", action="store_true", help="renew the table of docs/materials.md")
    return words.parse_args()


def main():
    options = parsed()
    rows, restless = [], 0
    columns = ["fabric", "g/m^2", "measured %", "B [uN m]", *(f"{size}: % (folds)" for size in options.sizes)]
    for names, row_of in ((MEASURED, measured_row), (NAMED, named_row)):
        for name in names:
            if options.only and name not in options.only and not (names is MEASURED and "measured" in options.only):
                continue
            results, row = row_of(options, name)
            restless = max([restless, *(result["kinetic_energy"] for result in results)])
            rows.append(row)
            print(program.table(columns, [row]).splitlines()[-1], flush=True)
    text = program.table(columns, rows)
    print(f"\n{text}\nlargest kinetic energy left: {restless:.1e} J")
    if options.write:
        program.write_between_marks("docs/materials.md", "drape", text)


if __name__ == "__main__":
    main()
