"""Cloth over bodies, frame by frame."""
import json
import os
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from . import _arguments, _weft
from .bodies import Body, Surface
from .errors import SceneError
from .images import GeometryImage

_IDENTITY = {"scale": 1.0, "rotate": [0, 0, 0], "translate": [0, 0, 0]}


class Strain(NamedTuple):
    """|l / r - 1| over the stretch springs of all cloths."""

    mean: float
    p99: float
    max: float


class Intersections(NamedTuple):
    """Pairs of triangles that cross: within a cloth, of two cloths, with bodies; triangles below the ground."""

    self: int
    cloths: int
    bodies: int
    ground: int


def _placement(scale, rotate, translate):
    scaled = _arguments.number(scale, "scale") if np.ndim(scale) == 0 else _arguments.vector(scale, "scale")
    return {"scale": scaled, "rotate": _arguments.vector(rotate, "rotate"),
            "translate": _arguments.vector(translate, "translate")}


class Cloth:
    """A cloth of a simulation, which `Simulation.add_cloth` gives.

    Fields: ``name``, ``index``. `faces` and the like begin the simulation where it has not begun.
    """

    def __init__(self, simulation, index, name):
        self._simulation, self.index, self.name = simulation, index, name

    @property
    def image(self):
        """Its `GeometryImage` at rest, unplaced."""
        return self._simulation._image(self.index)

    @property
    def faces(self):
        """(m, 3) int32: triangles of what `Frame.positions` gives."""
        return self.image.to_mesh()[1]

    def __repr__(self):
        return f"<weft.Cloth {self.name!r}>"


class Frame:
    """What is known of a frame; it stays as it was when the simulation goes on, but for the intersections.

    Fields: ``number`` (from 1), ``time`` [s], ``strain`` (a `Strain`), ``milliseconds``, ``iterations``, ``residual``,
    ``kinetic_energy``, ``potential_energy``, ``work`` (of pins, bodies, wind and air) [J], ``contacts``, ``self_contacts``,
    ``stopped``, ``fell_back``, ``buried``, ``lost_time`` [s], ``smallest_gap`` [m], ``centre_of_mass`` [m].
    """

    def __init__(self, simulation, number, told, samples):
        self.number, self.time = number, number / simulation.frame_rate
        self.__dict__.update(told)
        self.strain = Strain(*told["strain"])
        self.centre_of_mass = np.array(told["centre_of_mass"])
        self._simulation, self._samples, self._counts = simulation, samples, None

    def positions(self, cloth, on="mesh"):
        """Where a cloth is [m].

        on: "mesh": (n, 3) float32, the vertices of ``cloth.image.to_mesh()``; "samples": (N, N, 3), all samples of its image;
        "input": (V, 3), the vertices of the mesh that it was made from, in their order (ValueError for a cloth that was given as an
        image).
        """
        index = self._simulation._index(cloth)
        return self._simulation._on(on, index, self._samples[index])

    @property
    def intersection_counts(self):
        """`Intersections` of this frame, counted when they are first asked for.

        Raises RuntimeError where the simulation has gone on before.
        """
        if self._counts is None:
            if self._simulation.frame != self.number:
                raise RuntimeError(f"intersections of frame {self.number} are wanted while the simulation stands at "
                                   f"{self._simulation.frame}: ask for them before it goes on")
            self._counts = Intersections(*self._simulation._core.intersections())
        return self._counts

    @property
    def intersections(self):
        """Their number in all."""
        return sum(self.intersection_counts)

    def __repr__(self):
        return f"<weft.Frame {self.number}>"


class Simulation:
    """A scene and its simulation: the same bits as `weft simulate` makes of it, for any number of threads.

    frame_rate [1/s]; substeps a frame; gravity [m/s^2]; ground: its height [m] or None; wind: its velocity [m/s] or
    {"velocity", "drag", "lift"}; air_damping: rate at which cloth loses its velocity [1/s]; integrator, collider: a name, or
    a dictionary with ``type`` and its options, as in scene files.
    Bodies and cloths are added before the first frame.
    """

    def __init__(self, *, frame_rate=60, substeps=4, gravity=(0, -9.81, 0), ground=0.0, wind=None, air_damping=0.0,
                 integrator="newton", collider="pyramid", threads=None, name="scene"):
        self._threads = _arguments.threads(threads)
        self._name, self._folder = _arguments.text(str(name), "name"), ""
        self._frame_rate = _arguments.number(frame_rate, "frame_rate", above=0)
        self._scene = {"version": 1, "frame_rate": self.frame_rate,
                       "substeps": _arguments.integer(substeps, "substeps", 1, 10**4),
                       "gravity": _arguments.vector(gravity, "gravity"),
                       "ground": None if ground is None else _arguments.number(ground, "ground"),
                       "air_damping": _arguments.number(air_damping, "air_damping", least=0),
                       "integrator": _method(integrator, "integrator"), "collider": _method(collider, "collider"),
                       "cloths": [], "bodies": []}
        if wind is not None:
            held = isinstance(wind, Mapping)
            self._scene["wind"] = _arguments.plain(wind, "wind") if held else {"velocity": _arguments.vector(wind, "wind")}
        self._cloth_memory, self._body_memory, self._motions, self._patterns = [], [], [], []
        self._names, self._images = [], {}  # of cloths, which know their simulation: it does not know them
        self._core, self._record = None, {}

    @classmethod
    def from_scene(cls, path, *, threads=None):
        """The simulation of a scene file. Raises FileNotFoundError, SceneError with FILE:KEY."""
        name = _arguments.existing(path)
        simulation = cls(threads=threads, name=name)
        try:
            with open(name, encoding="utf-8-sig") as file:
                simulation._scene = file.read()
        except UnicodeDecodeError as error:
            raise _no_json(name, error) from error
        simulation._folder = os.path.dirname(os.path.abspath(name))
        simulation.start()
        simulation._frame_rate = _frame_rate(simulation._scene, name)
        return simulation

    @property
    def frame_rate(self):
        """Frames a second."""
        return self._frame_rate

    def add_body(self, body, *, friction=0.4, name=None, scale=1.0, rotate=(0, 0, 0), translate=(0, 0, 0), wait=0.0, lead_in=0.0):
        """Adds a `Body`, or what one is made of.

        rotate: degrees about x, then y, then z. wait: seconds that a body that moves stays where it is first, so that
        garments are sewn on it. lead_in: seconds in which it is then eased into its motion, which begins after them.
        """
        self._check_open()
        if not isinstance(body, Body):
            body = Body(body)
        pauses = {"wait": _arguments.number(wait, "wait", least=0), "lead_in": _arguments.number(lead_in, "lead_in", least=0)}
        if body._motion is None and body._keys is None and any(pauses.values()):
            raise ValueError("wait and lead_in are of bodies that move: this one has no motion")
        index = len(self._scene["bodies"])
        told = {"name": _arguments.name(name) or (f"body{index}" if index else "body"), "surface": body._surface.name,
                "size": body._size, "friction": _arguments.number(friction, "friction"), **_placement(scale, rotate, translate)}
        if body._keys is not None:
            told["motion"] = body._keys
        self._scene["bodies"].append(told)
        self._body_memory.append(body._surface.memory)
        self._patterns.append(body._surface.pattern)
        self._motions.append(None if body._motion is None else (*body._motion, *pauses.values()))
        if body._keys is not None:
            told.update(pauses)

    def add_cloth(self, surface, *, fabric="cotton", name=None, size=129, scale=1.0, rotate=(0, 0, 0), translate=(0, 0, 0),
                  friction=0.4, velocity=(0, 0, 0), pins=(), attach=(), self_collision=None, spacing=None, rest="mesh", uv_scale=None,
                  layer=None):
        """Adds a cloth.

        surface: a `GeometryImage`; or a mesh (V, F) or (V, F, uv) [m, y up], uv (m, 3, 2) of the faces' corners, which its
        grain follows; or a `Pattern`; or the name of a mesh, an image, a pattern or builtin:NAME. Arrays are copied.
        fabric: a name, or a dictionary of its values, as ``material`` in scene files.
        size: samples a side of the image that a mesh or a name is turned into.
        spacing: of the samples along edges of a pattern [m].
        rest: "mesh", or "uv": the texture coordinates of a mesh as its flat rest shape, ``uv_scale`` metres a unit (None: by area).
        layer: of garments over each other, as in scene files.
        pins, attach: lists as in scene files, for example ``pins=[{"image": [0, 0]}]``. velocity: at the start [m/s].
        Returns a `Cloth`.
        """
        self._check_open()
        made_of = Surface(surface, None, "cloth")
        index = len(self._scene["cloths"])
        name = _arguments.name(name) or (f"cloth{index}" if index else "cloth")
        told = {"name": name, "surface": made_of.name, "size": _arguments.size(size),
                "material": _arguments.plain(fabric, f"cloth {name!r}: fabric"),
                "friction": _arguments.number(friction, "friction"), "velocity": _arguments.vector(velocity, "velocity"),
                "pins": _arguments.entries(pins, f"cloth {name!r}: pins"),
                "attach": _arguments.entries(attach, f"cloth {name!r}: attach"), **_placement(scale, rotate, translate)}
        if spacing is not None:
            told["sew"] = {"spacing": _arguments.number(spacing, "spacing", above=0)}
        if _arguments.choice(rest, "rest", ("mesh", "uv")) == "uv":
            told["rest"] = "uv"
        if uv_scale is not None:
            told["uv_scale"] = _arguments.number(uv_scale, "uv_scale", above=0)
        if self_collision is not None:
            told["self_collision"] = _arguments.flag(self_collision, "self_collision")
        if layer is not None:
            told["layer"] = _arguments.integer(layer, "layer", 0, 20)
        self._scene["cloths"].append(told)
        self._cloth_memory.append(made_of.memory)
        self._patterns.append(made_of.pattern)
        self._names.append(name)
        return Cloth(self, index, name)

    @property
    def cloths(self):
        """List of `Cloth`."""
        return [Cloth(self, index, name) for index, name in enumerate(self._names)]

    def _image(self, index):
        if index not in self._images:
            self._images[index] = GeometryImage(self.start()._core.cloth_image(index))
        return self._images[index]

    def _check_open(self):
        if self._core is not None:
            raise RuntimeError("the simulation has begun: cloths and bodies are to be added before")

    def _index(self, cloth):
        if not isinstance(cloth, Cloth) or cloth._simulation is not self:
            raise ValueError(f"cloth: one of this simulation is wanted, not {cloth!r:.60}")
        return cloth.index

    def start(self, progress=None):
        """Loads everything, which the first frame does otherwise. Raises SceneError, InputError, TopologyError."""
        if self._core is not None:
            return self
        for pattern in filter(None, self._patterns):
            pattern._check_unchanged()
        text = self._scene if isinstance(self._scene, str) else json.dumps(self._scene)
        given = {"json": text, "name": self._name, "folder": self._folder, "cloths": self._cloth_memory,
                 "bodies": self._body_memory, "motions": self._motions}
        core = _weft.simulate(given, self._threads, _arguments.progress(progress))
        self._names = core.names(True)
        self._core = core
        self._keep()
        return self

    def _samples(self):
        return [self._core.cloth_samples(index) for index in range(len(self._names))]

    def _on(self, on, index, samples):
        _arguments.choice(on, "on", ("mesh", "samples", "input"))
        if on == "input":
            return self._core.carry(index, samples)
        return samples if on == "samples" else samples.reshape(-1, 3)[self._image(index).sample_of]

    def _keep(self):
        samples = self._samples()
        for array in samples:
            array.flags.writeable = False
        self._record[self.frame] = samples
        return samples

    def _catch_up(self):
        """Keeps a frame that Ctrl-C came after, before it was kept."""
        if self.frame not in self._record and self.frame - 1 in self._record:
            self._keep()

    def run(self, frames, *, record=True, progress=None):
        """Simulates so many frames more: a generator of each `Frame` as it is done.

        record: whether positions are kept for `cache`.
        progress: called with ("simulate", fraction) after every frame, or a bar like tqdm's.
        Raises Unstable, after which the simulation stands at the frame before. After Ctrl-C it stands there, or, where the frame was
        done at that moment, after it: `frame` tells, and `cache` has it.
        """
        frames = _arguments.integer(frames, "frames", 0, 2**31 - 1)
        tell = _arguments.progress(progress)
        return self._frames(frames, _arguments.flag(record, "record"), tell)

    def _frames(self, frames, record, tell):
        self.start()._catch_up()
        for done in range(1, frames + 1):
            told = self._core.advance(None)
            samples = self._keep()
            if not record:
                self._record.clear()
            if tell is not None:
                tell("simulate", done / frames)
            yield Frame(self, self.frame, told, samples)

    @property
    def frame(self):
        """Frames done."""
        return self._core.frame if self._core is not None else 0

    @property
    def particles(self):
        """Particles of all cloths."""
        return self.start()._core.particles

    @property
    def notes(self):
        """What was repaired while loading, and what is odd at the start (cloth inside of bodies, or below the ground, or
        tangled): list of sentences, as the program tells them."""
        return self.start()._core.notes

    def cache(self, cloth, on="mesh"):
        """(T, n, 3) float32 [m]: what `Frame.positions` gives of a cloth in all frames up to now, the start first.

        Raises RuntimeError where frames were not recorded.
        """
        index = self._index(cloth)
        self.start()._catch_up()
        frames = range(self.frame + 1)
        if any(frame not in self._record for frame in frames):
            raise RuntimeError("frames before this one were not recorded, or forgotten by `restore`: run(n, record=True) is wanted from "
                               "the start on")
        return np.stack([self._on(on, index, self._record[frame][index]) for frame in frames])

    def body_positions(self, index):
        """(N, N, 3) float32 [m]: where the samples of a body, numbered as it was added, are now."""
        bodies = self.start()._core.names(False)
        if not bodies:
            raise ValueError("body: this simulation has none")
        return self._core.body_samples(_arguments.integer(index, "body", 0, len(bodies) - 1))

    def strain_at_samples(self, cloth):
        """(N, N) float32: the mean of l / r - 1 over the springs around each sample, now."""
        return self.start()._core.strains(self._index(cloth))

    def velocity_at_samples(self, cloth):
        """(N, N, 3) float32 [m/s]: how fast each sample moves now."""
        return self.start()._core.velocities(self._index(cloth))

    @property
    def state_hash(self):
        """Hash of all positions and velocities, as `weft simulate` tells it."""
        return self.start()._core.state_hash()

    def save(self):
        """The state, for `restore`; it may be restored any number of times, and pickled for files and other processes.

        A pickled state is for this version of Weft.
        """
        return self.start()._core.save()

    def restore(self, state):
        """Goes back, or on, to a saved state of this simulation, or of one that was made alike; what follows has the same bits.

        `cache` keeps the frames before it. Raises ValueError for a state of another simulation.
        """
        if not isinstance(state, _weft.State):
            raise TypeError(f"state: what save() gave is wanted, not {state!r:.60}")
        self.start()._core.restore(state)
        self._record = {frame: kept for frame, kept in self._record.items() if frame < state.frame}
        self._keep()

    def __repr__(self):
        return f"<weft.Simulation of {len(self._names)} cloths at frame {self.frame}>"


def _method(given, what):
    return _arguments.plain(given if isinstance(given, Mapping) else {"type": given}, what)


def _frame_rate(text, name):
    """Of a scene that the library has read: it takes what ends in null bytes, say."""
    try:
        return float(json.loads(text).get("frame_rate", 60))
    except ValueError as error:
        raise _no_json(name, error) from error


def _no_json(name, error):
    return SceneError(f"{name}: is not JSON here: {error}", where=name, found="is not JSON here")
