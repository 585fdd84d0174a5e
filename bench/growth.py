#!/usr/bin/env python3
"""Converts built-in shapes at growing numbers of triangles: seconds by stage, speed, memory.

Usage: bench/growth.py [--size N] [--most TRIANGLES] [--write]
"""
import argparse
import pathlib
import sys
import tempfile

import program

SHAPES = ("mannequin", "double_torus")
COARSE_SIZE = 24  # of the image whose rebuilt mesh is refined: 2 * 23 * 23 triangles
PARTS = (1, 2, 4, 7, 10, 14, 20, 31, 44)  # of every edge
STAGES = ("load", "cut", "map", "sample")
COLUMNS = ("mesh", "triangles", *STAGES, "total", "triangles a second", "most of it", "measuring", "peak MB")


def read_obj(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    points = [tuple(map(float, words[1:4])) for words in lines if words[:1] == ["v"]]
    return points, [tuple(int(word) - 1 for word in words[1:4]) for words in lines if words[:1] == ["f"]]


def refined(points, triangles, parts):
    """Every triangle cut into parts * parts, with shared vertices."""
    points = list(points)
    places = {}

    def vertex(corners, weights):
        key = tuple(sorted((corner, weight) for corner, weight in zip(corners, weights) if weight))
        if len(key) == 1:
            return key[0][0]
        if key not in places:
            places[key] = len(points)
            points.append(tuple(sum(points[c][axis] * w for c, w in key) / parts for axis in range(3)))
        return places[key]

    fine = []
    for corners in triangles:
        def at(i, j):
            return vertex(corners, (parts - i - j, i, j))
        for i in range(parts):
            for j in range(parts - i):
                fine.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j + 1 < parts:
                    fine.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, fine


def write_obj(path, points, triangles):
    with open(path, "w") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
        out.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def coarse_shape(name, folder):
    for words in (("convert", f"builtin:{name}", "-o", folder / "coarse.exr", "--size", COARSE_SIZE),
                  ("rebuild", folder / "coarse.exr", "-o", folder / "coarse.obj")):
        _, error = program.run(*words)
        if error:
            sys.exit(f"bench: error: {name}: {error}")
    return read_obj(folder / "coarse.obj")


def row_of(name, mesh, folder, size):
    write_obj(folder / "fine.obj", *mesh)
    report, error = program.run("convert", folder / "fine.obj", "-o", folder / "fine.exr", "--size", size,
                                "--threads", 1)
    if error:
        return [name, len(mesh[1]), error] + [""] * (len(COLUMNS) - 3)
    seconds = report["seconds"]
    total = seconds["total"] - seconds["measure"]
    slowest = max(STAGES, key=lambda stage: seconds[stage])
    return [name, report["input"]["triangles"], *(f"{seconds[stage]:.2f}" for stage in STAGES), f"{total:.2f}",
            f"{report['input']['triangles'] / total:.0f}", f"{slowest} ({100 * seconds[slowest] / total:.0f} %)",
            f"{seconds['measure']:.2f}", f"{report['peak_memory_mb']:.0f}"]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--size", type=int, default=257)
    words.add_argument("--most", type=int, default=2500000, help="leave out larger meshes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for shape in SHAPES:
            points, triangles = coarse_shape(shape, folder)
            for parts in PARTS:
                if len(triangles) * parts ** 2 <= options.most:
                    rows.append(row_of(shape, refined(points, triangles, parts), folder, options.size))
    text = program.table(COLUMNS, rows)
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "growth", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
