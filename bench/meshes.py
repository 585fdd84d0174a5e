#!/usr/bin/env python3
"""Converts every mesh of a folder and prints one row each: validity, quality, time.

Usage: bench/meshes.py [--size N] [--meshes FOLDER] [--write] [NAME ...]
"""
import sys
import tempfile

import program

COLUMNS = ("mesh", "triangles", "genus", "borders", "flipped", "degenerate", "mates", "topology", "stretch L2",
           "PSNR dB", "Hausdorff %", "seconds", "of which measuring")


def row_of(path, size):
    with tempfile.TemporaryDirectory() as folder:
        report, error = program.run("convert", path, "-o", f"{folder}/m.exr", "--size", size)
    if error:
        return [path.name, error.replace(str(path), path.name)] + [""] * (len(COLUMNS) - 2)
    given, mapped, image, seconds = (report[key] for key in ("input", "map", "image", "seconds"))
    kept = (given["euler"], given["boundaries"]) == (image["euler"], image["boundaries"])
    genus = "none" if given["genus"] is None else given["genus"]
    return [path.name, given["triangles"], genus, given["boundaries"], mapped["flipped"],
            mapped["degenerate"], "equal" if image["mates_bit_equal"] else "NOT EQUAL", "kept" if kept else "LOST",
            f"{mapped['stretch_l2']:.3f}", f"{image['psnr_db']:.1f}", f"{image['hausdorff_percent']:.2f}",
            f"{seconds['total']:.2f}", f"{seconds['measure']:.2f}"]


if __name__ == "__main__":
    sys.exit(program.mesh_table(__doc__, "meshes", 257, COLUMNS, row_of))
