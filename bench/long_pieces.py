#!/usr/bin/env python3
"""Converts meshes of long pieces: how many charts are rectangles, how many samples they have, how near the image is.

Usage: bench/long_pieces.py [--write]
"""
import argparse
import pathlib
import sys
import tempfile

import long_shapes
import program

COLUMNS = ("mesh", "size", "charts", "rectangles", "samples in charts", "stretch L2", "PSNR dB", "Hausdorff %", "coarser levels")
SHAPES = {"strips": "auto", "robot": "auto", "belt": "uv"}
SIZES = (257, 513)


def write_obj(path, points, triangles, corners=()):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
        file.writelines(f"vt {u!r} {v!r}\n" for face in corners for u, v in face)
        for t, face in enumerate(triangles):
            file.write("f " + " ".join(f"{v + 1}/{3 * t + k + 1}" if corners else f"{v + 1}" for k, v in enumerate(face)) + "\n")


def row_of(name, size, folder):
    mesh, image = f"{folder}/{name}.obj", f"{folder}/{name}.exr"
    report, error = program.run("convert", mesh, "-o", image, "--size", size, "--charts", SHAPES[name])
    if error:
        return [name, size, error.replace(folder, "")] + [""] * (len(COLUMNS) - 3)
    charts, quality = report["charts"], report["image"]
    inspected, _ = program.run("inspect", image)
    return [name, size, len(charts), sum(c["rows"] != c["cols"] for c in charts), sum(c["rows"] * c["cols"] for c in charts),
            f"{report['map']['stretch_l2']:.2f}", f"{quality['psnr_db']:.1f}", f"{quality['hausdorff_percent']:.2f}",
            inspected["image"]["coarsest_level"]]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name in SHAPES:
            write_obj(pathlib.Path(folder, f"{name}.obj"), *getattr(long_shapes, name)())
        text = program.table(COLUMNS, [row_of(name, size, folder) for name in SHAPES for size in SIZES])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "long_pieces", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
