"""Runs the release build for the benchmarks; writes tables into documents."""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys

import stamp
from stamp import ROOT

PROGRAM = ROOT / "build/release/bin/weft"


def run(*words):
    """(report, None), or (None, the error in one line)."""
    done = subprocess.run([PROGRAM, *map(str, words), "--json", "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        return None, f"exit {done.returncode}: {done.stderr.strip().removeprefix('weft: error: ')}"
    return json.loads(done.stdout), None


def run_measured(words, out):
    """(report or None, errors, what the process used) of a run; a report tells of failed checks, too.

    What it prints goes to files beside the folder `out`."""
    with open(f"{out}.json", "w+", encoding="utf-8") as report, open(f"{out}.txt", "w+", encoding="utf-8") as errors:
        child = subprocess.Popen([PROGRAM, *map(str, words), "-o", out, "--json"], stdout=report, stderr=errors)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        report.seek(0)
        errors.seek(0)
        text = report.read()
        return json.loads(text) if text else None, errors.read().strip(), used


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


def meshes_in(folder, names):
    """The meshes of a folder; of some names, with or without their endings, where any are given."""
    paths = sorted(p for p in folder.glob("*") if p.suffix in (".obj", ".off", ".ply", ".stl", ".glb"))
    return [p for p in paths if not names or p.name in names or p.stem in names]


def mesh_table(about, name, size, columns, row_of):
    """A whole benchmark: the table `name` of what row_of(path, size) tells of each mesh. Returns its exit code."""
    words = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--size", type=int, default=size)
    words.add_argument("--meshes", type=pathlib.Path, default=ROOT.parent / "shared/meshes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*")
    options = words.parse_args()
    paths = meshes_in(options.meshes, options.names)
    if not paths:
        print(f"bench: error: no meshes in {options.meshes}", file=sys.stderr)
        return 3
    text = table(columns, [row_of(path, options.size) for path in paths])
    print(text)
    if options.write:
        write_between_marks("docs/measured.md", name, text)
    return 0
