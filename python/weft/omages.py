"""Object images, as *An Object is Worth 64x64 Pixels* stores them (omages): a surface as one picture of few pixels.

An array (S, S, 12) of uint16, values from 0 to 1 times 65535: 0-2 position, 3 occupancy (a pixel is of the surface above one half),
4-6 normal, 7-9 colour, 10 metal, 11 rough; or (S, S, 4): positions and occupancy alone. Positions and normals are (p + 1) / 2
of p in [-1, 1]; the surface lies in the middle of that cube, its longest side from one end to the other. Files are .npz with
the key ``arr_0``.

Pixels are samples of the image's charts, between which pixels without surface lie, and after the last row and column, as readers
of this format join pixels that are neighbours. Pixels that are one point of the surface hold equal bits: there are no cracks.
"""
import io
import os
import zipfile
import zlib

import numpy as np

from . import _arguments, images
from .errors import InputError

__all__ = ["arrays", "convert", "image", "load", "save", "to_mesh"]
FULL = 65535
_GREY = (0.8, 0.8, 0.8)


def _quantized(values):
    """Numbers in [0, 1] as uint16."""
    return np.rint(np.clip(values, 0, 1) * FULL).astype(np.uint16)


def _cube(points, surface):
    """Points in [-1, 1]^3 by the box of the surface."""
    low, high = surface.min(0), surface.max(0)
    return (points - (low + high) / 2) * (2 / (high - low).max())


def vertex_normals(V, F):
    """(n, 3) unit normals of vertices, faces weighted by their area; zero where faces cancel out."""
    across = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    normals = np.zeros_like(V)
    for corner in range(3):
        np.add.at(normals, F[:, corner], across)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)


def _rows_of(charts, size):
    """Places (row, col) of rectangles in a square, in rows of falling height with a free pixel after each; None where they do not fit."""
    places, row, col, height = {}, 0, 0, 0
    for index in sorted(range(len(charts)), key=lambda k: (-charts[k].rows, -charts[k].cols, k)):
        chart = charts[index]
        if col + chart.cols + 1 > size:
            row, col, height = row + height, 0, 0
        if col + chart.cols + 1 > size or row + chart.rows + 1 > size:
            return None
        places[index] = row, col
        col += chart.cols + 1
        height = max(height, chart.rows + 1)
    return places


def _least_size(charts):
    size = max(max(chart.rows, chart.cols) for chart in charts) + 1
    while _rows_of(charts, size) is None:
        size += 1
    return size


def arrays(image, size=None, *, geometry_only=False, colour=_GREY, metal=0.0, rough=0.5):
    """The array of an image.

    size: pixels a side, S; None: the least that holds all charts. `convert` finds the image for a size instead.
    geometry_only: (S, S, 4) in place of (S, S, 12). colour (3,), metal, rough: of the whole surface, from 0 to 1.
    Returns (S, S, 12) or (S, S, 4) uint16. Raises ValueError where the charts do not fit.
    """
    charts = image.charts
    least = _least_size(charts)
    size = least if size is None else _arguments.integer(size, "size", 1, 1 << 14)
    places = _rows_of(charts, size)
    if places is None:
        raise ValueError(f"size: {least} or more are wanted for the charts of this image, not {size}")
    V, F = image.to_mesh()
    look = [*_arguments.vector(colour, "colour"), _arguments.number(metal, "metal"), _arguments.number(rough, "rough")]
    if not 0 <= min(look) <= max(look) <= 1:
        raise ValueError(f"colour, metal, rough: numbers from 0 to 1 are wanted, not {look}")
    layers = [_cube(image.positions, V) / 2 + 0.5, np.ones((*image.positions.shape[:2], 1))]
    if not geometry_only:
        layers += [vertex_normals(V, F)[image.vertex_of] / 2 + 0.5, np.broadcast_to(look, (*image.positions.shape[:2], 5))]
    pixels = _quantized(np.concatenate(layers, axis=-1))
    made = np.zeros((size, size, pixels.shape[-1]), np.uint16)
    for index, (row, col) in places.items():
        chart = charts[index]
        made[row:row + chart.rows, col:col + chart.cols] = chart.of(pixels)
    return made


def image(V, F, size=64, **options):
    """The largest image of a mesh whose charts fit in (size, size) pixels: what `convert` makes the array of, with the scale that arrays lack.

    options: of `weft.geometry_image`, but for its size.
    Returns a `weft.GeometryImage`. Raises InputError where the charts are too many.
    """
    size = _arguments.integer(size, "size", 8, 1 << 13)
    V, F = _arguments.vertices(V), _arguments.faces(F)
    side, options = size - 1, {"measure": False, **options}
    while True:
        made = images.geometry_image(V, F, size=side, **options)
        if _least_size(made.charts) <= size:
            return made
        # Where charts become too small to hold their seams, an image is larger than was asked for.
        side -= max(1, side // 20)
        if side < 5:
            raise InputError(f"omage: {len(made.charts)} charts are too many for {size} x {size} pixels",
                             found=f"{len(made.charts)} charts", wanted="a larger size")


def convert(V, F, size=64, *, geometry_only=False, **options):
    """The array (size, size, 12) or (size, size, 4) of a mesh, by the largest image whose charts fit.

    options: of `weft.geometry_image`, but for its size.
    """
    return arrays(image(V, F, size, **options), size, geometry_only=geometry_only)


def save(image, path, **options):
    """Writes the array of an image as .npz, whole or not at all; options as of `arrays`."""
    write_npz(path, arr_0=arrays(image, **options))


def write_npz(path, **named):
    """Writes arrays as a compressed .npz under a temporary name, then renames it. The same arrays give the same bytes."""
    name = _arguments.to_write(path)
    bytes_ = io.BytesIO()
    np.savez_compressed(bytes_, **named)
    temporary = f"{name}.{os.getpid()}.tmp"
    try:
        with open(temporary, "wb") as file:
            file.write(bytes_.getbuffer())
        os.replace(temporary, name)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise


def load(path):
    """Reads the array of a file. Raises FileNotFoundError, InputError for what is none."""
    name = _arguments.existing(path)
    try:
        with open(name, "rb") as file, np.load(file, allow_pickle=False) as arrays_of_file:
            array = arrays_of_file["arr_0"]
    except (ValueError, KeyError, OSError, EOFError, TypeError, AttributeError, zipfile.BadZipFile, zlib.error) as error:
        raise InputError(f"{name}: no omage: {error}", where=name, found="no omage", wanted="an .npz with arr_0") from error
    if array.ndim != 3 or array.shape[2] not in (4, 12) or array.dtype != np.uint16:
        raise InputError(f"{name}: an array {array.shape} of {array.dtype}; (S, S, 4) or (S, S, 12) of uint16 is wanted", where=name,
                         found=f"an array {array.shape} of {array.dtype}", wanted="(S, S, 4) or (S, S, 12) of uint16")
    return array


def to_mesh(array):
    """The surface of an array in [-1, 1]^3: two triangles for four neighbours of the surface, pixels of equal position joined.

    Returns V (n, 3) float64, F (m, 3) int32, turned as the normals are where there are some. Raises ValueError for an array of
    another shape, TypeError for one of other numbers: values in [0, 1] are to be multiplied by 65535 and rounded first.
    """
    array = np.asarray(array)
    if array.ndim != 3 or array.shape[2] not in (4, 12):
        raise ValueError(f"array: one of shape (S, S, 4) or (S, S, 12) is wanted, not {array.shape}")
    if array.dtype != np.uint16:
        raise TypeError(f"array: uint16 is wanted, not {array.dtype}")
    values = array.astype(np.float64) / FULL
    occupied = values[..., 3] > 0.5
    _, first, joined = np.unique(array[..., :3][occupied], axis=0, return_index=True, return_inverse=True)
    vertex = np.full(occupied.shape, -1)
    vertex[occupied] = joined
    V = (values[..., :3][occupied] * 2 - 1)[first]
    a, b, c, d = vertex[:-1, :-1], vertex[:-1, 1:], vertex[1:, 1:], vertex[1:, :-1]
    F = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    F = F[(F >= 0).all(1)]
    F = F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]
    if array.shape[2] == 12:
        N = (values[..., 4:7][occupied] * 2 - 1)[first]
        across = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
        backwards = np.einsum("ij,ij->i", across, N[F].sum(1)) < 0
        F[backwards] = F[backwards][:, [0, 2, 1]]
    return V, F.astype(np.int32)
