#!/usr/bin/env python3
"""Scenes with contacts by the default integrator, and by the same one with a hundredth of its tolerance: how far they come apart,
beside two tight runs that begin a micrometre apart; draws both.

Usage: bench/tight_scenes.py [--frames N] [--threads N] [--pictures FOLDER] [--write] [NAME ...]
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

import program

SCENES = ("sheet_on_sphere", "sheet_on_torus", "sheet_on_knot", "sheet_on_mannequin", "tshirt_on_mannequin", "skirt_on_mannequin")
TIGHT = {"type": "newton", "max_iterations": 1000, "tolerance": 0.001}
# Frames that are compared; before the first of them hardly anything touches.
FIRST = 10
COLUMNS = ("scene", "ms a frame", "tight", "iterations a frame", "tight", "energy gained, m g L", "tight", "strain p99 %, worst frame",
           "tight", "centre off the tight run, worst mm", "tight from 1 um beside", "particles off, rms mm",
           "tight from 1 um beside")


def scene_text(name, integrator, moved):
    """The scene of the examples; its cloths begin so much beside."""
    scene = json.loads((program.ROOT / "examples/scenes" / f"{name}.json").read_text())
    if integrator:
        scene["integrator"] = integrator
    for cloth in scene["cloths"]:
        x, y, z = cloth.get("translate", [0, 0, 0])
        cloth["translate"] = [x + moved, y, z]
    return json.dumps(scene)


def positions_of(folder):
    """Of all cloths in all frames [frames, points, 3]."""
    caches = []
    for path in sorted(folder.glob("*.pc2")):
        data = path.read_bytes()
        points, frames = numpy.frombuffer(data, "<i4", 1, 16)[0], numpy.frombuffer(data, "<i4", 1, 28)[0]
        caches.append(numpy.frombuffer(data, "<f4", frames * points * 3, 32).reshape(frames, points, 3))
    return numpy.concatenate(caches, axis=1).astype(float)


def run(folder, name, options, integrator=None, moved=0.0):
    """The report, what the frames measured, and the positions; ends the script where the run fails."""
    folder.mkdir(parents=True)
    path = folder / "scene.json"
    path.write_text(scene_text(name, integrator, moved))
    done = subprocess.run([program.PROGRAM, "--json", "--quiet", "--threads", str(options.threads), "simulate", path, "-o", folder / "run",
                           "--frames", str(options.frames), "--export", "pc2", "--checkpoint", "0"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"tight_scenes: {name}: {done.stderr.strip()}")
    centre = numpy.array([program.column_of(folder / "run", f"com_{axis}") for axis in "xyz"]).T
    return {"report": json.loads(done.stdout), "centre": centre, "positions": positions_of(folder / "run"),
            "iterations": sum(program.column_of(folder / "run", "iterations")) / options.frames,
            "p99": program.largest(folder / "run", "strain_p99")}


def centre_off(a, b):
    return 1000 * numpy.linalg.norm(a["centre"] - b["centre"], axis=1)[FIRST - 1:].max()


def particles_off(a, b):
    return 1000 * numpy.sqrt(((a["positions"] - b["positions"])[FIRST:] ** 2).sum(axis=2).mean())


def row_of(name, options, folder):
    plain = run(folder / "default", name, options)
    tight = run(folder / "tight", name, options, TIGHT)
    beside = run(folder / "beside", name, options, TIGHT, 1e-6)
    draw(name, options, folder)
    both = (plain, tight)
    return [name, *(f"{one['report']['ms_per_frame']['median']:.0f}" for one in both), *(f"{one['iterations']:.0f}" for one in both),
            *(f"{one['report']['energy_gained_mgl']:.1e}" for one in both), *(f"{100 * one['p99']:.2f}" for one in both),
            f"{centre_off(plain, tight):.1f}", f"{centre_off(beside, tight):.1f}", f"{particles_off(plain, tight):.1f}",
            f"{particles_off(beside, tight):.1f}"]


def draw(name, options, folder):
    options.pictures.mkdir(parents=True, exist_ok=True)
    subprocess.run([program.PROGRAM, "--quiet", "render", folder / "default/run", folder / "tight/run", "--labels", "default", "tight",
                    "-o", options.pictures / f"{name}.png"], check=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("names", nargs="*", default=SCENES, help="scenes of the examples")
    words.add_argument("--frames", type=int, default=60)
    words.add_argument("--threads", type=int, default=2)
    words.add_argument("--pictures", type=pathlib.Path, default=program.ROOT / "out/tight_scenes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    rows = []
    for name in options.names:
        with tempfile.TemporaryDirectory() as folder:
            rows.append(row_of(name, options, pathlib.Path(folder)))
        print(program.table(COLUMNS, rows[-1:]), file=sys.stderr)
    text = program.table(COLUMNS, rows)
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "tight_scenes", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
