import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = str | os.PathLike[str]
_Progress = Callable[[str, float], object] | Any | None  # a callable, or a bar like tqdm's
_Mesh = tuple[ArrayLike, ArrayLike] | tuple[ArrayLike, ArrayLike, ArrayLike]
_Vector = Sequence[float] | NDArray[Any]
_Json = Mapping[str, Any]

__version__: str

class Error(Exception):
    where: str
    found: str
    wanted: str
    def __init__(self, message: str, where: str = "", found: str = "", wanted: str = "") -> None: ...

class UsageError(Error, ValueError): ...
class InputError(Error): ...
class OutputError(Error): ...
class TopologyError(Error): ...
class SceneError(Error): ...

class Unstable(SceneError):
    frame: int
    cloth: str
    sample: tuple[int, int] | None
    def __init__(self, message: str, frame: int = 0, cloth: str = "", sample: tuple[int, int] | None = None,
                 **fields: str) -> None: ...

class Chart:
    name: str
    row: int
    col: int
    rows: int
    cols: int
    def of(self, grid: NDArray[Any]) -> NDArray[Any]: ...
    @property
    def positions(self) -> NDArray[np.float64]: ...

class GeometryImage:
    report: dict[str, Any]
    normals: NDArray[np.float32] | None
    @property
    def size(self) -> int: ...
    @property
    def source(self) -> str: ...
    @property
    def charts(self) -> list[Chart]: ...
    @property
    def positions(self) -> NDArray[np.float64]: ...
    @property
    def classes(self) -> NDArray[np.int32]: ...
    @property
    def occupancy(self) -> NDArray[np.bool_]: ...
    @property
    def quality(self) -> dict[str, Any] | None: ...
    @property
    def coarsest_level(self) -> int: ...
    @property
    def vertex_of(self) -> NDArray[np.int32]: ...
    @property
    def sample_of(self) -> NDArray[np.int32]: ...
    def to_mesh(self, level: int = 0) -> tuple[NDArray[np.float64], NDArray[np.int32]]: ...
    def save(self, path: _Path, format: Literal["omages", "garmage"] | None = None, **options: Any) -> None: ...

class Edge(NamedTuple):
    ends: tuple[int, int]
    label: str
    kind: Literal["straight", "bezier", "arc"]
    controls: NDArray[np.float64]
    radius: float | None
    large: bool
    counterclockwise: bool

class Panel(NamedTuple):
    name: str
    label: str
    vertices: NDArray[np.float64]
    edges: list[Edge]
    rotate: tuple[float, float, float]
    translate: tuple[float, float, float]

class Stitch(NamedTuple):
    panel: int
    edge: int
    other_panel: int
    other_edge: int
    turned: bool

class Pattern:
    path: str
    panels: list[Panel]
    stitches: list[Stitch]
    notes: list[str]
    def __init__(self, path: str) -> None: ...
    def garment(self, spacing: float = 0.008, progress: _Progress = None) -> Garment: ...

class Garment:
    image: GeometryImage
    places: NDArray[np.float32]
    classes: NDArray[np.int32]
    seams: dict[str, NDArray[np.int32]]
    @property
    def sample_of(self) -> NDArray[np.int32]: ...
    @property
    def faces(self) -> NDArray[np.int32]: ...
    @property
    def panel_of(self) -> NDArray[np.int32]: ...
    @property
    def corner_places(self) -> NDArray[np.float32]: ...

def read_pattern(path: _Path) -> Pattern: ...
def read_mesh(path: _Path, uv: bool = False) -> tuple[Any, ...]: ...
def write_mesh(path: _Path, V: ArrayLike, F: ArrayLike) -> None: ...
def geometry_image(V: ArrayLike, F: ArrayLike, size: int | Literal["auto"] = 257,
                   charts: Literal["auto", "pieces", "uv", "one"] | int = "auto", *, uv: ArrayLike | None = None,
                   parameterizer: Literal["stretch", "floater"] = "stretch",
                   component: int | Literal["largest"] | None = None, cut: Sequence[Sequence[int]] | None = None,
                   seed_triangle: int | None = None, normal_map: int | None = None, fit: bool = False, measure: bool = True,
                   seed: int = 1, name: str = "mesh", threads: int | None = None,
                   progress: _Progress = None) -> GeometryImage: ...
def load(path: _Path) -> GeometryImage: ...
def builtin(name: str, size: int = 257, *, threads: int | None = None, progress: _Progress = None) -> GeometryImage: ...
def shapes() -> dict[str, str]: ...

class Strain(NamedTuple):
    mean: float
    p99: float
    max: float

class Intersections(NamedTuple):
    self: int
    cloths: int
    bodies: int
    ground: int

class Body:
    def __init__(self, surface: ArrayLike | _Mesh | GeometryImage | _Path, faces: ArrayLike | None = None, *,
                 motion: ArrayLike | None = None, fps: float = 30, keys: Sequence[_Json] | None = None,
                 size: int = 257) -> None: ...

class Cloth:
    name: str
    index: int
    @property
    def image(self) -> GeometryImage: ...
    @property
    def faces(self) -> NDArray[np.int32]: ...

class Frame:
    number: int
    time: float
    strain: Strain
    milliseconds: float
    iterations: int
    residual: float
    kinetic_energy: float
    potential_energy: float
    work: float
    contacts: int
    self_contacts: int
    stopped: int
    fell_back: int
    lost_time: float
    smallest_gap: float
    centre_of_mass: NDArray[np.float64]
    def positions(self, cloth: Cloth, on: Literal["mesh", "samples", "input"] = "mesh") -> NDArray[np.float32]: ...
    @property
    def intersection_counts(self) -> Intersections: ...
    @property
    def intersections(self) -> int: ...

class Simulation:
    def __init__(self, *, frame_rate: float = 60, substeps: int = 4, gravity: _Vector = (0, -9.81, 0),
                 ground: float | None = 0.0, wind: _Vector | _Json | None = None, air_damping: float = 0.0,
                 integrator: str | _Json = "newton", collider: str | _Json = "pyramid", threads: int | None = None,
                 name: str = "scene") -> None: ...
    @classmethod
    def from_scene(cls, path: _Path, *, threads: int | None = None) -> Simulation: ...
    def add_body(self, body: Body | _Mesh | GeometryImage | _Path, *, friction: float = 0.4, name: str | None = None,
                 scale: float | _Vector = 1.0, rotate: _Vector = (0, 0, 0), translate: _Vector = (0, 0, 0),
                 wait: float = 0.0, lead_in: float = 0.0) -> None: ...
    def add_cloth(self, surface: _Mesh | GeometryImage | Pattern | _Path, *, fabric: str | _Json = "cotton", name: str | None = None,
                  size: int = 129, scale: float | _Vector = 1.0, rotate: _Vector = (0, 0, 0), translate: _Vector = (0, 0, 0),
                  friction: float = 0.4, velocity: _Vector = (0, 0, 0), pins: Sequence[_Json] = (),
                  attach: Sequence[_Json] = (), self_collision: bool | None = None, spacing: float | None = None,
                  rest: Literal["mesh", "uv"] = "mesh", uv_scale: float | None = None, layer: int | None = None) -> Cloth: ...
    @property
    def frame_rate(self) -> float: ...
    @property
    def cloths(self) -> list[Cloth]: ...
    def start(self, progress: _Progress = None) -> Simulation: ...
    def run(self, frames: int, *, record: bool = True, progress: _Progress = None) -> Iterator[Frame]: ...
    @property
    def frame(self) -> int: ...
    @property
    def particles(self) -> int: ...
    @property
    def notes(self) -> list[str]: ...
    def cache(self, cloth: Cloth, on: Literal["mesh", "samples", "input"] = "mesh") -> NDArray[np.float32]: ...
    def body_positions(self, index: int) -> NDArray[np.float32]: ...
    def strain_at_samples(self, cloth: Cloth) -> NDArray[np.float32]: ...
    def velocity_at_samples(self, cloth: Cloth) -> NDArray[np.float32]: ...
    @property
    def state_hash(self) -> str: ...
    def save(self) -> Any: ...
    def restore(self, state: Any) -> None: ...

def write_pc2(path: _Path, positions: ArrayLike) -> None: ...
def read_pc2(path: _Path, frame_rate: float = 60, clip: str = "") -> tuple[NDArray[np.float32], NDArray[np.float64]]: ...
