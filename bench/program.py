"""Runs the release build for the benchmarks; writes tables into documents."""
import csv
import json
import subprocess

import stamp
from stamp import ROOT

PROGRAM = ROOT / "build/release/bin/weft"


def run(*words):
    """(report, None), or (None, the error in one line)."""
    done = subprocess.run([PROGRAM, *map(str, words), "--json", "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        return None, f"exit {done.returncode}: {done.stderr.strip().removeprefix('weft: error: ')}"
    return json.loads(done.stdout), None


def column_of(folder, name):
    """Of the table of frames that a run left."""
    with open(f"{folder}/frames.csv", encoding="utf-8", newline="") as file:
        return [float(frame[name]) for frame in csv.DictReader(file)]


def largest(folder, column):
    return max(column_of(folder, column))


def table(columns, rows):
    """A Markdown table."""
    lines = ["| " + " | ".join(columns) + " |", "|---" * len(columns) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def write_between_marks(document, name, text):
    """Replaces what stands between <!-- NAME --> and <!-- /NAME --> of a document; a stamp comes before it."""
    path = ROOT / document
    before, rest = path.read_text().split(f"<!-- {name} -->\n", 1)
    after = rest.split(f"<!-- /{name} -->", 1)[1]
    path.write_text(f"{before}<!-- {name} -->\n{stamp.stamp(name)}\n{text}<!-- /{name} -->{after}")
