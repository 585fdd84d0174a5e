#!/usr/bin/env python3
"""Compresses meshes as images and by Draco (Debian package draco), and rebuilds them: bytes and distances side by side.

Usage: bench/compression.py [--meshes FOLDER] [--write] [NAME ...]
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

import program

NAMES = ("bff_kitten.obj", "c3d_rocker-arm.obj", "c3d_stanford-bunny.obj", "cgal_turbine.off", "cipc_skirt8K.obj",
         "igl_camelhead.off", "ode_human_woman.obj", "ode_spot.obj")
BITS = 12
# Sides of images, and bits that lose little beside what their sampling does.
IMAGES = ((129, 11), (257, 12), (513, 14))
COLUMNS = ("mesh", "triangles", "Draco kB", "dB", *(word for side, bits in IMAGES for word in (f"{side}, {bits} bits: kB", "dB")),
           "PNG 257: kB", "dB")


def missing_draco():
    return [name for name in ("draco_encoder", "draco_decoder") if shutil.which(name) is None]


def kilobytes(path):
    return f"{pathlib.Path(path).stat().st_size / 1000:.1f}"


def checked(report, error):
    if error:
        sys.exit(f"compression: {error}")
    return report


def triangles_alone(path, folder):
    """The mesh as PLY without normals, texture coordinates and groups, which Draco would keep; and its triangles."""
    report = checked(*program.run("inspect", path))
    # A conversion of no use but for its mesh would change it: the vertices and faces are copied as they are.
    source = pathlib.Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    out = folder / "plain.obj"
    with open(out, "w", encoding="utf-8") as file:
        if path.suffix == ".off":
            words = [line for line in source[1:] if line.strip() and not line.startswith("#")]
            vertices, faces = map(int, words[0].split()[:2])
            file.writelines(f"v {' '.join(line.split()[:3])}\n" for line in words[1:1 + vertices])
            file.writelines("f " + " ".join(str(int(v) + 1) for v in line.split()[1:]) + "\n"
                            for line in words[1 + vertices:1 + vertices + faces])
        else:
            file.writelines(line + "\n" for line in source if line.startswith("v "))
            file.writelines("f " + " ".join(corner.split("/")[0] for corner in line.split()[1:]) + "\n"
                            for line in source if line.startswith("f "))
    return out, report["input"]["triangles"]


def by_draco(mesh, folder):
    packed, unpacked = folder / "mesh.drc", folder / "mesh.ply"
    for words in (["draco_encoder", "-i", mesh, "-o", packed, "-qp", BITS, "-cl", 10], ["draco_decoder", "-i", packed, "-o", unpacked]):
        subprocess.run(list(map(str, words)), check=True, capture_output=True)
    report = checked(*program.run("inspect", unpacked, "--against", mesh))
    return [kilobytes(packed), f"{report['against']['psnr_db']:.1f}"]


def by_image(mesh, folder, side, bits):
    image = folder / "image.weft"
    report = checked(*program.run("convert", mesh, "-o", image, "--size", side, "--precision", bits, "--fit"))
    return [kilobytes(image), f"{report['image']['psnr_db']:.1f}"]


def by_png(mesh, folder):
    image = folder / "image.png"
    report = checked(*program.run("convert", mesh, "-o", image, "--fit"))
    return [kilobytes(image), f"{report['image']['psnr_db']:.1f}"]


def row_of(path, draco):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh, triangles = triangles_alone(path, folder)
        figures = by_draco(mesh, folder) if draco else ["", ""]
        for side, bits in IMAGES:
            figures += by_image(mesh, folder, side, bits)
        return [path.name, triangles, *figures, *by_png(mesh, folder)]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("names", nargs="*", default=NAMES)
    options = words.parse_args()
    draco = not missing_draco()
    if not draco:
        print(f"compression: no {' and '.join(missing_draco())} (Debian package draco): Draco's columns stay empty", file=sys.stderr)
    text = program.table(COLUMNS, [row_of(options.meshes / name, draco) for name in options.names or NAMES])
    print(text)
    if options.write and not draco:
        print("compression: the table of docs/measured.md stays as it is", file=sys.stderr)
    elif options.write:
        program.write_between_marks("docs/measured.md", "compression", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
