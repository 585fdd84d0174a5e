#!/usr/bin/env python3
"""Turns meshes into omages of 64 x 64 pixels and back: Chamfer distance to the mesh, beside that of a plain image of as many samples.

The distance is half the sum of the two one-sided means, exact to the triangles, from 40000 points spread evenly over either surface.

Usage: bench/omages.py [--meshes FOLDER] [--size N] [--write] [NAME ...]
"""
import pathlib
import sys
import tempfile

import numpy as np
import program

sys.path.insert(0, str(program.ROOT / "build/release/python"))
import weft  # noqa: E402
import weft.omages  # noqa: E402

COMPACT = 8  # charts of the last columns
COLUMNS = ("mesh", "triangles", "plain: charts", "Chamfer %", "omage: charts", "pixels used %", "Chamfer %", "of the plain",
           f"omage of {COMPACT} and more charts: charts", "pixels used %", "Chamfer %", "of the plain")


def chamfer_percent(mesh, path, folder):
    """In per cent of the diagonal of the box of the mesh of a file."""
    weft.write_mesh(folder / "back.obj", *mesh)
    report, error = program.run("inspect", folder / "back.obj", "--against", path)
    if error:
        raise weft.Error(error)
    mean = sum(report["against"][side]["mean"] for side in ("from_mesh", "from_subject")) / 2
    V, F = weft.read_mesh(path)
    return 100 * mean / np.linalg.norm(np.ptp(V[F.ravel()], axis=0))


def there_and_back(image, size):
    """The surface of an image's omage, at its own place and size; and the part of the pixels that are of it."""
    array = weft.omages.arrays(image, size)
    V, F = weft.omages.to_mesh(array)
    own = image.to_mesh()[0]
    low, high = own.min(0), own.max(0)
    return (V * (high - low).max() / 2 + (low + high) / 2, F), (array[..., 3] > 0).mean()


def figures_of(path, size, charts, plain, folder):
    """Charts, pixels used, distance and its ratio to the plain one; or why there are none."""
    try:
        image = weft.omages.image(*weft.read_mesh(path), size, charts=charts)
    except weft.Error as error:
        return [str(error), "", "", ""]
    mesh, used = there_and_back(image, size)
    distance = chamfer_percent(mesh, path, folder)
    return [len(image.charts), f"{100 * used:.0f}", f"{distance:.4f}", f"{distance / plain:.2f}"]


def row_of(path, size):
    V, F = weft.read_mesh(path)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        image = weft.geometry_image(V, F, size=size, charts="pieces", measure=False)
        plain = chamfer_percent(image.to_mesh(), path, folder)
        grown = f" at {image.size}" if image.size != size else ""
        return [path.name, len(F), f"{len(image.charts)}{grown}", f"{plain:.4f}", *figures_of(path, size, "auto", plain, folder),
                *figures_of(path, size, COMPACT, plain, folder)]


if __name__ == "__main__":
    sys.exit(program.mesh_table(__doc__, "omages", 64, COLUMNS, row_of))
