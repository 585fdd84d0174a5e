#!/usr/bin/env python3
"""Runs sheets of 129 x 129 to their end with and without self-collision in turn: what it costs, beside what the solve costs
without it. Each round tells the difference of its two runs; medians of the rounds, with the least and the most.

Usage: bench/self_cost.py [--threads N] [--write] [NAME ...]
"""
import argparse
import json
import pathlib
import statistics
import tempfile

import program

SCENES = ("hanging_sheet", "sheet_on_sphere", "sheet_on_torus", "sheet_on_knot", "sheet_on_mannequin", "folding_sheet")
COLUMNS = ("scene", "frames", "without, ms a frame", "of that the solve", "with", "more", "of the solve", "frames a second",
           "self contacts", "strain p99 % of the frame that stretched most, without and with")
ROUNDS = 5


def both(name, folder):
    """The scene's files without and with."""
    scene = json.loads((program.ROOT / f"examples/scenes/{name}.json").read_text())
    for on in (False, True):
        for cloth in scene["cloths"]:
            cloth |= {"size": 129, "self_collision": on}
        path = folder / f"{name}_{on}.json"
        path.write_text(json.dumps(scene))
        yield path


def spread(values, digits=1):
    """The median, with the least and the most."""
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def rounds_of(paths, options, folder):
    """A pair of reports a round, without and with; or the error of a run."""
    rounds = []
    for _ in range(ROUNDS):
        pair = []
        for path in paths:
            report, error = program.run("simulate", path, "-o", folder / "run", "--threads", options.threads,
                                        "--checkpoint", 0)
            if error:
                return error
            pair.append(report)
        rounds.append(pair)
    return rounds


def row_of(name, options, folder):
    rounds = rounds_of(list(both(name, folder)), options, folder)
    if isinstance(rounds, str):
        return [name, f"**{rounds}**"] + [""] * (len(COLUMNS) - 2)
    without, solve, with_it = ([pair[on]["ms_per_frame"][key] for pair in rounds]
                               for on, key in ((0, "median"), (0, "solve"), (1, "median")))
    more = [after - before for before, after in zip(without, with_it)]
    shares = [difference / part for difference, part in zip(more, solve)]
    before, after = rounds[0]
    return [name, after["frames"], spread(without), spread(solve), spread(with_it), spread(more), spread(shares, 2),
            f"{1000 / statistics.median(with_it):.0f}", after["self_contacts_max"],
            ", ".join(f"{100 * report['strain_worst']['p99']:.2f}" for report in (before, after))]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("names", nargs="*", default=SCENES, metavar="NAME")
    words.add_argument("--threads", type=int, default=2)
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
