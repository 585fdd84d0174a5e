"""A hundred wrong calls: each raises the right exception with a text that names what is wrong, and nothing ends the process."""
import gc
import os
import pickle
import unittest
from functools import partial

import numpy as np

import weft
import weft.omages
from module import ModuleTest, sphere_on_floor

V, F = weft.read_mesh("builtin:tshirt")
convert = partial(weft.geometry_image, size=17, measure=False, threads=1)


def changed(array, place, value, dtype=None):
    other = array.astype(dtype or array.dtype)
    other[place] = value
    return other


def positions_of(image, row, value):
    image.positions[row] = value


def raising(stage, fraction):
    raise LookupError(f"told of {stage}")


class Silent:
    n = 0
    def update(self, _):
        raise OSError("a bar that fails")


def once(frames=2, **wrong):
    """A frame or two of a scene whose cloth has these arguments."""
    simulation = weft.Simulation(threads=1)
    simulation.add_cloth("builtin:sheet", size=9, **wrong)
    return list(simulation.run(frames))


def scene(**wrong):
    simulation = weft.Simulation(threads=1, **wrong)
    simulation.add_cloth("builtin:sheet", size=9)
    return list(simulation.run(2))


def body(*given, friction=0.4, wait=0.0, lead_in=0.0, **wrong):
    simulation = weft.Simulation(threads=1)
    simulation.add_body(weft.Body(*given, **wrong), friction=friction, wait=wait, lead_in=lead_in)
    simulation.add_cloth("builtin:sheet", size=9)
    return simulation.start()


def explode():
    simulation = weft.Simulation(integrator="explicit", substeps=1, threads=1)
    simulation.add_cloth("builtin:sheet", size=17, name="stiff", pins=[{"image": [0, 0]}])
    return list(simulation.run(60))


def stale():
    simulation, _ = sphere_on_floor()
    first, _ = simulation.run(2)
    return first.intersections


def foreign_cloth():
    (first, _), (_, other) = sphere_on_floor(), sphere_on_floor()
    return next(first.run(1)).positions(other)


def positions_on(on):
    simulation, cloth = sphere_on_floor()
    return next(simulation.run(1)).positions(cloth, on=on)


def late(add):
    simulation, _ = sphere_on_floor()
    simulation.start()
    add(simulation)


def foreign_state():
    (first, _), second = sphere_on_floor(), weft.Simulation(threads=1)
    second.add_cloth("builtin:sheet", size=9)
    first.restore(second.save())


def not_recorded():
    simulation, cloth = sphere_on_floor()
    list(simulation.run(2, record=False))
    return simulation.cache(cloth)


def image():
    return weft.builtin("sheet", size=9)


ENDLESS = []
ENDLESS.append(ENDLESS)
Bad, Shape, Type, Missing = weft.InputError, ValueError, TypeError, FileNotFoundError
CASES = [
    # meshes as arrays
    (Shape, "(n, 3)", lambda: convert(V[:, :2], F)),
    (Shape, "(n, 3)", lambda: convert(V.T, F)),
    (Shape, "(n, 3)", lambda: convert(V.ravel(), F)),
    (Shape, "(n, 3)", lambda: convert(V[None], F)),
    (Shape, "(n, 3)", lambda: convert(np.float64(3), F)),
    (Shape, "(n, 3)", lambda: convert([], F)),
    (Shape, "F: ", lambda: convert(V, F[:, :2])),
    (Shape, "F: ", lambda: convert(V, np.hstack([F, F]))),
    (Shape, "F: ", lambda: convert(V, F.ravel())),
    (Shape, "F: ", lambda: convert(V, [])),
    (Type, "V: ", lambda: convert(V.astype(complex), F)),
    (Type, "V: ", lambda: convert(V.astype(object), F)),
    (Type, "V: ", lambda: convert(V.astype(str), F)),
    (Type, "V: ", lambda: convert(None, F)),
    (Type, "V: ", lambda: convert(V > 0, F)),
    (Type, "V: ", lambda: convert({"V": V}, F)),
    (Type, "F: ", lambda: convert(V, F.astype(str))),
    (Type, "F: ", lambda: convert(V, F.astype(complex))),
    (Type, "F: ", lambda: convert(V, F > 3)),
    (Shape, "F: whole", lambda: convert(V, F + 0.5)),
    (Shape, "F: whole", lambda: convert(V, changed(F, (2, 1), np.nan, float))),
    (Shape, "32 bits", lambda: convert(V, changed(F, (2, 1), 2**40, np.int64))),
    (Shape, "32 bits", lambda: convert(V, changed(F, (2, 1), 2**63, np.uint64))),
    (Shape, "32 bits", lambda: convert(V, changed(F, (2, 1), np.inf, float))),
    (Shape, "V: ", lambda: convert([[0, 0, 0], [1, 0]], F)),
    (Bad, "triangle 2 uses vertex", lambda: convert(V, changed(F, (2, 1), len(V)))),
    (Bad, "triangle 2 uses vertex -1", lambda: convert(V, changed(F, (2, 1), -1))),
    (Bad, "2147483647", lambda: convert(V, changed(F, (0, 0), 2**31 - 1))),
    (Bad, "vertex", lambda: convert(changed(V, (5, 1), np.nan), F)),
    (Bad, "vertex", lambda: convert(changed(V, (5, 1), np.inf), F)),
    (Bad, "vertex", lambda: convert(changed(V, (5, 1), -1e300), F)),
    (Bad, "", lambda: convert(np.zeros((0, 3)), np.zeros((0, 3), int))),
    (Bad, "", lambda: convert(V, np.zeros((0, 3), int))),
    (Bad, "", lambda: convert(np.zeros((0, 3)), F)),
    (Bad, "repeated vertex", lambda: convert(V, F * 0)),
    (Bad, "area", lambda: convert(V * 0, F)),
    # options of conversions
    (Shape, "size", lambda: convert(V, F, size=4)),
    (Shape, "size", lambda: convert(V, F, size=-17)),
    (Shape, "8193", lambda: convert(V, F, size=10**9)),
    (Shape, "8193", lambda: convert(V, F, size=10**30)),
    (Type, "size", lambda: convert(V, F, size=17.5)),
    (Shape, "'auto'", lambda: convert(V, F, size="large")),
    (Type, "size", lambda: convert(V, F, size=None)),
    (Shape, "charts", lambda: convert(V, F, charts="some")),
    (Shape, "charts", lambda: convert(V, F, charts=0)),
    (Shape, "charts", lambda: convert(V, F, charts=10**6)),
    (Type, "charts", lambda: convert(V, F, charts=2.5)),
    (weft.Error, "", lambda: convert(V, F, charts="uv")),
    (Shape, "uv", lambda: convert(V, F, charts="uv", uv=np.zeros((len(F), 3)))),
    (Shape, "uv", lambda: convert(V, F, charts="uv", uv=np.zeros((3, 3, 2)))),
    (Shape, "parameterizer", lambda: convert(V, F, parameterizer="conformal")),
    (weft.Error, "component", lambda: convert(V, F, component=7)),
    (Shape, "component", lambda: convert(V, F, component=-1)),
    (Type, "component", lambda: convert(V, F, component="smallest")),
    (Shape, "seed_triangle", lambda: convert(V, F, seed_triangle=len(F))),
    (weft.Error, "vertex", lambda: convert(V, F, cut=[[0, 10**7]])),
    (Shape, "cut", lambda: convert(V, F, cut=[[0, -2]])),
    (Shape, "threads", lambda: convert(V, F, threads=0)),
    (Shape, "threads", lambda: convert(V, F, threads=10**6)),
    (Shape, "normal_map", lambda: convert(V, F, normal_map=1)),
    (Type, "progress", lambda: convert(V, F, progress=3)),
    (LookupError, "told of", lambda: convert(V, F, size=65, progress=raising)),
    (OSError, "a bar that fails", lambda: convert(V, F, size=65, progress=Silent())),
    (Type, "sizes", lambda: convert(V, F, sizes=17)),
    # files
    (Missing, "none.obj", lambda: weft.read_mesh("none.obj")),
    (Missing, "none.exr", lambda: weft.load("none.exr")),
    (IsADirectoryError, "", lambda: weft.read_mesh(".")),
    (Type, "path", lambda: weft.read_mesh(3.5)),
    (Bad, "text.obj:1", lambda: weft.read_mesh("text.obj")),
    (Bad, "text.exr", lambda: weft.load("text.exr")),
    (Bad, "cut.exr", lambda: weft.load("cut.exr")),
    (weft.Error, "mesh.xyz", lambda: weft.write_mesh("mesh.xyz", V, F)),
    (Missing, "none", lambda: weft.write_mesh("none/mesh.obj", V, F)),
    (Shape, "F: ", lambda: weft.write_mesh("mesh.obj", V, F + len(V))),
    (Shape, ".tif", lambda: image().save("image.tif")),
    (Missing, "none", lambda: image().save("none/image.exr")),
    (Shape, "format", lambda: image().save("image.npz", format="tiles")),
    (Type, "size", lambda: image().save("image.exr", size=3)),
    (Shape, "level", lambda: image().to_mesh(level=9)),
    (Shape, "read-only", lambda: positions_of(image(), 0, 1)),
    (Shape, "builtin", lambda: weft.builtin("shoe")),
    (Shape, "size", lambda: weft.builtin("sheet", size=0)),
    (Missing, "none", lambda: weft.write_pc2("none/a.pc2", np.zeros((2, 3, 3)))),
    (Shape, "positions", lambda: weft.write_pc2("a.pc2", np.zeros((2, 3)))),
    (Shape, "positions", lambda: weft.write_pc2("a.pc2", np.zeros((0, 3, 3)))),
    (Shape, "point 1 of frame 1", lambda: weft.write_pc2("a.pc2", changed(np.zeros((2, 3, 3)), (1, 1, 2), np.nan))),
    (Shape, "point 0 of frame 0", lambda: weft.write_pc2("a.pc2", np.full((2, 3, 3), 1e300))),
    (Bad, "text.pc2", lambda: weft.read_pc2("text.pc2")),
    # scenes
    (weft.SceneError, "no cloth", lambda: list(weft.Simulation().run(1))),
    (weft.SceneError, "coton", lambda: once(fabric="coton")),
    (weft.SceneError, "densty", lambda: once(fabric={"densty": 1})),
    (weft.SceneError, "density", lambda: once(fabric={"density": -1})),
    (weft.SceneError, "pins", lambda: once(pins=[{"image": [2, 0]}])),
    (Type, "cloth 'cloth': pins[0]: ", lambda: once(pins=[object()])),
    (Shape, "cloth 'flag': fabric.density: a finite number is wanted, not nan",
     lambda: once(name="flag", fabric={"density": np.nan})),
    (Shape, "cloth 'cloth': pins[1].nearest[2]: a finite",
     lambda: once(pins=[{"image": [0, 0]}, {"nearest": np.array([0, 0, np.inf])}])),
    (Shape, "cloth 'cloth': attach[0][0]", lambda: once(attach=[ENDLESS])),
    (Type, "cloth 'cloth': fabric.density: ", lambda: once(fabric={"density": 1j})),
    (Type, "cloth 'cloth': fabric: a key", lambda: once(fabric={3: 1})),
    (Shape, "UTF-8", lambda: once(fabric="\ud800")),
    (Shape, "name: ", lambda: once(name="\ud800")),
    (Type, "name: ", lambda: once(name=0)),
    (Type, "name: ", lambda: once(name=[])),
    (Type, "name: ", lambda: weft.Simulation().add_body("builtin:sphere", name=0)),
    (Shape, "name: ", lambda: scene(name="\ud800")),
    (Shape, "wind.drag: ", lambda: scene(wind={"velocity": [0, 0, 0], "drag": np.nan})),
    (Type, "collider.type: ", lambda: scene(collider={1, 2})),
    (weft.SceneError, "", lambda: once(attach=[{"body": "none", "image": [0, 0]}])),
    (Shape, "velocity", lambda: once(velocity=(1, 2))),
    (Shape, "translate", lambda: once(translate=(0, np.nan, 0))),
    (weft.SceneError, "scale", lambda: once(scale=0)),
    (Missing, "none.obj", lambda: weft.Simulation().add_cloth("none.obj")),
    (Shape, "cloth", lambda: weft.Simulation().add_cloth((V, F, F))),
    (Type, "cloth", lambda: weft.Simulation().add_cloth(7.5)),
    (weft.SceneError, "newtn", lambda: scene(integrator="newtn")),
    (weft.SceneError, "toleranc", lambda: scene(integrator={"type": "newton", "toleranc": 1})),
    (weft.SceneError, "collider", lambda: scene(collider="magic")),
    (Shape, "frame_rate", lambda: scene(frame_rate=0)),
    (Shape, "substeps", lambda: scene(substeps=0)),
    (Shape, "gravity", lambda: scene(gravity=9.81)),
    (Shape, "wind", lambda: scene(wind=(1, 2, 3, 4))),
    (Shape, "air_damping", lambda: scene(air_damping=-1)),
    (Shape, "frames", lambda: once(frames=-1)),
    (Type, "frames", lambda: once(frames=1.5)),
    (Shape, "motion", lambda: body(V, F, motion=np.zeros((4, len(V) - 1, 3)))),
    (Shape, "motion", lambda: body(V, F, motion=V)),
    (Shape, "motion", lambda: body(V, F, motion=np.full((4, len(V), 3), np.nan))),
    (weft.SceneError, "points", lambda: body("builtin:sphere", motion=np.zeros((4, 7, 3)))),
    (Shape, "fps", lambda: body(V, F, motion=np.stack([V, V]), fps=0)),
    (Shape, "not both", lambda: body(V, F, motion=np.stack([V, V]), keys=[])),
    (Shape, "wait", lambda: body(V, F, motion=np.stack([V, V]), wait=-1)),
    (Shape, "lead_in", lambda: body(V, F, motion=np.stack([V, V]), lead_in=np.inf)),
    (Shape, "no motion", lambda: body(V, F, wait=1)),
    (Shape, "no motion", lambda: body("builtin:sphere", lead_in=0.5)),
    (Bad, "body", lambda: body(V, F + len(V))),
    (weft.SceneError, "friction", lambda: body("builtin:sphere", friction=-1)),
    (Missing, "none.obj", lambda: body("none.obj")),
    (weft.Unstable, "stiff", explode),
    (RuntimeError, "frame 1", stale),
    (RuntimeError, "recorded", not_recorded),
    (RuntimeError, "begun", lambda: late(lambda simulation: simulation.add_cloth("builtin:sheet"))),
    (RuntimeError, "begun", lambda: late(lambda simulation: simulation.add_body("builtin:sphere"))),
    (Shape, "cloth", foreign_cloth),
    (Shape, "geometry image", lambda: positions_on("input")),
    (Shape, "on: ", lambda: positions_on("vertices")),
    (Shape, "state", foreign_state),
    (Type, "state", lambda: late(lambda simulation: simulation.restore(None))),
    (Shape, "body", lambda: late(lambda simulation: simulation.body_positions(3))),
    (Shape, "null bytes", lambda: image().save("x\0y.exr")),
    (Shape, "UTF-8", lambda: weft.read_mesh(b"\xff.obj")),
    (Shape, "finite", lambda: convert(V, F, charts="uv", uv=np.full((len(F), 3, 2), np.nan))),
    (Shape, "charts", lambda: convert(V, F, uv=np.zeros((len(F), 3, 2)))),
    (Shape, "mask", lambda: convert(np.ma.masked_array(V, V > 0), F)),
    (Type, "fit", lambda: convert(V, F, fit="no")),
    (Shape, "cut", lambda: convert(V, F, cut=[1, 2, 3])),
    (Shape, "finite", lambda: weft.write_mesh("x.obj", V * np.nan, F)),
    (Shape, "own faces", lambda: body(image(), F)),
    (weft.SceneError, "JSON", lambda: weft.Simulation.from_scene("latin.json")),
    (weft.InputError, "omage", lambda: weft.omages.load("cut.npz")),
    (weft.InputError, "omage", lambda: weft.omages.load("array.npy")),
    (Type, "uint16", lambda: weft.omages.to_mesh(np.zeros((4, 4, 12)))),
    (Shape, "(S, S, 4)", lambda: weft.omages.to_mesh(np.zeros((4, 4, 3), np.uint16))),
    (Shape, "from 0 to 1", lambda: weft.omages.arrays(image(), colour=(255, 0, 0))),
    (Missing, "none.json", lambda: weft.Simulation.from_scene("none.json")),
    (weft.SceneError, "null.json: is not JSON here", lambda: weft.Simulation.from_scene("null.json", threads=1)),
    (weft.SceneError, "scene.json:frmes", lambda: weft.Simulation.from_scene("scene.json")),
]


class BadArguments(ModuleTest):
    def setUp(self):
        super().setUp()
        for name in ("text.obj", "text.exr", "text.pc2"):
            self.folder.joinpath(name).write_text("v a b c\n")
        image().save("whole.exr")
        whole = self.folder.joinpath("whole.exr").read_bytes()
        self.folder.joinpath("cut.exr").write_bytes(whole[:len(whole) // 2])
        weft.omages.save(image(), "cut.npz")
        self.folder.joinpath("cut.npz").write_bytes(self.folder.joinpath("cut.npz").read_bytes()[:-60])
        np.save("array.npy", np.zeros(3))
        self.folder.joinpath("latin.json").write_bytes('{"name": "\xe4"}'.encode("latin-1"))
        self.folder.joinpath("scene.json").write_text('{"frmes": 3, "cloths": [{"surface": "builtin:sheet"}]}')
        self.folder.joinpath("null.json").write_text('{"version": 1, "cloths": [{"surface": "builtin:sheet", "size": 9}]}\0')
        self.kept = sorted(os.listdir("."))

    def test_each_raises_what_tells(self):
        self.assertGreaterEqual(len(CASES), 100)
        for number, (kind, word, call) in enumerate(CASES):
            with self.subTest(number, word=word):
                with self.assertRaises(kind) as caught:
                    call()
                text = str(caught.exception)
                self.assertIn(word, text)
                self.assertEqual(len(text.splitlines()), 1, text)
                self.assertGreater(len(text), 10)
        self.assertEqual(sorted(os.listdir(".")), self.kept, "nothing half-written is left")

    def test_fields_of_errors_make_their_line(self):
        with self.assertRaises(weft.InputError) as caught:
            convert(V, changed(F, (2, 1), -1), name="shirt")
        error = caught.exception
        self.assertEqual(error.where, "shirt")
        self.assertEqual(str(error), f"{error.where}: {error.found}; {error.wanted}")
        with self.assertRaises(weft.Unstable) as caught:
            explode()
        error = caught.exception
        self.assertEqual(error.cloth, "stiff")
        self.assertGreater(error.frame, 0)
        self.assertIsInstance(error, weft.SceneError)
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((type(again), str(again), again.__dict__), (type(error), str(error), error.__dict__))

    def test_a_simulation_that_ran_away_stands_at_the_frame_before(self):
        simulation = weft.Simulation(integrator="explicit", substeps=1, threads=1)
        cloth = simulation.add_cloth("builtin:sheet", size=17, pins=[{"image": [0, 0]}])
        with self.assertRaises(weft.Unstable) as caught:
            list(simulation.run(60))
        self.assertEqual(simulation.frame, caught.exception.frame - 1)
        self.assertEqual(len(simulation.cache(cloth)), simulation.frame + 1)
        self.assertTrue(np.isfinite(simulation.cache(cloth)).all())

    def test_views_outlive_their_owner(self):
        image = convert(V, F)
        wanted = image.positions.copy()
        view = image.charts[0].positions
        row = view[3]
        del image, view
        gc.collect()
        [np.zeros(row.nbytes * 40) for _ in range(20)]  # what takes memory that was freed by mistake
        np.testing.assert_array_equal(row, wanted[3])


if __name__ == "__main__":
    unittest.main()
