#!/usr/bin/env python3
"""Cusick's drape test of every named material and of five fabrics whose drape was measured: drape coefficients and folds with
the default integrator, and with a hundredth of its tolerance beside that.

The five fabrics have B found at one size of image, which the others then drape with.

Usage: bench/drape.py [--sizes 33,65,129] [--tight-sizes 33] [--starts 5] [--fit-size 33] [--fit-starts 3] [--jobs 2]
                      [--only NAME,...] [--write]
"""
import argparse
import concurrent.futures
import json
import math
import subprocess
import sys

import program

# Published ranges of the drape coefficient in percent; none: not known.
NAMED = {"cotton": "46 to 64", "silk": "", "wool": "40 to 70", "denim": "70 to 90", "leather": "47 to 70",
         "linen": "", "jersey": "", "chiffon": "", "canvas": ""}
# Mass [g/m^2], drape coefficient [%] and its spread between specimens [gong24].
MEASURED = {"cotton, white": (59, 46.1, 4.0), "cotton, blue": (192, 64.4, 4.0), "viscose, white": (213, 15.9, 0.7),
            "cotton, pink": (114, 57.9, 2.9), "wool, red": (274, 77.7, 2.0)}


def drape(size, starts, *words):
    command = [program.PROGRAM.parent / "weft_bench_drape", "--size", size, "--starts", starts, *words]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stderr.strip(), file=sys.stderr)
        return None
    return json.loads(done.stdout)


def micro(bending):
    warp, weft = (f"{1e6 * value:.3g}" for value in bending)
    return warp if warp == weft else f"{warp} / {weft}"


def cell(result):
    return f"{100 * result['coefficient']:.1f} +- {100 * result['spread']:.1f} ({result['folds']:.1f})"


def results_of(options, *words):
    """By size with the default integrator, then tightly."""
    return [*(drape(size, options.starts, *words) for size in options.sizes),
            *(drape(size, options.starts, *words, "--integrator", "tight") for size in options.tight_sizes)]


def named_row(options, name):
    results = results_of(options, "--material", name)
    return results, [name, "", NAMED[name], micro(results[0]["bending"]), *map(cell, results)]


def measured_row(options, name):
    mass, wanted, spread = MEASURED[name]
    fitted = drape(options.fit_size, options.fit_starts, "--mass", mass, "--fit", wanted)
    if fitted is None:  # out of reach at that size
        return [], [name, mass, f"{wanted} +- {spread}", "-", *("-" for _ in (*options.sizes, *options.tight_sizes))]
    results = results_of(options, "--mass", mass, "--bending", 1e6 * fitted["bending"][0])
    return results, [name, mass, f"{wanted} +- {spread}", micro(fitted["bending"]), *map(cell, results)]


def still(results):
    """The largest kinetic energy left, over m g and the disc's diameter."""
    weight = 9.81 * math.pi * 0.15 ** 2
    return max((result["kinetic_energy"] / (weight * result["density"] * 0.3) for result in results), default=0)


def parsed():
    def sizes(text):
        return [int(word) for word in text.split(",") if word]

    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sizes", type=sizes, default=[33, 65, 129])
    words.add_argument("--tight-sizes", type=sizes, default=[33])
    words.add_argument("--starts", type=int, default=5)
    words.add_argument("--fit-size", type=int, default=33)
    words.add_argument("--fit-starts", type=int, default=3)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--only", type=lambda text: text.split(","), help="fabrics; 'measured' stands for the five")
    words.add_argument("--write", action="store_true", help="renew the table of docs/materials.md")
    return words.parse_args()


def wanted_rows(options):
    for names, row_of in ((MEASURED, measured_row), (NAMED, named_row)):
        for name in names:
            if not options.only or name in options.only or (names is MEASURED and "measured" in options.only):
                yield row_of, name


def main():
    options = parsed()
    columns = ["fabric", "g/m^2", "measured %", "B [uN m]", *(f"{size}: % (folds)" for size in options.sizes),
               *(f"{size}, tight" for size in options.tight_sizes)]
    rows, restless = [], 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as jobs:
        for results, row in jobs.map(lambda wanted: wanted[0](options, wanted[1]), wanted_rows(options)):
            restless = max(restless, still(results))
            rows.append(row)
            print(program.table(columns, [row]).splitlines()[-1], flush=True)
    text = program.table(columns, rows) + f"\nAt rest discs hold at most {restless:.0e} m g times their diameter as motion.\n"
    print(f"\n{text}")
    if options.write:
        program.write_between_marks("docs/materials.md", "drape", text)


if __name__ == "__main__":
    main()
