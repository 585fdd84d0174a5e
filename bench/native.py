#!/usr/bin/env python3
"""Runs a benchmark program of the release build and puts what it prints into docs/measured.md.

Usage: bench/native.py kernels | error_129 | error_65 | error_fabrics | charts [--write]
"""
import argparse
import subprocess
import sys

import program

# What is run for a block, one after another.
COMMANDS = {"kernels": [("weft_bench_kernels",)],
            "error_129": [("weft_bench_error", "--size", "129")],
            "error_65": [("weft_bench_error", "--size", "65")],
            "error_fabrics": [("weft_bench_error", "--size", "65", "--fabric", name) for name in ("cotton", "silk", "denim")],
            "charts": [("weft_bench_charts",)]}


def run_all(commands):
    """What all of them print; None where one fails."""
    texts = []
    for name, *words in commands:
        done = subprocess.run([program.PROGRAM.parent / name, *words], cwd=program.ROOT, stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            return None
        texts.append(done.stdout)
    return "\n".join(texts)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("name", choices=COMMANDS)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    text = run_all(COMMANDS[options.name])
    if text is None:
        return 1
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", options.name, text)
    if options.write and options.name.startswith("error"):
        subprocess.run([sys.executable, program.ROOT / "bench/error_plot.py"], check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
