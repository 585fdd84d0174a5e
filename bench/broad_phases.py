#!/usr/bin/env python3
"""What finds the cells that may meet: the colliders' broad phases and the bounding volumes of the paper's survey, by the pairs
that they leave and the time that they take, at moments of running scenes.

Usage: bench/broad_phases.py [--frames 60] [--size 129] [--write] [SCENE ...]
"""
import argparse
import subprocess
import sys

import program

SCENES = ("sheet_on_mannequin", "sheet_on_knot", "two_sheets_on_sphere", "folding_sheet")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE", help="names of examples/scenes")
    words.add_argument("--frames", type=int, default=60)
    words.add_argument("--size", type=int, default=129)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    files = [program.ROOT / f"examples/scenes/{name}.json" for name in options.scenes]
    done = subprocess.run([program.PROGRAM.parent / "weft_bench_phases", *files, "--frames", str(options.frames), "--size",
                           str(options.size)], stdout=subprocess.PIPE, text=True)
    print(done.stdout)
    if done.returncode == 0 and options.write:
        program.write_between_marks("docs/measured.md", "broad_phases", done.stdout)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
