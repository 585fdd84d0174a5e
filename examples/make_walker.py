#!/usr/bin/env python3
"""Makes a skinned figure (GLB): the built-in mannequin with 19 joints and the animations 'walk' and 'wave'.

Usage: make_walker.py FIGURE.glb [--weft PROGRAM]     (scenes/skinned_walk.json and dressed_walk.json want it as scenes/figure.glb)
"""
import argparse
import json
import math
import pathlib
import struct
import subprocess
import tempfile

# Name, parent, place [m], radius of the bone that begins there [m]; facing +z. Paired joints at x > 0 are the left ones.
MIDDLE = [("hips", None, (0, 0.95, -0.01), 0.13), ("spine", "hips", (0, 1.08, -0.01), 0.12),
          ("chest", "spine", (0, 1.24, -0.01), 0.13), ("neck", "chest", (0, 1.47, -0.02), 0.05),
          ("head", "neck", (0, 1.56, 0.0), 0.09)]
PAIRS = [("arm", "chest", (0.168, 1.398, -0.016), 0.05), ("forearm", "arm", (0.372, 1.190, -0.022), 0.036),
         ("hand", "forearm", (0.536, 0.998, 0.026), 0.025),
         ("thigh", "hips", (0.092, 0.90, -0.006), 0.08), ("shin", "thigh", (0.114, 0.48, 0.0), 0.05),
         ("foot", "shin", (0.129, 0.075, -0.02), 0.035), ("toes", "foot", (0.142, 0.025, 0.10), 0.025)]
TIPS = {"head": (0, 1.70, 0.0), "hand": (0.61, 0.86, 0.05), "toes": (0.156, 0.015, 0.16), "hips": (0, 1.08, -0.01)}
SOLES = [("foot", (0.129, 0.0, -0.06)), ("toes", (0.142, 0.0, 0.09)), ("toes", (0.15, 0.0, 0.165))]
CYCLE, CYCLES, KEYS = 1.15, 3, 24  # seconds a cycle of two steps, how many, keys in each


def joints():
    """All joints, parents before their children."""
    made = [dict(name=name, parent=parent, place=place, radius=radius) for name, parent, place, radius in MIDDLE]
    for side, sign in (("left", 1), ("right", -1)):
        for name, parent, (x, y, z), radius in PAIRS:
            paired = parent in [pair[0] for pair in PAIRS]
            made.append(dict(name=f"{side}_{name}", parent=f"{side}_{parent}" if paired else parent,
                             place=(sign * x, y, z), radius=radius))
    return made


def end_of(joint, all_joints):
    """Where the bone that begins at a joint ends."""
    side, _, kind = joint["name"].rpartition("_")
    if kind in TIPS:
        x, y, z = TIPS[kind]
        return (-x if side == "right" else x, y, z)
    return next(other["place"] for other in all_joints if other["parent"] == joint["name"])


def distance(p, a, b):
    """From a point to a segment."""
    along = [b[k] - a[k] for k in range(3)]
    part = sum((p[k] - a[k]) * along[k] for k in range(3)) / sum(x * x for x in along)
    part = min(1.0, max(0.0, part))
    return math.dist(p, [a[k] + part * along[k] for k in range(3)])


def weights_of(p, bones):
    """The four nearest bones' numbers and weights in 1/65535, which add up to 65535."""
    near = sorted((distance(p, a, b) - radius, number) for number, (a, b, radius) in enumerate(bones))[:4]
    shares = [math.exp((near[0][0] - far) / 0.018) for far, _ in near]
    whole = [round(65535 * share / sum(shares)) for share in shares]
    whole[0] += 65535 - sum(whole)
    return [number for _, number in near], whole


def quaternion(x=0.0, y=0.0, z=0.0):
    """Of a turn about z, then y, then x [degrees]: x, y, z, w."""
    def product(a, b):
        return (a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
                a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2])
    half = [math.radians(angle) / 2 for angle in (x, y, z)]
    turns = [(math.sin(half[0]), 0, 0, math.cos(half[0])), (0, math.sin(half[1]), 0, math.cos(half[1])),
             (0, 0, math.sin(half[2]), math.cos(half[2]))]
    return product(product(turns[0], turns[1]), turns[2])


def rotated(q, v):
    """A vector turned by a unit quaternion."""
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    t = [2 * c for c in cross(q, v)]
    u = cross(q, t)
    return tuple(v[k] + q[3] * t[k] + u[k] for k in range(3))


def bump(phase, middle, width):
    """1 at a phase of the cycle, 0 where it is farther than the width."""
    away = abs((phase - middle + 0.5) % 1 - 0.5) / width
    return (1 - away * away) ** 2 if away < 1 else 0.0


def leg(phase):
    """Turns of thigh, shin and foot about x [degrees] after the heel's strike at phase 0."""
    # Evenly back while it carries, for half a cycle, then swung to the front.
    forward = 1 - 4 * phase if phase < 0.5 else -math.cos(2 * math.pi * (phase - 0.5))
    thigh = -(3 + 22 * forward)
    shin = 6 + 54 * bump(phase, 0.74, 0.25) + 8 * bump(phase, 0.12, 0.15)
    pitch = 26 * bump(phase, 0.62, 0.2) - 12 * bump(phase, 0.0, 0.1)  # of the foot over the ground
    return thigh, shin, pitch - thigh - shin


def walking(phase):
    """Turns of the joints at a phase of the walk; those left out do not turn."""
    turns = {"hips": dict(y=5 * math.cos(2 * math.pi * phase)), "chest": dict(y=-9 * math.cos(2 * math.pi * phase), x=3),
             "head": dict(y=4 * math.cos(2 * math.pi * phase))}
    for side, sign, at in (("left", 1, phase), ("right", -1, phase + 0.5)):
        thigh, shin, foot = leg(at % 1)
        swing = 19 * math.cos(2 * math.pi * at)  # against the leg
        turns[f"{side}_thigh"], turns[f"{side}_shin"] = dict(x=thigh), dict(x=shin)
        turns[f"{side}_foot"] = dict(x=foot)
        turns[f"{side}_toes"] = dict(x=-25 * bump(at % 1, 0.58, 0.14))
        turns[f"{side}_arm"] = dict(x=swing, z=-sign * 6)
        turns[f"{side}_forearm"] = dict(x=-14 + 0.4 * min(0.0, swing))
    return turns


def soles(turns, all_joints):
    """Where points under both feet are, for hips in their place."""
    placed = {}
    for joint in all_joints:
        q = quaternion(**turns.get(joint["name"], {}))
        parent = placed.get(joint["parent"])
        if parent is None:
            placed[joint["name"]] = (joint, [q], joint["place"])
            continue
        offset = [joint["place"][k] - parent[0]["place"][k] for k in range(3)]
        for turn in reversed(parent[1]):
            offset = rotated(turn, offset)
        placed[joint["name"]] = (joint, parent[1] + [q], tuple(parent[2][k] + offset[k] for k in range(3)))
    points = []
    for side, sign in (("left", 1), ("right", -1)):
        for name, (x, y, z) in SOLES:
            joint, chain, place = placed[f"{side}_{name}"]
            offset = [sign * x - joint["place"][0], y - joint["place"][1], z - joint["place"][2]]
            for turn in reversed(chain):
                offset = rotated(turn, offset)
            points.append(tuple(place[k] + offset[k] for k in range(3)))
    return points


def walk(all_joints):
    """Keys of the walk: times, turns, places of the hips. The lowest sole is on the ground; the hips go evenly, as far as the
    feet carry them."""
    times, poses, hips = [], [], []
    forward, before = 0.0, None
    for key in range(CYCLES * KEYS + 1):
        turns = walking(key / KEYS % 1)
        points = soles(turns, all_joints)
        if before is not None:
            carrying = range(3) if (key - 1) / KEYS % 1 < 0.5 else range(3, 6)  # soles of the left foot, or of the right
            sole = min(carrying, key=lambda k: points[k][1])
            forward += before[sole][2] - points[sole][2]
        before = points
        times.append(key * CYCLE / KEYS)
        poses.append(turns)
        x, y, z = all_joints[0]["place"]
        hips.append((x, y - min(point[1] for point in points), z))
    step = forward / (len(times) - 1)
    return times, poses, [(x, y, z + step * key) for key, (x, y, z) in enumerate(hips)]


def wave(all_joints):
    """Keys of a wave of the right hand."""
    times = [0.0, 0.8, 1.15, 1.5, 1.85, 2.2, 3.0]
    raised = [0, 1, 1, 1, 1, 1, 0]
    bent = [0, 35, 75, 35, 75, 35, 0]
    poses = [{"right_arm": dict(z=-95 * up), "right_forearm": dict(z=-bend), "head": dict(z=6 * up),
              "chest": dict(z=3 * up)} for up, bend in zip(raised, bent)]
    return times, poses, [all_joints[0]["place"]] * len(times)


class Document:
    """A GLB file as it grows."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "make_walker.py"}, "accessors": [], "bufferViews": []}
        self.binary = b""

    def accessor(self, rows, code, kind, component, **more):
        """Adds rows of numbers. @return their accessor's number"""
        data = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data + bytes(-len(data) % 4)
        self.json["accessors"].append(dict(bufferView=len(self.json["bufferViews"]) - 1, componentType=component,
                                           count=len(rows), type=kind, **more))
        return len(self.json["accessors"]) - 1

    def floats(self, rows, kind, **more):
        return self.accessor(rows, "f", kind, 5126, **more)

    def animation(self, name, all_joints, keys, spline=False):
        """spline: a cubic spline that rests at each key."""
        times, poses, hips = keys
        clock = self.floats([[t] for t in times], "SCALAR", min=[times[0]], max=[times[-1]])
        made = {"name": name, "samplers": [], "channels": []}

        def add(node, path, values, kind):
            if spline:
                rest = [0.0] * len(values[0])
                values = [row for value in values for row in (rest, value, rest)]
            made["samplers"].append({"input": clock, "output": self.floats(values, kind),
                                     "interpolation": "CUBICSPLINE" if spline else "LINEAR"})
            made["channels"].append({"sampler": len(made["samplers"]) - 1, "target": {"node": node, "path": path}})

        add(1, "translation", hips, "VEC3")
        for number, joint in enumerate(all_joints):
            if any(joint["name"] in pose for pose in poses):
                add(number + 1, "rotation", [quaternion(**pose.get(joint["name"], {})) for pose in poses], "VEC4")
        self.json.setdefault("animations", []).append(made)

    def bytes(self):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def mannequin(program):
    """Vertices and triangles."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "mannequin.obj"
        subprocess.run([program, "shapes", "mannequin", "-o", mesh], check=True, stdout=subprocess.DEVNULL)
        lines = [line.split() for line in mesh.read_text().splitlines()]
    return ([tuple(map(float, line[1:4])) for line in lines if line[:1] == ["v"]],
            [tuple(int(corner.split("/")[0]) - 1 for corner in line[1:4]) for line in lines if line[:1] == ["f"]])


def figure(program):
    """The whole file."""
    vertices, triangles = mannequin(program)
    all_joints = joints()
    numbers = {joint["name"]: number for number, joint in enumerate(all_joints)}
    bones = [(joint["place"], end_of(joint, all_joints), joint["radius"]) for joint in all_joints]
    weights = [weights_of(p, bones) for p in vertices]
    document = Document()
    low, high = ([limit(p[k] for p in vertices) for k in range(3)] for limit in (min, max))
    attributes = {"POSITION": document.floats(vertices, "VEC3", min=low, max=high),
                  "JOINTS_0": document.accessor([numbers for numbers, _ in weights], "B", "VEC4", 5121),
                  "WEIGHTS_0": document.accessor([shares for _, shares in weights], "H", "VEC4", 5123, normalized=True)}
    corners = document.accessor([[corner] for triangle in triangles for corner in triangle], "H", "SCALAR", 5123)
    binds = document.floats([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-x for x in joint["place"]), 1) for joint in all_joints], "MAT4")
    nodes = [{"name": "figure", "mesh": 0, "skin": 0}]
    for joint in all_joints:
        parent = (0, 0, 0) if joint["parent"] is None else all_joints[numbers[joint["parent"]]]["place"]
        node = {"name": joint["name"], "translation": [joint["place"][k] - parent[k] for k in range(3)]}
        children = [numbers[other["name"]] + 1 for other in all_joints if other["parent"] == joint["name"]]
        nodes.append(dict(node, children=children) if children else node)
    document.json.update(
        scene=0, scenes=[{"nodes": [0, 1]}], nodes=nodes,
        meshes=[{"primitives": [{"attributes": attributes, "indices": corners}]}],
        skins=[{"joints": [number + 1 for number in range(len(all_joints))], "inverseBindMatrices": binds}])
    document.animation("walk", all_joints, walk(all_joints))
    document.animation("wave", all_joints, wave(all_joints), spline=True)
    return document.bytes()


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("figure", type=pathlib.Path)
    words.add_argument("--weft", default=pathlib.Path(__file__).resolve().parent.parent / "build/release/bin/weft")
    options = words.parse_args()
    options.figure.write_bytes(figure(options.weft))


if __name__ == "__main__":
    main()
