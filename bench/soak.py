#!/usr/bin/env python3
"""Random starts: bodies, poses, sizes, speeds up to 10 m/s, materials, pins, wind, animations; every step verified. Failures name
their seed, and every start leaves its figures in a table.

Usage: bench/soak.py [--seeds 200] [--first 0] [--jobs 2] [--most-seconds 1800] [--keep FOLDER] [--figures FILE.csv]
                     [--resume] [--write]
       bench/soak.py --scene SEED       prints the scene of one seed
"""
import argparse
import concurrent.futures
import csv
import functools
import hashlib
import json
import math
import pathlib
import random
import resource
import signal
import struct
import subprocess
import sys
import tempfile

import program

FRAMES = 30
FASTEST = 10  # m/s
# Radii about the origin of shapes that hold the whole shape [m].
BODIES = {"sphere": 0.5, "torus": 0.5, "box": 0.44, "cone": 0.4, "rod": 0.51, "knot": 0.5, "double_torus": 0.5,
          "cylinder": 0.54}
# Closed meshes of others, where they are.
MESHES = program.ROOT.parent / "shared/meshes"
SHARED = ("ode_spot.obj", "c3d_rocker-arm.obj", "igl_fertility.off", "gpt_mannequin.off")
CLOTHS = {"sheet": 0.71, "disk": 0.5, "torus": 0.5, "cylinder": 0.54}
MATERIALS = ("cotton", "silk", "wool", "denim", "leather", "linen", "jersey", "chiffon", "canvas")
# What a run may come to: parts of springs (more in soft cloth: most_strain), of points put back, of m g 1 m gained, and metres off free
# fall.
MAX_STRAIN, MAX_FELL_BACK, MAX_GAINED, MAX_OFF = 0.2, 0.01, 0.01, 1e-3
FIGURES = ("seed", "failure", "strain_p99", "fell_back_share", "blocked_share", "lost_share", "energy_gained_mgl", "off_free_fall",
           "contacts_max", "self_contacts_max", "intersections", "passed", "swallowed", "ms_median", "seconds", "program")
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


def vertices_of(path):
    rows = [line.split() for line in path.read_text(errors="replace").splitlines()]
    if path.suffix == ".obj":
        return [[float(x) for x in row[1:4]] for row in rows if row[:1] == ["v"]]
    rows = [row for row in rows if row and not row[0].startswith("#")][1:]
    return [[float(x) for x in row[:3]] for row in rows[1:1 + int(rows[0][0])]]


def put_shared(chance, body, scale):
    """Puts a mesh of others in the body's place, `scale` long; its radius, or None where it is not there."""
    path = MESHES / chance.choice(sorted(SHARED))
    if not path.exists():
        return None
    points = vertices_of(path)
    low, high = [min(c) for c in zip(*points)], [max(c) for c in zip(*points)]
    factor = scale / max(b - a for a, b in zip(low, high))
    body.update(surface=str(path), scale=factor)
    # Its origin is anywhere: a radius about it that holds the whole mesh.
    return factor * max(math.hypot(*p) for p in points)


def animate(chance, body, folder):
    """Lets a mesh of the body's shape shrink, swell and sway by a point cache beside it."""
    mesh = folder / f"{body['name']}.obj"
    subprocess.run([program.PROGRAM, "shapes", body["surface"].split(":")[1], "-o", mesh, "--quiet"], check=True, capture_output=True)
    points, samples = vertices_of(mesh), 12
    shrink, sway = chance.uniform(0, 0.2), chance.uniform(0, 0.15)
    data = struct.pack("<12siiffi", b"POINTCACHE2", 1, len(points), 0, 2.5, samples)
    for i in range(samples):
        turn = 2 * math.pi * i / samples
        size = 1 - shrink * (1 - math.cos(turn)) / 2
        for x, y, z in points:
            data += struct.pack("<fff", size * x + sway * math.sin(turn) * y * y, size * y, size * z)
    (folder / f"{body['name']}.pc2").write_bytes(data)
    body.update(surface=mesh.name, animation=f"{body['name']}.pc2")


def pin(chance, cloth):
    cloth["pins"] = [{"image": [chance.choice((0, 1)), chance.choice((0, 1))]}]
    cloth["velocity"] = [0, 0, 0]  # what holds it would tear at it
    if chance.random() < 0.5:
        cloth["pins"][0]["path"] = [{"time": 0}, {"time": 0.5, "translate": [chance.uniform(-0.3, 0.3) for _ in range(3)]}]


def scene_of(seed, folder):
    """Its files go into the folder."""
    chance = random.Random(seed)
    scene = {"version": 1, "frames": FRAMES, "substeps": chance.choice((2, 4, 8)), "ground": 0, "cloths": [], "bodies": []}
    things = []
    for i in range(chance.choice((1, 1, 2))):
        shape, scale = chance.choice(list(BODIES)), chance.uniform(0.4, 1)
        body = {"name": f"body{i}", "surface": f"builtin:{shape}", "size": chance.choice((33, 65)), "scale": scale,
                "rotate": [chance.uniform(-180, 180) for _ in range(3)], "friction": chance.uniform(0, 1)}
        radius = BODIES[shape] * scale
        if chance.random() < 0.2:
            radius = put_shared(chance, body, scale) or radius
        elif chance.random() < 0.2:
            animate(chance, body, folder)
            radius *= 1.3  # it sways
        place = body["translate"] = beside(chance, things, radius) if things else [0, radius + GAP + chance.uniform(0, 1), 0]
        things.append((place, radius))
        if "animation" not in body and chance.random() < 0.4:
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
        if chance.random() < 0.2:
            pin(chance, scene["cloths"][-1])
    if chance.random() < 0.2:
        scene["wind"] = {"velocity": [chance.uniform(-5, 5) for _ in range(3)]}
    return scene


def off_free_fall(scene, report, frames):
    """How far the centre of mass strays from free fall before anything is touched; 0 where something holds the cloth [m]."""
    if "wind" in scene or any("pins" in cloth or "damping" in cloth["material"] for cloth in scene["cloths"]):
        return 0
    if len(scene["cloths"]) > 1:
        return 0  # of unlike masses
    h, start = 1 / (60 * scene["substeps"]), report["centre_of_mass"][0]
    worst = 0
    for i, (frame, place) in enumerate(zip(frames, report["centre_of_mass"][1:]), start=1):
        if int(frame["contacts"]) > 0 or int(frame["stopped"]) > 0:
            break
        t = i / 60
        fallen = [c + v * t for c, v in zip(start, scene["cloths"][0]["velocity"])]
        # Steps that a moving body splits fall less late than whole ones do, anything down to not at all.
        late, moves = 9.81 * t * h / 2, any("motion" in body or "animation" in body for body in scene["bodies"])
        fallen[1] -= 9.81 * t * t / 2 + late
        fallen[1] = min(max(fallen[1], place[1]), fallen[1] + late) if moves else fallen[1]
        worst = max(worst, math.dist(fallen, place))
    return worst


def impact_strain(scene):
    """What a blow at the scene's speeds strains the softest threads by: the speed over that of sound in them, as at the end of a
    rod that hits a wall. Little in true fabrics; some of the random ones are as soft as rubber."""
    speed = sum(math.hypot(*cloth["velocity"]) for cloth in scene["cloths"])
    speed += FASTEST if any("motion" in body or "animation" in body for body in scene["bodies"]) else 0
    own = [cloth["material"] for cloth in scene["cloths"] if isinstance(cloth["material"], dict)]
    return min(1, max((speed * math.sqrt(one["density"] / one["stretch"]) for one in own), default=0))


def may_be_carried(scene):
    """Whether a moving body may catch pinned cloth and carry it off, which stretches it as far as the body goes, most at the pin."""
    moves = any("motion" in body for body in scene["bodies"])
    return moves and any("pins" in cloth for cloth in scene["cloths"])


def most_strain(scene):
    """Cloth so soft that a blow may strain it beyond the bound has none where it may be carried."""
    blow = impact_strain(scene)
    return math.inf if blow > MAX_STRAIN and may_be_carried(scene) else max(MAX_STRAIN, blow)


def figures_of(seed, scene, report, frames):
    share = [int(frame["fell_back"]) / report["particles"] for frame in frames]
    lost = [float(frame["lost_time"]) / (report["time_step"] * report["substeps"]) for frame in frames]
    verified = report["verification"]
    figures = {"seed": seed, "strain_p99": max(float(frame["strain_p99"]) for frame in frames), "fell_back_share": max(share),
               "blocked_share": report["blocked_share"], "lost_share": max(lost), "energy_gained_mgl": report["energy_gained_mgl"],
               "off_free_fall": off_free_fall(scene, report, frames), "contacts_max": report["contacts_max"],
               "self_contacts_max": report["self_contacts_max"], "intersections": report["intersections"],
               "passed": verified["passed"]["count"], "swallowed": verified["swallowed"]["count"],
               "ms_median": report["ms_per_frame"]["median"]}
    bounds = {"strain_p99": most_strain(scene), "fell_back_share": MAX_FELL_BACK,
              "energy_gained_mgl": MAX_GAINED, "off_free_fall": MAX_OFF}
    beyond = [f"{name} {figures[name]:.3g} above {most:.3g}" for name, most in bounds.items() if not figures[name] <= most]
    figures["failure"] = "; ".join(beyond)
    return figures


def processor_seconds():
    """Of all processes that this one has waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def simulate(path, run, most_seconds):
    words = [program.PROGRAM, "simulate", path, "-o", run, "--verify", "--quiet", "--json", "--threads", "1", "--checkpoint", "0"]
    return subprocess.run(words, capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (most_seconds, most_seconds + 5)))


def error_of(done, most_seconds):
    """Why a run failed, in a line; empty where it did not."""
    if done.returncode == -signal.SIGXCPU:
        return f"takes more than {most_seconds} s"
    last = "".join(done.stderr.strip().splitlines()[-1:])
    return f"exit {done.returncode}: {last.split('scene.json: ')[-1]}" if done.returncode else ""


def figures_of_start(seed, keep, most_seconds):
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(keep or temporary) / f"seed{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        scene = scene_of(seed, folder)
        path = folder / "scene.json"
        path.write_text(json.dumps(scene))
        run = folder / "run"  # apart from the scene's files, which outputs would overwrite
        done = simulate(path, run, most_seconds)
        error = error_of(done, most_seconds)
        if not done.stdout:
            return {"seed": seed, "failure": error}
        with (run / "frames.csv").open() as table:
            figures = figures_of(seed, scene, json.loads(done.stdout), list(csv.DictReader(table)))
    figures["failure"] = "; ".join(filter(None, (error, figures["failure"])))
    return figures


def look_at(seed, keep, most_seconds):
    """The figures of one start; what went wrong as `failure`."""
    before = processor_seconds()
    figures = figures_of_start(seed, keep, most_seconds)
    return figures | {"seconds": round(processor_seconds() - before, 1), "program": program_name()}


@functools.cache
def program_name():
    """Another one for every build whose code differs."""
    return hashlib.sha256(program.PROGRAM.read_bytes()).hexdigest()[:12]


def figures_in(path):
    """The whole rows of a table that this program made, by their seeds; none where there is no table."""
    if not path.exists():
        return {}
    with path.open() as file:
        return {int(row["seed"]): row for row in csv.DictReader(file) if row.get("program") == program_name()}


def worst_of(rows):
    """A line on what comes nearest to the bounds, of the starts that came to their end."""
    def largest(name):
        row = max(rows, key=lambda row: float(row[name]))
        return f"{float(row[name]):.2g} (seed {row['seed']})" if float(row[name]) > 0 else "nothing"

    rows = [row for row in rows if row.get("strain_p99")]
    if not rows:
        return ""
    late = sum(float(row["lost_share"]) > 0 for row in rows)
    return (f"Largest: {largest('energy_gained_mgl')} of m g 1 m gained, {largest('fell_back_share')} of the points put back, "
            f"p99 of strain {largest('strain_p99')}. In {late} starts some step was cut short since it gained energy"
            + (f"; the most that a frame lost so of its time is {largest('lost_share')}" if late else "") + ".\n")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seeds", type=int, default=200)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--most-seconds", type=int, default=1800, help="of the processor, beyond which a start fails")
    words.add_argument("--keep", type=pathlib.Path, help="leave scenes and runs in this folder")
    words.add_argument("--figures", type=pathlib.Path, default=pathlib.Path("soak.csv"), help="a line for every start")
    words.add_argument("--resume", action="store_true", help="keep the starts that the figures' file has of this program, and run the others")
    words.add_argument("--scene", type=int, metavar="SEED")
    words.add_argument("--write", action="store_true", help="renew the line of docs/measured.md")
    options = words.parse_args()
    if options.scene is not None:
        folder = options.keep or pathlib.Path(tempfile.mkdtemp())
        folder.mkdir(parents=True, exist_ok=True)
        print(json.dumps(scene_of(options.scene, folder), indent=1))
        return
    seeds = range(options.first, options.first + options.seeds)
    known = figures_in(options.figures) if options.resume else {}
    rows = [known[seed] for seed in seeds if seed in known]
    left = [seed for seed in seeds if seed not in known]
    failures = [(seed, known[seed]["failure"]) for seed in seeds if seed in known and known[seed]["failure"]]
    look = functools.partial(look_at, keep=options.keep, most_seconds=options.most_seconds)
    # Processes, each of which knows the time of its own children.
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as jobs, \
            options.figures.open("w", newline="") as file:
        table = csv.DictWriter(file, FIGURES)
        table.writeheader()
        table.writerows(known.values())
        file.flush()
        for figures in jobs.map(look, left):
            table.writerow(figures)
            file.flush()
            rows.append(figures)
            if figures["failure"]:
                failures.append((figures["seed"], figures["failure"]))
                print(f"seed {figures['seed']}: {figures['failure']}", flush=True)
    text = f"{len(seeds)} random starts of {FRAMES} frames, {len(failures)} failed. " + worst_of(rows)
    print(text, end="")
    lines = [f"- seed {seed}: {failure}\n" for seed, failure in sorted(failures)]
    text += "\n" + "".join(lines) if lines else ""
    if options.write:
        program.write_between_marks("docs/measured.md", "soak", text)
    if failures:
        sys.exit("bench: error: starts failed")


if __name__ == "__main__":
    main()
