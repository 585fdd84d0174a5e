#!/usr/bin/env python3
"""Runs a benchmark program of the release build and puts what it prints into docs/measured.md.

Usage: bench/native.py kernels | error_129 | error_65 | charts [--write]
"""
import argparse
import subprocess
import sys

import program

COMMANDS = {"kernels": ("weft_bench_kernels",),
            "error_129": ("weft_bench_error", "--size", "129"),
            "error_65": ("weft_bench_error", "--size", "65"),
            "charts": ("weft_bench_charts",)}


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("name", choices=COMMANDS)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    name, *rest = COMMANDS[options.name]
    done = subprocess.run([program.PROGRAM.parent / name, *rest], cwd=program.ROOT, stdout=subprocess.PIPE, text=True)
    if done.returncode == 0:
        print(done.stdout)
        if options.write:
            program.write_between_marks("docs/measured.md", options.name, done.stdout)
        if options.write and options.name == "error_129":
            subprocess.run([sys.executable, program.ROOT / "bench/error_plot.py"], check=True)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
