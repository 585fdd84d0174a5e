#!/usr/bin/env python3
"""Passes on what ctest prints; before its summary, which stays last, says how many tests were skipped and why.

Usage: ctest ... | tests/house/count_skips.py LAST_TEST_LOG
"""
import collections
import pathlib
import re
import sys

SUMMARY = re.compile(r"\d+% tests passed")
DISABLED = re.compile(r"\d+ Test +#\d+: (?P<name>\S+) .*Not Run \(Disabled\)")
LONG = "long, and left to ./dev bench validate"
TEST = re.compile(r"^\d+/\d+ Test: (?P<name>.*)$", re.M)
# What GoogleTest prints before its last word on a test, unittest, and the scripts that end with 77.
REASONS = (re.compile(r"^[^\n]*: Skipped\n(?P<reason>[^\n]+)\n", re.M), re.compile(r"\.\.\. skipped (['\"])(?P<reason>.*)\1$", re.M),
           re.compile(r"^\w+: skipped: (?P<reason>.*)$", re.M))


def skips(log):
    """Reason of each skip, under the names of its tests."""
    tests = collections.defaultdict(list)
    parts = TEST.split(log)
    for name, output in zip(parts[1::2], parts[2::2]):
        for pattern in REASONS:
            for found in pattern.finditer(output):
                tests[found["reason"]].append(name)
    return tests


def lines_of(tests):
    count = sum(map(len, tests.values()))
    yield f"{count} tests skipped{':' if count else ''}"
    for reason, names in sorted(tests.items(), key=lambda item: -len(item[1])):
        others = f" and {len(names) - 1} more" if len(names) > 1 else ""
        yield f"  {len(names)}: {reason} ({names[0]}{others})"


def main():
    log, disabled, last = pathlib.Path(sys.argv[1]), [], []
    for line in sys.stdin:
        if last or SUMMARY.match(line):
            last.append(line)
            continue
        print(line, end="", flush=True)
        disabled += [found["name"] for found in DISABLED.finditer(line)]
    if last and log.is_file():
        tests = skips(log.read_text(errors="replace"))
        tests |= {LONG: disabled} if disabled else {}
        print(*lines_of(tests), "", sep="\n")
    print(*last, sep="", end="")


if __name__ == "__main__":
    main()
