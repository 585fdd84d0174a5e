"""Sewing patterns, and garments as images of charts."""
import os
from typing import NamedTuple

import numpy as np

from . import _arguments, _weft
from .errors import InputError
from .images import GeometryImage


def _kept(array):
    array.flags.writeable = False
    return array


class Edge(NamedTuple):
    """An edge of a panel, from one of its vertices to another.

    kind: "straight"; "bezier", with one or two ``controls`` (k, 2) [m]; or "arc", of a ``radius`` [m], the longer one where it is
    ``large``, walked ``counterclockwise`` or not. label: the part of the body that it is held at; may be empty.
    """

    ends: tuple
    label: str
    kind: str
    controls: np.ndarray
    radius: float
    large: bool
    counterclockwise: bool


class Panel(NamedTuple):
    """A flat piece of fabric: ``vertices`` (k, 2) float64 [m], y along the grain, and `Edge`s that are one loop.

    It is placed by ``rotate`` (degrees about x, then y, then z of its own axes), then ``translate`` [m].
    """

    name: str
    label: str
    vertices: np.ndarray
    edges: list
    rotate: tuple
    translate: tuple


class Stitch(NamedTuple):
    """Two edges that are sewn together, each by the numbers of its panel and its edge: the start of one to the end of the other.

    turned: the start of one to the start of the other.
    """

    panel: int
    edge: int
    other_panel: int
    other_edge: int
    turned: bool


class Pattern:
    """A sewing pattern that `read_pattern` has read; never changed, as it keeps what was in the file.

    Fields: ``path``, ``panels`` (list of `Panel`), ``stitches`` (list of `Stitch`), ``notes`` (what was left out of the file).
    A simulation reads the file again, and raises InputError where it has changed since or is gone.
    """

    def __init__(self, path):
        path = os.path.abspath(path)
        self._take(path, _weft.read_file(path))

    def _take(self, path, told):
        self.path, self._told = path, told
        panels, stitches, self.notes = _weft.parse_pattern(told, path)
        self.panels = [Panel(**{**panel, "vertices": _kept(panel["vertices"]), "edges": [_edge(edge) for edge in panel["edges"]]})
                       for panel in panels]
        self.stitches = [Stitch(*stitch) for stitch in stitches]

    def garment(self, spacing=_weft.default_spacing, progress=None):
        """Its panels as charts of an image, and which of their samples are sewn together: a `Garment`.

        spacing: of the samples along edges [m]. progress: see `geometry_image`.
        Raises InputError for panels that cannot be joined, or are too large.
        """
        spacing = _arguments.number(spacing, "spacing", above=0)
        image, *arrays = _weft.sew_pattern(self._told, self.path, spacing, _arguments.progress(progress))
        return Garment(GeometryImage(image), *arrays)

    def _check_unchanged(self):
        """Raises InputError where its file, which simulations read again, is not what it was."""
        if _weft.read_file(self.path) != self._told:
            found, wanted = "has changed since this pattern was read", "read_pattern again is wanted"
            raise InputError(f"{self.path}: {found}; {wanted}", where=self.path, found=found, wanted=wanted)

    def __reduce__(self):
        return _pattern_again, (self.path, self._told)

    def __repr__(self):
        return f"<weft.Pattern {os.path.basename(self.path)!r}, {len(self.panels)} panels, {len(self.stitches)} stitches>"


def _pattern_again(path, told):
    """A pattern from what was read: as it travels between processes."""
    pattern = Pattern.__new__(Pattern)
    pattern._take(path, told)
    return pattern


def _edge(told):
    return Edge(**{**told, "controls": _kept(told["controls"])})


class Garment:
    """A pattern as an image of charts, one for each panel, under its name. Arrays are read-only.

    Fields: ``image`` (a `GeometryImage`: panels as the pattern places them, apart), ``places`` ((n, n, 2) float32, where each sample
    lies in its panel [m]), ``classes`` ((n, n) int32, the sample that stands for each once seams are closed; -1 where no chart is), ``seams``
    (of each name the pairs of samples that become one, (k, 2) int32).
    """

    def __init__(self, image, places, classes, seams):
        self.image = image
        self.places, self.classes = _kept(places), _kept(classes)
        self.seams = {name: _kept(pairs) for name, pairs in seams}
        self._mesh = None

    def _sewn(self):
        """Samples of vertices, faces as vertices, and the samples of the faces' corners; panel by panel."""
        if self._mesh is None:
            corners = self.image.sample_of[self.image.to_mesh()[1]]
            charts = self.image.charts
            rows, cols = np.divmod(corners[:, 0], self.image.size)
            panel = np.zeros(len(corners), np.int32)
            for number, chart in enumerate(charts):
                inside = (rows >= chart.row) & (rows < chart.row + chart.rows) & (cols >= chart.col) & (cols < chart.col + chart.cols)
                panel[inside] = number
            points = self.classes.ravel()[corners]
            ordered = np.sort(points, axis=1)
            _, which, uses = np.unique(ordered, axis=0, return_inverse=True, return_counts=True)
            # Closing folds some to an edge, and at the tips of darts two onto each other.
            kept = (ordered[:, 0] != ordered[:, 1]) & (ordered[:, 1] != ordered[:, 2]) & (uses[which.ravel()] == 1)
            order = np.argsort(panel[kept], kind="stable")
            samples, faces = np.unique(points[kept][order], return_inverse=True)
            self._mesh = tuple(_kept(array) for array in (
                samples.astype(np.int32), faces.reshape(-1, 3).astype(np.int32), corners[kept][order].astype(np.int32), panel[kept][order]))
        return self._mesh

    @property
    def sample_of(self):
        """(V,) int32: the sample, row * n + col, of each vertex of the sewn mesh; the vertices of the program's files."""
        return self._sewn()[0]

    @property
    def faces(self):
        """(m, 3) int32: triangles of the sewn mesh, panel by panel, in the order of the program's files."""
        return self._sewn()[1]

    @property
    def panel_of(self):
        """(m,) int32: the panel of each face."""
        return self._sewn()[3]

    @property
    def corner_places(self):
        """(m, 3, 2) float32 [m]: where the corners of faces lie in their panels. Times 100 the texture of the program's files."""
        return _kept(self.places.reshape(-1, 2)[self._sewn()[2]])

    def __reduce__(self):
        return Garment, (self.image, self.places, self.classes, list(self.seams.items()))

    def __repr__(self):
        return f"<weft.Garment of {len(self.image.charts)} panels, {len(self.seams)} seams>"


def read_pattern(path):
    """Reads a sewing pattern as GarmentCode writes them (``*_specification.json``): a `Pattern`.

    Raises FileNotFoundError; InputError, which names panel and edge, for what cannot be sewn.
    """
    return Pattern(_arguments.existing(path))
