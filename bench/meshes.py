#!/usr/bin/env python3
"""Converts every mesh of a folder and prints one row each: validity, quality, time.

Usage: bench/meshes.py [--size N] [--meshes FOLDER] [NAME ...]
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = ("mesh", "genus", "borders", "flipped", "degenerate", "mates", "topology", "stretch L2",
           "PSNR dB", "Hausdorff %", "seconds", "of which measuring")


def row_of(path: pathlib.Path, size: int) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        command = [ROOT / "build/release/bin/weft", "convert", path, "-o", f"{folder}/m.exr",
                   "--size", str(size), "--json", "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        return [path.name, f"exit {done.returncode}: {done.stderr.strip()}"]
    report = json.loads(done.stdout)
    given, mapped, image, seconds = (report[key] for key in ("input", "map", "image", "seconds"))
    kept = (given["euler"], given["boundaries"]) == (image["euler"], image["boundaries"])
    return [path.name, str(given["genus"]), str(given["boundaries"]), str(mapped["flipped"]),
            str(mapped["degenerate"]), "equal" if image["mates_bit_equal"] else "NOT EQUAL",
            "kept" if kept else "LOST", f"{mapped['stretch_l2']:.3f}", f"{image['psnr_db']:.1f}",
            f"{image['hausdorff_percent']:.2f}", f"{seconds['total']:.2f}", f"{seconds['measure']:.2f}"]


def main() -> int:
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--size", type=int, default=257)
    words.add_argument("--meshes", type=pathlib.Path, default=ROOT.parent / "shared/meshes")
    words.add_argument("names", nargs="*")
    options = words.parse_args()
    paths = sorted(p for p in options.meshes.glob("*") if p.suffix in (".obj", ".off", ".ply", ".stl"))
    paths = [p for p in paths if not options.names or p.name in options.names or p.stem in options.names]
    if not paths:
        print(f"bench: error: no meshes in {options.meshes}", file=sys.stderr)
        return 3
    print("| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|")
    for path in paths:
        print("| " + " | ".join(row_of(path, options.size)) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
