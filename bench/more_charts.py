#!/usr/bin/env python3
"""Converts meshes, and shapes that one square samples badly, with --charts pieces and auto: quality and time side by side.

Usage: bench/more_charts.py [--meshes FOLDER] [--threads N] [--write] [NAME ...]
"""
import argparse
import pathlib
import resource
import sys
import tempfile

import hard_shapes
import program

COLUMNS = ("mesh", "size", "charts", "auto", "stretch L2", "auto", "PSNR dB", "auto", "Hausdorff %", "auto", "processor seconds", "auto")
SHAPES = {"helix": 513, "needle": 513, "lattice": 1025}
SIZE = 257


def write_obj(path, points, triangles):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def processor_seconds():
    """Of all programs that have been run so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def figures_of(report, seconds):
    image = report["image"]
    return [len(report["charts"]), f"{report['map']['stretch_l2']:.3g}", f"{image['psnr_db']:.1f}",
            f"{image['hausdorff_percent']:.2f}", f"{seconds:.1f}"]


def row_of(path, size, threads):
    figures = []
    with tempfile.TemporaryDirectory() as folder:
        for charts in ("pieces", "auto"):
            before = processor_seconds()
            report, error = program.run("convert", path, "-o", f"{folder}/m.exr", "--size", size, "--charts", charts,
                                        "--threads", threads)
            if error:
                return [path.name, size, error.replace(str(path), path.name)] + [""] * (len(COLUMNS) - 3)
            figures.append(figures_of(report, processor_seconds() - before))
    return [path.name, size, *(figure for both in zip(*figures) for figure in both)]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--threads", type=int, default=1)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*")
    options = words.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        jobs = []
        for name, size in SHAPES.items():
            if not options.names or name in options.names:
                path = pathlib.Path(folder, f"{name}.obj")
                write_obj(path, *getattr(hard_shapes, name)())
                jobs.append((path, size))
        jobs += [(path, SIZE) for path in program.meshes_in(options.meshes, options.names)]
        text = program.table(COLUMNS, [row_of(path, size, options.threads) for path, size in jobs])
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "more_charts", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
