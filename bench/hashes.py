#!/usr/bin/env python3
"""Tells whether a change of the code changes a result, bit by bit: the state hashes of all example scenes and of every
integrator and collider, the bytes of images that `convert` makes, and those of every export.

Usage: bench/hashes.py record LOG [--program FILE] [--frames 40] [--minutes 3] [--only WORD]     before the change
       bench/hashes.py check LOG [--program FILE] [--only WORD]                                  after it; exit 1 where one differs

A line of the log is a kind, a name, a count of frames and a hash. A scene whose frames take longer than the minutes is
recorded with fewer of them, and checked with as many.
"""
import argparse
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

import program
from stamp import ROOT

SHAPES = ("sphere", "torus", "knot", "mannequin", "tshirt", "skirt", "double_torus")
MESHES = ("c3d_stanford-bunny.obj", "bff_kitten.obj", "igl_camelhead.off", "cgal_eight.off", "thingi_472042.stl",
          "ode_boot.obj", "dc_tshirt1000-tri.obj", "gpt_mannequin.off", "ode_plane_holes.obj", "opt_torus_with_holes.obj")
INTEGRATORS = ("newton", "implicit", "explicit", "desbrun", "two_level", "multigrid")
COLLIDERS = ("pyramid", "polar_map", "sphere_tree", "spatial_hash", "image_space")
EXPORTS = "obj,pc2,mdd,glb,ply,vtp,exr,usda"
FEWER = 4  # times, until a scene fits its minutes


def call(words, minutes=60.0):
    """The report, or None where the time is up. An error is no result to compare: it ends the script."""
    try:
        done = subprocess.run([program.PROGRAM, *map(str, words), "--json", "--quiet"], capture_output=True, text=True,
                              timeout=60 * minutes)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0:
        sys.exit(f"hashes: {' '.join(map(str, words))}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def state_hash(scene, frames, folder, minutes, *more):
    made = call(["simulate", scene, "-o", folder, "--frames", frames, "--export", "pc2", "--checkpoint", 0, *more], minutes)
    return made and made["state_hash"]


def of_scene(name, frames, minutes):
    """(frames, hash) of as many frames as fit."""
    while True:
        with tempfile.TemporaryDirectory() as folder:
            found = state_hash(ROOT / "examples/scenes" / name, frames, folder, minutes)
        if found is not None or frames <= 1:
            return frames, found
        frames = max(1, frames // FEWER)


def small_scene(size, integrator, collider):
    soft = integrator in ("two_level", "explicit", "desbrun")
    return {"version": 1, "frames": 20, "substeps": 16 if integrator == "explicit" else 4,
            "integrator": {"type": integrator}, "collider": {"type": collider},
            "cloths": [{"surface": "builtin:sheet", "size": size, "translate": [0, 0.65, 0],
                        "material": {"stretch": 100, "shear": 50} if soft else {}}],
            "bodies": [{"surface": "builtin:sphere", "size": 33, "scale": 0.3, "translate": [0, 0.3, 0]}]}


def of_method(integrator, collider, frames):
    size = 17 if integrator == "desbrun" else 33
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.json"
        scene.write_text(json.dumps(small_scene(size, integrator, collider)))
        return frames, state_hash(scene, frames, f"{folder}/run", 3)


def of_bytes(paths):
    whole = hashlib.sha256()
    for path in sorted(paths):
        whole.update(path.name.encode() + b"\n" + path.read_bytes())
    return whole.hexdigest()[:16]


def of_image(mesh):
    with tempfile.TemporaryDirectory() as folder:
        call(["convert", mesh, "-o", f"{folder}/image.exr", "--size", 129, "--normal-map", 129])
        call(["rebuild", f"{folder}/image.exr", "-o", f"{folder}/again.obj"])
        return 0, of_bytes(pathlib.Path(folder).glob("*"))


def of_exports(on):
    with tempfile.TemporaryDirectory() as folder:
        scene = ROOT / "examples/scenes/tshirt_on_mannequin.json"
        call(["simulate", scene, "-o", f"{folder}/run", "--frames", 2, "--export", EXPORTS, "--on", on, "--checkpoint", 0])
        kept = [path for path in pathlib.Path(folder, "run").rglob("*") if path.is_file() and path.suffix not in (".csv", ".json")]
        return 2, of_bytes(kept)


def entries(frames, minutes):
    """(kind, name, what finds (frames, hash))."""
    for shape in SHAPES:
        yield "image", f"builtin:{shape}", lambda _, shape=shape: of_image(f"builtin:{shape}")
    for mesh in MESHES:
        if (ROOT / "../shared/meshes" / mesh).exists():
            yield "image", mesh, lambda _, mesh=mesh: of_image(ROOT / "../shared/meshes" / mesh)
    for on in ("image", "auto"):
        yield "exports", on, lambda _, on=on: of_exports(on)
    for integrator in INTEGRATORS:
        yield "integrator", integrator, lambda _, name=integrator: of_method(name, "pyramid", 20)
    for collider in COLLIDERS:
        yield "collider", collider, lambda _, name=collider: of_method("implicit", name, 20)
    for scene in sorted((ROOT / "examples/scenes").glob("*.json")):
        moving = [body for body in json.loads(scene.read_text()).get("bodies", []) if "animation" in body]
        # A name without an ending is that of an animation in the surface's file.
        if any(not (scene.parent / body["animation" if "." in body["animation"] else "surface"]).exists() for body in moving):
            print(f"skipped {scene.name}: its animation is not there (examples/{{walk,make_walker}}.py make it)", flush=True)
            continue
        yield "scene", scene.name, lambda known, name=scene.name: of_scene(name, known or frames, 60 if known else minutes)


def record(options):
    with open(options.log, "a" if options.only else "w", encoding="utf-8") as log:
        for kind, name, find in entries(options.frames, options.minutes):
            if options.only not in f"{kind} {name}":
                continue
            count, found = find(None)
            log.write(f"{kind}\t{name}\t{count}\t{found}\n")
            log.flush()
            print(kind, name, count, found, flush=True)
    return 0


def check(options):
    known = {tuple(line.split("\t")[:2]): line.rstrip("\n").split("\t")[2:] for line in open(options.log, encoding="utf-8")}
    differ = seen = 0
    for kind, name, find in entries(0, 0):
        if (kind, name) not in known or options.only not in f"{kind} {name}":
            continue
        frames, wanted = known[kind, name]
        found = str(find(int(frames))[1])
        seen += 1
        differ += found != wanted
        print("same  " if found == wanted else "DIFFER", kind, name, frames, found, "" if found == wanted else f"was {wanted}", flush=True)
    missing = 0 if options.only else len(known) - seen
    print(f"{differ} of {seen} differ" + (f", {missing} of the log were not found" if missing else ""))
    return 1 if differ or missing or not seen else 0


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("what", choices=("record", "check"))
    words.add_argument("log")
    words.add_argument("--program", type=pathlib.Path, help="instead of the release build's")
    words.add_argument("--frames", type=int, default=40)
    words.add_argument("--minutes", type=float, default=3)
    words.add_argument("--only", default="", help="those whose kind and name hold this")
    options = words.parse_args()
    if options.program:
        program.PROGRAM = options.program
    return record(options) if options.what == "record" else check(options)


if __name__ == "__main__":
    sys.exit(main())
