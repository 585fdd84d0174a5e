#!/usr/bin/env python3
"""Sews patterns as nobody chose them: pattern, body, size, spacing, fabric, friction and steps a frame by chance, every step verified.
Failures name their seed, and every start leaves its figures in a table.

Usage: bench/random_garments.py [--seeds 100] [--first 0] [--jobs 2] [--frames 90] [--shared FOLDER] [--keep FOLDER]
                                [--figures FILE.csv] [--write]
"""
import argparse
import concurrent.futures
import csv
import functools
import json
import math
import pathlib
import random
import sys
import tempfile

import program

# Worn by nobody as they are drawn: cuffs of 17 cm on upper arms, a waistband of 147 cm.
LEFT_OUT = ("random_06", "random_18")
MATERIALS = ("cotton", "silk", "wool", "denim", "leather", "linen", "jersey", "chiffon", "canvas")
MAX_STRAIN, MAX_GAINED = 0.2, 0.01
FIGURES = ("seed", "failure", "pattern", "body", "size", "spacing_mm", "material", "substeps", "particles", "seams", "closed",
           "largest_gap_mm", "closed_in_frame", "intersections", "passed", "swallowed", "strain_p99", "energy_gained_mgl", "fell_off",
           "seconds")


def drawn(seed, shared):
    """What one start is made of."""
    chance = random.Random(seed)
    patterns = [p for p in sorted((shared / "patterns").glob("*.json")) if p.stem not in LEFT_OUT]
    return {"seed": seed, "pattern": chance.choice(patterns),
            "body": shared / "bodies" / ("mean_all.obj" if chance.random() < 0.7 else "f_smpl_average_A40.obj"),
            "size": 1 if chance.random() < 0.4 else round(chance.uniform(0.95, 1.12), 3),
            "spacing_mm": round(math.exp(chance.uniform(math.log(7), math.log(25))), 1),
            "material": chance.choice(MATERIALS), "substeps": chance.choice((None, None, 1, 2, 4))}


def resized(pattern, size):
    """The pattern in another size, its top where it was: lengths are of panels and of circles' radii, all else is relative."""
    panels = pattern["pattern"]["panels"].values()
    top = max(panel["translation"][1] + max(y for _, y in panel["vertices"]) for panel in panels)
    for panel in panels:
        x, y, z = panel["translation"]
        panel["translation"] = [size * x, top + size * (y - top), z]
        panel["vertices"] = [[size * x, size * y] for x, y in panel["vertices"]]
        for edge in panel["edges"]:
            curve = edge.get("curvature")
            if isinstance(curve, dict) and curve["type"] == "circle":
                curve["params"][0] *= size
    return pattern


def sew(start, frames, folder):
    """(report or None, errors, processor seconds)."""
    path = folder / "pattern.json"
    path.write_text(json.dumps(resized(json.loads(start["pattern"].read_text()), start["size"])))
    words = ["garment", path, "--body", start["body"], "--spacing", start["spacing_mm"], "--material", start["material"],
             "--frames", frames, "--threads", 1, "--verify", "--quiet", "--checkpoint", 0]
    words += ["--substeps", start["substeps"]] if start["substeps"] else []
    report, errors, used = program.run_measured(words, folder / "run")
    return report, errors, used.ru_utime + used.ru_stime


def figures_of(report, folder):
    seams, verified = report["seams"], report["verification"]
    return {"particles": report["particles"], "seams": seams["count"], "closed": seams["closed"],
            "largest_gap_mm": round(seams["largest_gap_mm"], 2), "closed_in_frame": seams["frames"],
            "intersections": report["intersections"], "passed": verified["passed"]["count"],
            "swallowed": verified["swallowed"]["count"], "strain_p99": round(program.largest(folder / "run", "strain_p99"), 4),
            "energy_gained_mgl": report["energy_gained_mgl"], "fell_off": " ".join(report["fell_off"])}


def failure_of(figures, errors):
    """What is wrong with a run, in a line; empty where nothing is."""
    wrong = [f"{name} {figures[name]:.3g} above {most:g}" for name, most in
             (("strain_p99", MAX_STRAIN), ("energy_gained_mgl", MAX_GAINED), ("intersections", 0), ("passed", 0), ("swallowed", 0))
             if figures[name] > most]
    if figures["closed"] < figures["seams"]:
        wrong.append(f"{figures['seams'] - figures['closed']} of {figures['seams']} seams open, {figures['largest_gap_mm']} mm at most")
    if figures["fell_off"]:
        wrong.append(f"{figures['fell_off']} fell off")
    if not wrong and errors:
        wrong.append(errors.splitlines()[-1])
    return "; ".join(wrong)


def look_at(seed, options):
    start = drawn(seed, options.shared)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.keep or temporary) / f"seed{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        report, errors, seconds = sew(start, options.frames, folder)
        figures = figures_of(report, folder) if report else {}
    told = start | {"pattern": start["pattern"].stem, "body": start["body"].stem, "seconds": round(seconds)}
    return told | figures | {"failure": failure_of(figures, errors) if report else errors.splitlines()[-1]}


def text_of(rows, frames):
    failed = [row for row in rows if row["failure"]]
    sewn = [row for row in rows if "closed" in row]
    text = f"{len(rows)} garments of {frames} frames, {len(failed)} failed; {sum(row['closed'] for row in sewn)} of " \
           f"{sum(row['seams'] for row in sewn)} seams closed.\n"
    told = ("seed", "pattern", "body", "size", "spacing_mm", "material", "substeps", "failure")
    return text + ("\n" + program.table(told, [[row[name] or "" for name in told] for row in failed]) if failed else "")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seeds", type=int, default=100)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--frames", type=int, default=90)
    words.add_argument("--shared", type=pathlib.Path, default=program.ROOT.parent / "shared", help="with folders patterns and bodies")
    words.add_argument("--keep", type=pathlib.Path, help="leave patterns and runs in this folder")
    words.add_argument("--figures", type=pathlib.Path, default=pathlib.Path("random_garments.csv"), help="a line for every start")
    words.add_argument("--write", action="store_true", help="renew the lines of docs/measured.md")
    options = words.parse_args()
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, options.figures.open("w", newline="") as file:
        table = csv.DictWriter(file, FIGURES)
        table.writeheader()
        for row in pool.map(functools.partial(look_at, options=options), range(options.first, options.first + options.seeds)):
            table.writerow(row)
            file.flush()
            rows.append(row)
            print(row["seed"], row["failure"] or "passed", sep=": ", flush=True)
    text = text_of(rows, options.frames)
    print(text, end="")
    if options.write:
        program.write_between_marks("docs/measured.md", "random_garments", text)
    if any(row["failure"] for row in rows):
        sys.exit("bench: error: garments fail")


if __name__ == "__main__":
    main()
