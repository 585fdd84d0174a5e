"""Meshes as arrays, and geometry images."""
import importlib

import numpy as np

from . import _arguments, _weft

_CHOICES = {"auto": 0, "pieces": -1, "uv": -2, "one": -4}  # as the library numbers them


class Chart:
    """A rectangle of samples in an image: one disk of the surface.

    Fields: ``name`` (may be empty), ``row``, ``col`` (of its first sample), ``rows``, ``cols``.
    """

    def __init__(self, image, place):
        self._image = image
        self.name, self.row, self.col, self.rows, self.cols = place

    def of(self, grid):
        """The part of an array (n, n, ...) of the image's samples that lies in this chart, as a view."""
        return grid[self.row:self.row + self.rows, self.col:self.col + self.cols]

    @property
    def positions(self):
        """(rows, cols, 3) float64 [m]: a view of the image's positions, which it keeps alive. Not to be written to."""
        return self.of(self._image.positions)

    def __repr__(self):
        return f"<weft.Chart {self.name!r} {self.rows} x {self.cols} at ({self.row}, {self.col})>"


class GeometryImage:
    """A surface as an n x n picture whose colours are positions: one chart that fills it, or several.

    Made by `geometry_image`, `load` or `builtin`; never changed. Samples that are copies of one point of the surface
    hold the same bits.

    Fields: ``report`` (what the conversion told: ``input``, ``map``, ``quality``, ``warnings``, ``seconds``; empty for
    images that were loaded), ``normals`` (float32 (N, N, 3), unit outward normals of the mesh over the image's square,
    where ``normal_map=N`` was asked for; else None).
    """

    def __init__(self, image, report=None, normals=None):
        self._core = image
        self.report = report or {}
        self.normals = normals
        if normals is not None:
            normals.flags.writeable = False
        self._positions = self._rebuilt = self._coarsest = None

    @property
    def size(self):
        """Samples a side, n."""
        return self._core.size

    @property
    def source(self):
        """What it was made from: a file's name or builtin:NAME."""
        return self._core.source

    @property
    def charts(self):
        """List of `Chart`, the largest area first."""
        return [Chart(self, place) for place in self._core.charts()]

    @property
    def positions(self):
        """(n, n, 3) float64 [m]: rows along v, columns along u. Samples of no chart copy one beside them. Read-only."""
        if self._positions is None:
            positions = self._core.positions()
            positions.flags.writeable = False
            self._positions = positions
        return self._positions

    @property
    def classes(self):
        """(n, n) int32: the sample (row * n + col) that stands for the surface point of each; -1 where no chart is."""
        return self._core.classes()

    @property
    def occupancy(self):
        """(n, n) bool: whether a sample lies in a chart."""
        return self.classes >= 0

    @property
    def quality(self):
        """Distances and topology against the mesh (``psnr_db``, ``hausdorff_percent``, ...), where they were measured."""
        return self.report.get("quality")

    @property
    def coarsest_level(self):
        """The coarsest level that `to_mesh` can rebuild; 0: itself alone."""
        if self._coarsest is None:
            self._coarsest = self._core.coarsest_level
        return self._coarsest

    def _mesh(self):
        if self._rebuilt is None:
            self._rebuilt = self._core.rebuild(0)
            for array in self._rebuilt:
                array.flags.writeable = False
        return self._rebuilt

    @property
    def vertex_of(self):
        """(n, n) int32: the vertex of `to_mesh` that each sample is."""
        return self._mesh()[2]

    @property
    def sample_of(self):
        """(V,) int32: the sample, row * n + col, of each vertex of `to_mesh`."""
        return self._mesh()[3]

    def to_mesh(self, level=0):
        """The surface as a mesh, seams joined.

        level: of every 2**level-th sample, from 0 to ``coarsest_level``.
        Returns V (n, 3) float64 [m], F (m, 3) int32.
        """
        if level == 0:
            V, F = self._mesh()[:2]
            return V.copy(), F.copy()
        return self._core.rebuild(_arguments.integer(level, "level", 0, self.coarsest_level))[:2]

    def save(self, path, format=None, **options):
        """Writes the image, whole or not at all.

        format: None: by the ending of the name, ``.exr`` (float32, the same bits when loaded again) or ``.png`` (16 bits);
        "omages" or "garmage": arrays for machine learning as .npz, with the options of `weft.omages.arrays` or
        `weft.garmage.arrays`.
        Raises ValueError for another ending or format, FileNotFoundError for a missing folder, OutputError.
        """
        name = _arguments.to_write(path)
        if format is None:
            if options:
                raise TypeError(f"save: '{next(iter(options))}' goes with no format, or 'omages' or 'garmage' alone")
            self._core.save(name)
            return
        _arguments.choice(format, "format", ("omages", "garmage"))
        importlib.import_module(f"weft.{format}").save(self, name, **options)

    def __reduce__(self):
        return _again, (self._core.exr(), self.report, self.normals)

    def __repr__(self):
        charts = len(self._core.charts())
        return f"<weft.GeometryImage {self.size} x {self.size}, {charts} chart{'s' if charts != 1 else ''}, of {self.source!r}>"


def _again(exr, report, normals):
    """An image from its bytes: as it travels between processes."""
    return GeometryImage(_weft.image_from_exr(exr), report, normals)


def read_mesh(path, uv=False):
    """Reads OBJ, OFF, PLY, STL, GLB or glTF, or makes the built-in shape "builtin:NAME".

    Returns V (n, 3) float64 and F (m, 3) int32 as they are in the file, polygons as triangles; with ``uv`` also the texture
    coordinates of the faces' corners, (m, 3, 2) float32, or None where there are none.
    Raises FileNotFoundError, InputError (with FILE:LINE where the format has lines).
    """
    name = _arguments.path(path)
    if not name.startswith("builtin:"):
        _arguments.existing(name)
    V, F, corners = _weft.read_mesh(name)
    return (V, F, corners) if uv else (V, F)


def write_mesh(path, V, F):
    """Writes OBJ or PLY by the ending of the name; read again, the numbers have the same bits."""
    V, F = _arguments.vertices(V), _arguments.faces(F)
    if not (len(V) and len(F)):
        raise ValueError("V, F: at least one vertex and one face are wanted")
    if not np.isfinite(V).all():
        raise ValueError(f"V: vertex {np.argwhere(~np.isfinite(V))[0][0]} is not finite")
    if not 0 <= F.min() <= F.max() < len(V):
        raise ValueError(f"F: indices from 0 to {len(V) - 1} are wanted, not {F.min()} to {F.max()}")
    _weft.write_mesh(_arguments.to_write(path), V, F)


def _chart_number(charts):
    if isinstance(charts, str):
        return _CHOICES[_arguments.choice(charts, "charts", tuple(_CHOICES))]
    return _arguments.integer(charts, "charts", 1, _weft.largest_chart_count)


def _component_number(component):
    if component == "largest":
        return -1
    return _arguments.integer(component, "component", 0, 2**31 - 1)


def _cut_paths(cut):
    if any(np.ndim(path) != 1 for path in cut):
        raise ValueError(f"cut: a list of paths, each a list of vertices, is wanted, not {cut!r:.60}")
    return [[_arguments.integer(vertex, "cut", 0, 2**31 - 1) for vertex in path] for path in cut]


def geometry_image(V, F, size=257, charts="auto", *, uv=None, parameterizer="stretch", component=None, cut=None,
                   seed_triangle=None, normal_map=None, fit=False, measure=True, seed=1, name="mesh", threads=None,
                   progress=None):
    """Turns a mesh of any genus into a geometry image: the same bits as `weft convert` makes, for any number of threads.

    V: (n, 3) [m], F: (m, 3) indices from 0, of any type of number and order in memory.
    size: samples a side, or "auto": by the mesh.
    charts: "auto" (as few as may be, more where that is poor), "pieces" (one for each connected piece), "uv" (one for each
    island of the texture), N (so many compact ones), "one" (a mesh of several pieces is refused).
    uv: (m, 3, 2) texture coordinates of the faces' corners, for charts="uv".
    component: of several pieces one alone: a number, the largest is 0, or "largest".
    parameterizer: "stretch" or "floater". cut: list of paths of vertices to cut along. seed_triangle: where the cut begins.
    normal_map: samples a side of the normals that are kept in ``normals``.
    fit: move samples so that the surface between them is nearer to the mesh.
    measure: whether ``quality`` is measured, by random points of this seed.
    name: what errors and the image's metadata call the mesh.
    progress: called with (stage, fraction of it), or a bar like tqdm's; what it raises stops the conversion.
    Raises ValueError for shapes and ranges, InputError, TopologyError.
    """
    V, F = _arguments.vertices(V), _arguments.faces(F)
    if uv is not None and charts != "uv":
        raise ValueError(f"uv: goes with charts='uv', not {charts!r:.60}")
    options = {"charts": _chart_number(charts), "fit": _arguments.flag(fit, "fit"), "measure": _arguments.flag(measure, "measure"),
               "seed": _arguments.integer(seed, "seed", 0, 2**64 - 1), "threads": _arguments.threads(threads),
               "parameterizer": _arguments.choice(parameterizer, "parameterizer", ("stretch", "floater")),
               "size": 0 if isinstance(size, str) and _arguments.choice(size, "size", ("auto",)) else _arguments.size(size)}
    if component is not None:
        options["component"] = _component_number(component)
    if seed_triangle is not None:
        options["seed_triangle"] = _arguments.integer(seed_triangle, "seed_triangle", 0, max(0, len(F) - 1))
    if normal_map is not None:
        options["normal_map"] = _arguments.size(normal_map, "normal_map")
    if cut is not None:
        options["cut"] = _cut_paths(cut)
    made = _weft.convert(V, F, _arguments.texture(uv, len(F)), _arguments.text(str(name), "name"), options, _arguments.progress(progress))
    return GeometryImage(*made)


def load(path):
    """Loads a geometry image, .exr, .png or .weft. Raises FileNotFoundError, InputError."""
    return GeometryImage(_weft.read_image(_arguments.existing(path)))


def builtin(name, size=257, *, threads=None, progress=None):
    """A built-in shape as a geometry image; `shapes` lists them. "builtin:NAME" is the same as "NAME"."""
    name = str(name).removeprefix("builtin:")
    known = shapes()
    if name not in known:
        raise ValueError(f"builtin: one of {', '.join(known)} is wanted, not {name!r}")
    return GeometryImage(_weft.builtin(name, _arguments.size(size), _arguments.threads(threads), _arguments.progress(progress)))


def shapes():
    """The built-in shapes: {name: what it is}."""
    return dict(_weft.shapes())
