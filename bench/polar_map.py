#!/usr/bin/env python3
"""What single pushes by the paper's polar map come to, beside the default's closest points.

Usage: bench/polar_map.py [--meshes FOLDER] [--write]
"""
import argparse
import pathlib
import subprocess
import sys

import program

MESHES = ("c3d_stanford-bunny.obj", "ode_spot.obj", "c3d_rocker-arm.obj")
SHAPES = ("builtin:sphere", "builtin:knot", "builtin:double_torus")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    surfaces = [options.meshes / name for name in MESHES if (options.meshes / name).exists()]
    if len(surfaces) < len(MESHES):
        print(f"bench: some of {', '.join(MESHES)} are not in {options.meshes}", file=sys.stderr)
    done = subprocess.run([program.PROGRAM.parent / "weft_bench_pushes", *surfaces, *SHAPES], stdout=subprocess.PIPE,
                          text=True)
    print(done.stdout)
    if done.returncode == 0 and options.write:
        program.write_between_marks("docs/measured.md", "polar_map", done.stdout)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
