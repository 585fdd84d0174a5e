#!/usr/bin/env python3
"""Converts the meshes that quality is judged by at four sizes; each figure beside the one that is to be beaten.

Usage: bench/targets.py [--meshes FOLDER] [--convert "WORD ..."] [--write] [NAME ...]
"""
import argparse
import pathlib
import sys
import tempfile

import program

SIZES = (65, 129, 257, 513)
# File: L2 stretch; PSNR [dB] at each size; Hausdorff distance at 257 [% of the diagonal].
TARGETS = {
    "gpt_mannequin.off": (1.290, (59.4, 68.0, 76.6, 85.6), 0.36),
    "ode_spot.obj": (1.202, (61.7, 72.6, 82.5, 91.9), 0.18),
    "igl_camelhead.off": (1.234, (62.7, 72.9, 83.3, 93.3), 0.15),
    "c3d_rocker-arm.obj": (1.456, (57.0, 65.6, 74.8, 84.4), 0.40),
    "igl_fertility.off": (1.617, (57.5, 68.2, 78.3, 87.3), 0.17),
    "cgal_turbine.off": (3.751, (50.7, 54.5, 59.4, 67.2), 1.05),
    "ode_boot.obj": (4.946, (42.2, 47.3, 54.0, 60.9), 2.53),
    "c3d_stanford-bunny.obj": (1.485, (57.9, 64.9, 72.7, 82.6), 0.69),
    "bff_kitten.obj": (1.750, (58.4, 68.5, 79.2, 89.9), 0.23),
    "dc_tshirt1000-tri.obj": (1.208, (71.1, 79.6, 88.7, 97.9), 0.11),
}
COLUMNS = ("mesh", "triangles", *(f"stretch {n}" for n in SIZES), *(f"PSNR {n}" for n in SIZES), "Hausdorff 257",
           "seconds 257")


def beside(value, target, digits, better):
    """The figure with its target, in bold where it is not better."""
    text = f"{value:.{digits}f}"
    return f"{text} ({target})" if better(value, target) else f"**{text} ({target})**"


def less(value, target):
    return value < target


def more(value, target):
    return value > target


def row_of(path, words):
    stretch, psnr, distance = TARGETS[path.name]
    reports = {}
    with tempfile.TemporaryDirectory() as folder:
        for size in SIZES:
            reports[size], error = program.run("convert", path, "-o", f"{folder}/m.exr", "--size", size, *words)
            if error:
                return [path.name, error.replace(str(path), path.name)] + [""] * (len(COLUMNS) - 2)
    at_257 = reports[257]
    seconds = at_257["seconds"]
    return [path.name, at_257["input"]["triangles"],
            *(beside(reports[size]["map"]["stretch_l2"], stretch, 3, less) for size in SIZES),
            *(beside(reports[size]["image"]["psnr_db"], wanted, 1, more) for size, wanted in zip(SIZES, psnr)),
            beside(at_257["image"]["hausdorff_percent"], distance, 3, less),
            f"{seconds['total'] - seconds['measure']:.2f}"]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--convert", type=str.split, default=[], help="more words for convert")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*", help="of files, with or without their ending")
    options = words.parse_args()
    names = [n for n in TARGETS if not options.names or n in options.names or n.split(".")[0] in options.names]
    paths = [options.meshes / name for name in names if (options.meshes / name).exists()]
    if not paths:
        print(f"bench: error: none of the wanted meshes in {options.meshes}", file=sys.stderr)
        return 3
    text = program.table(COLUMNS, [row_of(path, options.convert) for path in paths])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "targets", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
