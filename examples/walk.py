#!/usr/bin/env python3
"""Makes a point cache (PC2) of the built-in mannequin that walks on the spot, bends and turns.

Usage: walk.py WALK.pc2 [--weft PROGRAM]     (scenes/walking_mannequin.json wants it as scenes/walk.pc2)
"""
import argparse
import math
import pathlib
import struct
import subprocess
import tempfile

FRAME_RATE, FRAMES_A_SAMPLE, SECONDS = 60, 3, 2.5
STEPS_A_SECOND = 1.6
# Joints of the mannequin at x > 0, and the axes' heights [m].
SHOULDER, HIP, KNEE, WAIST = (0.165, 1.395, -0.016), (0.09, 0.92, -0.005), (0.115, 0.48, -0.005), (0, 1.0, -0.01)


def vertices_of(program):
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "mannequin.obj"
        subprocess.run([program, "shapes", "mannequin", "-o", mesh], check=True, stdout=subprocess.DEVNULL)
        return [tuple(map(float, line.split()[1:4])) for line in mesh.read_text().splitlines() if line.startswith("v ")]


def eased(x, low, high):
    """0 below, 1 above, smooth between."""
    t = min(1.0, max(0.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def turned(p, centre, axis, angle):
    """About the axis x (0), y (1) or z (2) through a point."""
    i, j = ((1, 2), (2, 0), (0, 1))[axis]
    c, s = math.cos(angle), math.sin(angle)
    a, b = p[i] - centre[i], p[j] - centre[j]
    q = list(p)
    q[i], q[j] = centre[i] + c * a - s * b, centre[j] + s * a + c * b
    return q


def weights_of(p):
    """How far arm, leg, shin and trunk carry a vertex."""
    side, height = abs(p[0]), p[1]
    # Along the arm, from the shoulder outward and down.
    along = ((side - SHOULDER[0]) * 0.70 + (SHOULDER[1] - height) * 0.71)
    middle = SHOULDER[0] + 0.92 * (SHOULDER[1] - height)
    arm = eased(along, 0.0, 0.12) * eased(side, middle - 0.13, middle - 0.07) if height > 0.75 else 0.0
    leg = (1 - eased(height, 0.76, 0.95)) * (1 - arm)
    shin = (1 - eased(height, 0.42, 0.54)) * (1 - arm)
    return arm, leg, shin, eased(height, 0.92, 1.30)


def posed(p, weights, seconds):
    arm, leg, shin, trunk = weights
    side = 1 if p[0] > 0 else -1
    begun = eased(seconds, 0, 0.4)
    stride = math.sin(math.pi * STEPS_A_SECOND * seconds) * begun * side
    at = lambda joint: (side * joint[0], joint[1], joint[2])
    p = turned(p, at(KNEE), 0, shin * 0.45 * max(0.0, -stride))
    p = turned(p, at(HIP), 0, -leg * 0.38 * stride)
    p = turned(p, at(SHOULDER), 0, arm * 0.45 * stride)
    bend = math.sin(math.pi * seconds / SECONDS) ** 2
    p = turned(p, WAIST, 0, trunk * 0.45 * bend)
    p = turned(p, WAIST, 1, trunk * 0.5 * math.sin(2 * math.pi * seconds / SECONDS))
    return turned(p, (0, 0, 0), 1, math.pi * eased(seconds, 0.2, SECONDS))


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("cache", type=pathlib.Path)
    words.add_argument("--weft", default=pathlib.Path(__file__).resolve().parent.parent / "build/release/bin/weft")
    options = words.parse_args()
    rest = [(p, weights_of(p)) for p in vertices_of(options.weft)]
    samples = round(SECONDS * FRAME_RATE / FRAMES_A_SAMPLE) + 1
    parts = [struct.pack("<12siiffi", b"POINTCACHE2", 1, len(rest), 0, FRAMES_A_SAMPLE, samples)]
    for k in range(samples):
        seconds = k * FRAMES_A_SAMPLE / FRAME_RATE
        parts += [struct.pack("<3f", *posed(p, weights, seconds)) for p, weights in rest]
    options.cache.write_bytes(b"".join(parts))


if __name__ == "__main__":
    main()
