"""What cloths and bodies are made of."""
import os

from . import _arguments
from .garments import Pattern
from .images import GeometryImage


class Surface:
    """What a cloth or body is made of: a name for the scene, or what is in memory."""

    def __init__(self, given, faces, what):
        self.name, self.memory, self.vertices, self.pattern = "builtin:sheet", None, None, None
        if isinstance(given, Pattern):
            given._check_unchanged()
            self.pattern, given = given, given.path
        if isinstance(given, GeometryImage):
            self.memory = given._core
            if faces is not None:
                raise ValueError(f"{what}: an image has its own faces")
        elif faces is not None or isinstance(given, (tuple, list)):
            V, F, uv = self._mesh(given, what) if faces is None else (given, faces, None)
            V, F = _arguments.vertices(V), _arguments.faces(F)
            self.memory = (V, F, _arguments.texture(uv, len(F), f"{what}: uv"), what)
            self.vertices = len(V)
        else:
            self.name = _arguments.path(given, what)
            if not self.name.startswith("builtin:"):
                self.name = os.path.abspath(_arguments.existing(self.name, what))

    @staticmethod
    def _mesh(given, what):
        if len(given) not in (2, 3):
            raise ValueError(f"{what}: (V, F) or (V, F, uv) is wanted, not {len(given)} arrays")
        return (*given, None)[:3]


class Body:
    """What cloth collides with.

    surface: V (n, 3) [m, y up] with ``faces`` (m, 3); or a `GeometryImage`; or the name of a mesh, image or builtin:NAME.
    motion: (T, n, 3), where each vertex is at T times, ``fps`` a second; the body stands still after them. n is the
    number of vertices of the mesh; of an image its samples (row by row) or the vertices of its `to_mesh`.
    keys: instead of motion, list of {"time", "rotate", "translate"}, linear between them [s, degrees, m].
    size: samples a side of the image that a mesh is turned into.
    """

    def __init__(self, surface, faces=None, *, motion=None, fps=30, keys=None, size=257):
        self._surface = Surface(surface, faces, "body")
        self._size = _arguments.size(size)
        if motion is not None and keys is not None:
            raise ValueError("body: motion or keys are wanted, not both")
        self._keys, self._motion = None if keys is None else _arguments.entries(keys, "keys"), None
        if motion is not None:
            positions = _arguments.sequence(motion, "motion")
            wanted = self._surface.vertices
            if wanted is not None and positions.shape[1] != wanted:
                raise ValueError(f"motion: {wanted} points a frame are wanted, as many as vertices, not {positions.shape[1]}")
            self._motion = (positions, _arguments.number(fps, "fps", above=0))
