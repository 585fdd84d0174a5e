#!/usr/bin/env python3
"""The default integrator against steps solved to the end in double: a hanging sheet over 27 fabrics, and materials by
chance (bench/solver_sweep.cpp).

Usage: bench/solver.py [--sizes 65] [--random 40] [--jobs 1] [--done FILE] [--write]
"""
import argparse
import subprocess
import sys

import program


def run(*words):
    """What it prints; None where it fails."""
    done = subprocess.run([program.PROGRAM.parent / "weft_bench_solver", *map(str, words)], stdout=subprocess.PIPE,
                          text=True)
    return done.stdout if done.returncode == 0 else None


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sizes", default="65", help="samples a side, with commas between; nothing: no fabrics")
    words.add_argument("--random", type=int, default=40, help="materials by chance; 0: none")
    words.add_argument("--jobs", type=int, default=1, help="trials at a time, which lengthens times where cores are few")
    words.add_argument("--done", default="", help="a file of finished trials of this program, with which a bench that was ended goes on")
    words.add_argument("--write", action="store_true", help="renew the tables of docs/measured.md")
    options = words.parse_args()
    wanted = {"solver_fabrics": ["--sizes", options.sizes] if options.sizes else None,
              "solver_random": ["--random", options.random] if options.random else None}
    for mark, what in wanted.items():
        text = run(*what, "--jobs", options.jobs, "--done", options.done) if what else ""
        if text is None:
            return 1
        print(text)
        if text and options.write:
            program.write_between_marks("docs/measured.md", mark, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
