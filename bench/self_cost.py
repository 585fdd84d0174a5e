#!/usr/bin/env python3
"""Runs sheets of 129 x 129 with and without self-collision in turn: what it costs, beside what the solve costs without it.

Usage: bench/self_cost.py [--frames N] [--threads N] [--rounds N] [--write] [NAME ...]
"""
import argparse
import json
import pathlib
import tempfile

import program

SCENES = ("hanging_sheet", "sheet_on_sphere", "sheet_on_torus", "sheet_on_knot", "sheet_on_mannequin", "folding_sheet")
COLUMNS = ("scene", "frames", "without, ms a frame", "of that the solve", "with", "more", "of the solve", "frames a second",
           "self contacts", "strain p99 %, without and with")


def both(name, folder):
    """The scene's files without and with."""
    scene = json.loads((program.ROOT / f"examples/scenes/{name}.json").read_text())
    for on in (False, True):
        for cloth in scene["cloths"]:
            cloth |= {"size": 129, "self_collision": on}
        path = folder / f"{name}_{on}.json"
        path.write_text(json.dumps(scene))
        yield path


def row_of(name, options, folder):
    reports = {}
    for _ in range(options.rounds):
        for on, path in enumerate(both(name, folder)):
            report, error = program.run("simulate", path, "-o", folder / "run", "--frames", options.frames, "--threads",
                                        options.threads, "--checkpoint", 0)
            if error:
                return [name, f"**{error}**"] + [""] * (len(COLUMNS) - 2)
            reports.setdefault(on, []).append(report)

    def least(on, key):
        return min(report["ms_per_frame"][key] for report in reports[on])

    before, after, solve = least(0, "median"), least(1, "median"), least(0, "solve")
    share = (after - before) / solve
    return [name, options.frames, f"{before:.1f}", f"{solve:.1f}", f"{after:.1f}", f"{after - before:.1f}",
            f"{share:.2f}" if share <= 1 else f"**{share:.2f}**", f"{1000 / after:.0f}", reports[1][0]["self_contacts_max"],
            ", ".join(f"{100 * reports[on][0]['strain']['p99']:.2f}" for on in (0, 1))]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("names", nargs="*", default=SCENES, metavar="NAME")
    words.add_argument("--frames", type=int, default=60)
    words.add_argument("--threads", type=int, default=2)
    words.add_argument("--rounds", type=int, default=5)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.names:
            rows.append(row_of(name, options, pathlib.Path(folder)))
            print(*rows[-1], sep="\t", flush=True)
    if options.write:
        program.write_between_marks("docs/measured.md", "self_cost", program.table(COLUMNS, rows))


if __name__ == "__main__":
    main()
