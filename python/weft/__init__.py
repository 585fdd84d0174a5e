"""Weft: meshes as geometry images, geometry images as cloth.

Conventions: V (n, 3) float64 and F (m, 3) int32, from 0; any type of number and order in memory is taken; metres, seconds,
y up, right-handed. Long calls let other threads of Python run, take ``threads=`` (results do not depend on it) and
``progress=``, and stop on Ctrl-C. Errors are ``weft.Error``s; wrong shapes and ranges ValueErrors.
"""
from . import _weft
from .bodies import Body
from .caches import read_pc2, write_pc2
from .errors import Error, InputError, OutputError, SceneError, TopologyError, Unstable, UsageError
from .garments import Edge, Garment, Panel, Pattern, Stitch, read_pattern
from .images import Chart, GeometryImage, builtin, geometry_image, load, read_mesh, shapes, write_mesh
from .simulation import Cloth, Frame, Intersections, Simulation, Strain

__version__ = _weft.version
__all__ = [
    "Body", "Chart", "Cloth", "Edge", "Error", "Frame", "Garment", "GeometryImage", "InputError", "Intersections", "OutputError",
    "Panel", "Pattern", "SceneError", "Simulation", "Stitch", "Strain", "TopologyError", "Unstable", "UsageError", "builtin",
    "geometry_image", "load", "read_mesh", "read_pattern", "read_pc2", "shapes", "write_mesh", "write_pc2",
]
