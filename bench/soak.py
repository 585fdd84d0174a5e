#!/usr/bin/env python3
"""Random starts: bodies, poses, sizes, speeds up to 10 m/s, materials; every frame verified. Failures name their seed.

Usage: bench/soak.py [--seeds 200] [--first 0] [--jobs 2] [--keep FOLDER] [--write]
       bench/soak.py --scene SEED       prints the scene of one seed
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import program

FRAMES = 30
FASTEST = 10  # m/s
# Radii about the origin of shapes that hold the whole shape [m].
BODIES = {"sphere": 0.5, "torus": 0.5, "box": 0.44, "cone": 0.4, "rod": 0.51, "knot": 0.5, "double_torus": 0.5,
          "cylinder": 0.54}
CLOTHS = {"sheet": 0.71, "disk": 0.5, "torus": 0.5, "cylinder": 0.54}
MATERIALS = ("cotton", "silk", "wool", "denim", "leather", "linen", "jersey", "chiffon", "canvas")
GAP = 0.03  # between the spheres around all things at the start [m]


def direction(chance):
    while True:
        v = [chance.uniform(-1, 1) for _ in range(3)]
        length = math.hypot(*v)
        if 0.1 < length <= 1:
            return [x / length for x in v]


def material(chance):
    if chance.random() < 0.6:
        return chance.choice(MATERIALS)
    return {"density": chance.uniform(0.05, 0.5), "stretch": 10 ** chance.uniform(1.5, 4), "shear": 10 ** chance.uniform(1, 3.5),
            "bending": 10 ** chance.uniform(-6, -3), "damping": chance.uniform(0, 5),
            "strain_limit": chance.choice((0, 0.02, 0.05, 0.1)), "thickness": chance.uniform(0.0005, 0.004)}


def moved(chance, centre, radius):
    """Keys of a body that flies and turns, no point of it faster than it may."""
    keys, place, now = [{"time": 0}], [0, 0, 0], 0
    for _ in range(chance.randint(1, 3)):
        seconds = chance.uniform(0.1, 0.3)
        speed = chance.uniform(0, FASTEST)
        way = speed * seconds
        turn = min(90, math.degrees((FASTEST - speed) / radius * seconds / 4))
        place = [p + way * d for p, d in zip(place, direction(chance))]
        place[1] = max(place[1], 0.55 - centre[1])  # not under the ground
        now += seconds
        keys.append({"time": now, "translate": place, "rotate": [chance.uniform(-turn, turn) for _ in range(3)]})
    return keys


def beside(chance, things, radius):
    """A place whose sphere meets none of those that are there, nor the ground."""
    while True:
        other, reach = chance.choice(things)
        place = [o + (reach + radius + GAP) * d for o, d in zip(other, direction(chance))]
        if place[1] > radius + GAP and all(math.dist(place, p) >= r + radius + 0.99 * GAP for p, r in things):
            return place


def scene_of(seed):
    chance = random.Random(seed)
    scene = {"version": 1, "frames": FRAMES, "substeps": chance.choice((2, 4, 8)), "ground": 0, "cloths": [], "bodies": []}
    things = []
    for i in range(chance.choice((1, 1, 2))):
        shape, scale = chance.choice(list(BODIES)), chance.uniform(0.4, 1)
        radius = BODIES[shape] * scale
        place = beside(chance, things, radius) if things else [0, radius + GAP + chance.uniform(0, 1), 0]
        things.append((place, radius))
        body = {"name": f"body{i}", "surface": f"builtin:{shape}", "size": chance.choice((33, 65)), "scale": scale,
                "rotate": [chance.uniform(-180, 180) for _ in range(3)], "translate": place,
                "friction": chance.uniform(0, 1)}
        if chance.random() < 0.4:
            body["motion"] = moved(chance, place, radius)
        scene["bodies"].append(body)
    for i in range(chance.choice((1, 1, 1, 2))):
        shape, scale = chance.choice(list(CLOTHS)), chance.uniform(0.5, 1)
        radius = CLOTHS[shape] * scale
        place = beside(chance, things, radius)
        # Mostly at a body.
        aim = [a - b for a, b in zip(things[0][0], place)] if chance.random() < 0.8 else direction(chance)
        speed = chance.uniform(0, FASTEST) / math.hypot(*aim)
        things.append((place, radius))
        scene["cloths"].append({"name": f"cloth{i}", "surface": f"builtin:{shape}", "size": chance.choice((33, 49, 65)),
                                "scale": scale, "rotate": [chance.uniform(-180, 180) for _ in range(3)], "translate": place,
                                "velocity": [speed * a for a in aim], "material": material(chance),
                                "friction": chance.uniform(0, 1)})
    return scene


def failure_of(seed, keep):
    """None, or what went wrong in one line."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(keep or temporary) / f"seed{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "scene.json"
        path.write_text(json.dumps(scene_of(seed)))
        words = [program.PROGRAM, "simulate", path, "-o", folder, "--verify", "--quiet", "--threads", "1", "--checkpoint", "0"]
        done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode == 0:
        return None
    return f"exit {done.returncode}: {done.stderr.strip().split('scene.json: ')[-1]}"


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seeds", type=int, default=200)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--keep", type=pathlib.Path, help="leave scenes and runs in this folder")
    words.add_argument("--scene", type=int, metavar="SEED")
    words.add_argument("--write", action="store_true", help="renew the line of docs/measured.md")
    options = words.parse_args()
    if options.scene is not None:
        print(json.dumps(scene_of(options.scene), indent=1))
        return
    seeds = range(options.first, options.first + options.seeds)
    failures = ""
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as jobs:
        for seed, failure in zip(seeds, jobs.map(lambda seed: failure_of(seed, options.keep), seeds)):
            if failure:
                failures += f"- seed {seed}: {failure}\n"
                print(f"seed {seed}: {failure}", flush=True)
    text = f"{len(seeds)} random starts of {FRAMES} frames, {failures.count(chr(10))} failed.\n"
    print(text, end="")
    text += "\n" + failures if failures else ""
    if options.write:
        program.write_between_marks("docs/measured.md", "soak", text)
    if failures:
        sys.exit("bench: error: starts failed")


if __name__ == "__main__":
    main()
