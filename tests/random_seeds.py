#!/usr/bin/env python3
"""Runs the random-mesh tests on many seeds and names those that fail.

Usage: tests/random_seeds.py [FIRST] [COUNT] [--batch N] [--keep FOLDER]
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/test_convert"


def run(first, count, keep):
    """(the lines that name a failure, whether the tests passed)."""
    asked = {"WEFT_RANDOM_SEEDS": f"{first} {count}"} | ({"WEFT_RANDOM_KEEP": str(keep)} if keep else {})
    done = subprocess.run([PROGRAM, "--gtest_filter=*Random*"], env=os.environ | asked, capture_output=True, text=True)
    named = re.findall(r"seed \d+[^\n]*", done.stdout)
    return named or ([done.stdout[-2000:] + done.stderr[-2000:]] if done.returncode != 0 else []), done.returncode == 0


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("first", type=int, nargs="?", default=1)
    words.add_argument("count", type=int, nargs="?", default=10000)
    words.add_argument("--batch", type=int, default=100, help="seeds between two lines of progress")
    words.add_argument("--keep", type=pathlib.Path, help="write the meshes that fail there")
    options = words.parse_args()
    failed, end, start = 0, options.first + options.count, time.monotonic()
    for first in range(options.first, end, options.batch):
        count = min(options.batch, end - first)
        named, passed = run(first, count, options.keep)
        failed += 0 if passed else 1
        print(f"seeds {first} .. {first + count - 1}: {'pass' if passed else 'FAIL'}", *named, sep="\n  ", flush=True)
    print(f"{options.count} seeds, {failed} batches with failures, {(time.monotonic() - start) / options.count:.2f} s a seed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
