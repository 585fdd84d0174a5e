#!/usr/bin/env python3
"""Runs a benchmark program of the release build and puts what it prints between marks of docs/measured.md.

Usage: bench/native.py MARK PROGRAM [WORD ...]
"""
import subprocess
import sys

import program


def main():
    mark, name, *words = sys.argv[1:]
    done = subprocess.run([program.PROGRAM.parent / name, *words], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return done.returncode
    print(done.stdout)
    program.write_between_marks("docs/measured.md", mark, done.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
