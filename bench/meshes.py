#!/usr/bin/env python3
"""Converts every mesh of a folder and prints one row each: validity, quality, time.

Usage: bench/meshes.py [--size N] [--meshes FOLDER] [--write] [NAME ...]
"""
import argparse
import pathlib
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


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--size", type=int, default=257)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*")
    options = words.parse_args()
    paths = sorted(p for p in options.meshes.glob("*") if p.suffix in (".obj", ".off", ".ply", ".stl", ".glb"))
    paths = [p for p in paths if not options.names or p.name in options.names or p.stem in options.names]
    if not paths:
        print(f"bench: error: no meshes in {options.meshes}", file=sys.stderr)
        return 3
    text = program.table(COLUMNS, [row_of(path, options.size) for path in paths])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "meshes", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
