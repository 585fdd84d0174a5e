"""Panels of a garment as pictures, under the names that GarmageNet's arrays have: one picture a chart.

- ``surf_wcs`` (N, R, R, 3) float32: positions, (p - global_offset) / (global_scale / 2); ``surf_ncs``: each panel moved and scaled into
  [-1, 1] by its own box, the longest side from one end to the other.
- ``surf_mask`` (N, R, R, 1) bool: whether a pixel is of the panel; all are, as charts fill their squares.
- ``surf_uv_wcs`` (N, R, R, 2) float32: the panel as a flat rectangle of its mean lengths, (q - uv_offset) / (uv_scale / 2);
  ``surf_uv_ncs``: each in [-1, 1] by its own box.
- ``surf_normals`` (N, R, R, 3) float32, unit.
- ``surf_bbox_wcs`` (N, 6), ``surf_uv_bbox_wcs`` (N, 4): least and largest corner of each panel in ``surf_wcs`` and ``surf_uv_wcs``.
- ``global_offset`` (3,), ``global_scale``, ``uv_offset`` (2,), ``uv_scale``: in metres, to come back from all of these.

Rows run along v, columns along u. Files are .npz without pickles.
"""
import numpy as np

from . import _arguments
from .omages import vertex_normals, write_npz

__all__ = ["arrays", "save"]
# A box of 2 m on the floor, and one of 1.5 m for flat panels: what published models were trained with.
_OFFSET, _SCALE = np.array([0.0, 1.0, 0.0]), 2.0
_UV_OFFSET, _UV_SCALE = np.array([0.0, 1.0]), 1.5


def _between(grid, rows, cols):
    """A grid (m, n, c) at R x R places that are spread evenly over it, its corners among them; linear between samples."""
    low_row, low_col = (np.minimum(np.floor(at).astype(int), count - 2) for at, count in zip((rows, cols), grid.shape))
    r, c = (rows - low_row)[:, None, None], (cols - low_col)[None, :, None]
    corner = [[grid[np.ix_(low_row + i, low_col + k)] for k in (0, 1)] for i in (0, 1)]
    upper, lower = (1 - c) * corner[0][0] + c * corner[0][1], (1 - c) * corner[1][0] + c * corner[1][1]
    return (1 - r) * upper + r * lower


def _box(points):
    flat = points.reshape(points.shape[0], -1, points.shape[-1])
    return flat.min(1), flat.max(1)


def _own(points):
    """Each panel in [-1, 1] by its own box."""
    low, high = _box(points)
    half = np.maximum((high - low).max(1), np.finfo(np.float32).tiny)[:, None] / 2
    return (points - ((low + high) / 2)[:, None, None]) / half[:, None, None]


def _flat(panel):
    """A panel (rows, cols, 3) as a rectangle of its mean lengths along rows and columns. [m]"""
    lengths = [np.linalg.norm(np.diff(panel, axis=axis), axis=-1).sum(axis).mean() for axis in (1, 0)]
    v, u = np.meshgrid(np.linspace(0, lengths[1], panel.shape[0]), np.linspace(0, lengths[0], panel.shape[1]), indexing="ij")
    return np.stack([u, v], -1)


def arrays(image, resolution=256, *, uniform=True):
    """The arrays of an image, one picture a chart: {name: array}, as the module says.

    resolution: R, pixels a side. uniform: in the box of 2 m that published models use; False: in the image's own.
    """
    R = _arguments.integer(resolution, "resolution", 2, 1 << 13)
    V, F = image.to_mesh()
    normals = vertex_normals(V, F)[image.vertex_of]
    points, flats, turned = [], [], []
    for chart in image.charts:
        rows, cols = np.linspace(0, chart.rows - 1, R), np.linspace(0, chart.cols - 1, R)
        points.append(_between(chart.positions, rows, cols))
        flats.append(_between(_flat(chart.positions), rows, cols))
        turned.append(_between(chart.of(normals), rows, cols))
    points, flats, turned = np.stack(points), np.stack(flats), np.stack(turned)
    turned /= np.maximum(np.linalg.norm(turned, axis=-1, keepdims=True), 1e-30)
    offset, scale, uv_offset, uv_scale = _OFFSET, _SCALE, _UV_OFFSET, _UV_SCALE
    if not uniform:
        offset, scale = (V.min(0) + V.max(0)) / 2, np.ptp(V, axis=0).max()
        reach = flats.reshape(-1, 2)
        uv_offset, uv_scale = (reach.min(0) + reach.max(0)) / 2, np.ptp(reach, axis=0).max()
    wcs = ((points - offset) / (scale / 2)).astype(np.float32)
    uv_wcs = ((flats - uv_offset) / (uv_scale / 2)).astype(np.float32)
    return {"surf_wcs": wcs, "surf_ncs": _own(points).astype(np.float32), "surf_mask": np.ones((*wcs.shape[:3], 1), bool),
            "surf_uv_wcs": uv_wcs, "surf_uv_ncs": _own(flats).astype(np.float32), "surf_normals": turned.astype(np.float32),
            "surf_bbox_wcs": np.concatenate(_box(wcs), axis=1), "surf_uv_bbox_wcs": np.concatenate(_box(uv_wcs), axis=1),
            "global_offset": offset.astype(np.float32), "global_scale": np.float32(scale),
            "uv_offset": uv_offset.astype(np.float32), "uv_scale": np.float32(uv_scale)}


def save(image, path, **options):
    """Writes the arrays as .npz, whole or not at all; options as of `arrays`."""
    write_npz(path, **arrays(image, **options))
