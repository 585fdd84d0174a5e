"""Motions of bodies from files: what numpy writes, and skins against the formulas of the glTF specification in numpy."""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import weft
from module import ModuleTest
from program import PROGRAM, SOURCE

V, F = weft.read_mesh("builtin:box")


def moving(frames=5):
    """The box, sheared more and more."""
    shear = np.linspace(0, 0.5, frames)[:, None]
    return np.stack([V[:, 0] + shear * V[:, 1], V[:, 1] + 0 * shear, V[:, 2] + shear], -1)


class Archives(ModuleTest):
    def test_every_way_in_which_numpy_writes_numbers_is_read(self):
        wanted = moving()
        for save in (np.savez, np.savez_compressed):
            for dtype in ("<f4", "<f8", ">f4", ">f8"):
                for order in (np.ascontiguousarray, np.asfortranarray):
                    with self.subTest(save=save.__name__, dtype=dtype, order=order.__name__):
                        save("a.npz", faces=F, vertices=order(wanted.astype(dtype)), names=np.array(["a"]))
                        positions, times = weft.read_pc2("a.npz", frame_rate=25)
                        np.testing.assert_array_equal(positions, wanted.astype(np.float32))
                        np.testing.assert_allclose(times, np.arange(5) / 25)

    def test_the_files_own_rate_counts(self):
        for rate in (np.float64(50), np.int64(50), np.array([50])):
            np.savez("a.npz", vertices=moving(), fps=rate)
            np.testing.assert_allclose(weft.read_pc2("a.npz", frame_rate=25)[1], np.arange(5) / 50)

    def test_objects_and_other_shapes_are_refused(self):
        broken = moving()
        broken[2, 3, 1] = np.nan
        for vertices, text in ((np.array([V, None], dtype=object), "never loaded"), (V, "shape"),
                               (moving()[..., :2], "shape"), (moving().astype(np.float16), "<f2"),
                               (moving().astype(np.int32), "whole numbers"), (broken, "point 3 in sample 2"),
                               (moving()[:0], "shape"), (np.array(["a"]), "<U1")):
            with self.subTest(text=text):
                np.savez("a.npz", vertices=vertices)
                self.assertRaisesRegex(weft.InputError, text, weft.read_pc2, "a.npz")

    def test_numbered_meshes_are_samples(self):
        for k, positions in enumerate(moving()):
            weft.write_mesh(f"body_{k + 1:04}.obj", positions, F)
        positions, times = weft.read_pc2("body_%04d.obj", frame_rate=10)
        np.testing.assert_allclose(positions, moving(), atol=1e-7)
        np.testing.assert_allclose(times, np.arange(5) / 10)
        weft.write_mesh("body_0006.obj", V[:4], [[0, 1, 2], [0, 2, 3]])
        self.assertRaisesRegex(weft.InputError, f"4 vertices; {len(V)}", weft.read_pc2, "body_%04d.obj")


class Figure:
    """A GLB file of one skinned mesh, played by the formulas of glTF 2.0, in doubles."""

    def __init__(self, path):
        data = path.read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        self.json, self.binary = json.loads(data[20:20 + length]), data[28 + length:]

    def numbers(self, index):
        accessor = self.json["accessors"][index]
        dtype = {5121: "u1", 5123: "<u2", 5126: "<f4"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor["type"]]
        offset = self.json["bufferViews"][accessor["bufferView"]]["byteOffset"]
        found = np.frombuffer(self.binary, dtype, accessor["count"] * width, offset).reshape(-1, width).astype(float)
        return found / np.iinfo(dtype).max if accessor.get("normalized") else found

    @staticmethod
    def slerp(a, b, t):
        d = np.dot(a, b)
        angle = np.arccos(min(1.0, abs(d)))
        if angle < 1e-9:
            return a
        return (np.sin((1 - t) * angle) * a + np.sign(d) * np.sin(t * angle) * b) / np.sin(angle)

    def value(self, animation, channel, seconds):
        sampler = animation["samplers"][channel["sampler"]]
        times, values = self.numbers(sampler["input"])[:, 0], self.numbers(sampler["output"])
        spline = sampler["interpolation"] == "CUBICSPLINE"
        at = lambda k: values[3 * k + 1] if spline else values[k]
        if seconds >= times[-1]:
            return at(len(times) - 1)
        k = int(np.searchsorted(times, seconds, "right")) - 1
        span = times[k + 1] - times[k]
        t = (seconds - times[k]) / span
        if spline:
            return ((2 * t**3 - 3 * t**2 + 1) * at(k) + span * (t**3 - 2 * t**2 + t) * values[3 * k + 2]
                    + (3 * t**2 - 2 * t**3) * at(k + 1) + span * (t**3 - t**2) * values[3 * k + 3])
        if channel["target"]["path"] == "rotation":
            return self.slerp(at(k), at(k + 1), t)
        return (1 - t) * at(k) + t * at(k + 1)

    def world(self, animation, seconds):
        """[nodes, 4, 4]"""
        nodes = [dict(node) for node in self.json["nodes"]]
        for channel in animation["channels"]:
            nodes[channel["target"]["node"]][channel["target"]["path"]] = self.value(animation, channel, seconds)
        placed = [None] * len(nodes)

        def place(number, parent):
            x, y, z, w = np.array(nodes[number].get("rotation", (0, 0, 0, 1.0))) / np.linalg.norm(nodes[number].get("rotation", (0, 0, 0, 1.0)))
            local = np.eye(4)
            local[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
            local[:3, 3] = nodes[number].get("translation", (0, 0, 0))
            placed[number] = parent @ local
            for child in nodes[number].get("children", ()):
                place(child, placed[number])

        for root in self.json["scenes"][0]["nodes"]:
            place(root, np.eye(4))
        return np.array(placed)

    def positions(self, name, seconds):
        animation = next(one for one in self.json["animations"] if one["name"] == name)
        attributes = self.json["meshes"][0]["primitives"][0]["attributes"]
        skin = self.json["skins"][0]
        binds = self.numbers(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
        joints = self.world(animation, seconds)[skin["joints"]] @ binds
        weights = self.numbers(attributes["WEIGHTS_0"])
        blended = np.einsum("vk,vkij->vij", weights / weights.sum(1, keepdims=True), joints[self.numbers(attributes["JOINTS_0"]).astype(int)])
        points = self.numbers(attributes["POSITION"])
        return np.einsum("vij,vj->vi", blended[:, :3, :3], points) + blended[:, :3, 3]


class Skins(ModuleTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="weft-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.made = pathlib.Path(folder.name) / "figure.glb"
        subprocess.run([sys.executable, SOURCE / "examples/make_walker.py", cls.made, "--weft", PROGRAM], check=True)

    def test_the_figure_walks_and_waves_as_the_specification_says(self):
        figure = Figure(self.made)
        for name, last in (("walk", 3.45), ("wave", 3.0)):
            positions, times = weft.read_pc2(self.made, frame_rate=30, clip=name)
            self.assertAlmostEqual(times[-1], last, 5)
            self.assertGreater(np.abs(positions[10] - positions[0]).max(), 0.1)
            for k in range(0, len(times), 7):
                apart = np.abs(positions[k] - figure.positions(name, times[k])).max()
                self.assertLess(apart, 1e-6, f"{name} at {times[k]} s")

    def test_feet_stand_on_the_ground(self):
        positions, _ = weft.read_pc2(self.made, frame_rate=60)
        lowest = positions[..., 1].min(1)
        self.assertLess(np.abs(lowest).max(), 0.012)
        along = positions[..., 2].mean(1)
        self.assertGreater(along[-1] - along[0], 2)
        self.assertGreater(np.diff(along).min(), 0)  # it never slides back

    def scene(self, animation, name="scene.json"):
        """The figure, eased in for six frames, and a small sheet beside it."""
        shutil.copy(self.made, "figure.glb")
        pathlib.Path(name).write_text(json.dumps({
            "frames": 12, "cloths": [{"surface": "builtin:sheet", "size": 9, "scale": 0.2, "translate": [2, 0.1, 0]}],
            "bodies": [{"name": "figure", "surface": "figure.glb", "size": 33, "animation": animation, "lead_in": 0.1,
                        "translate": [0, 0, 1]}]}))
        return name

    def test_runs_write_the_figure_as_it_walks(self):
        self.run_weft("simulate", self.scene("walk"), "-o", "run", "--quiet")
        written, _ = weft.read_pc2("run/figure.pc2")
        figure = Figure(self.made)
        for frame in (6, 7, 12):
            wanted = figure.positions("walk", frame / 60 - 0.1) + (0, 0, 1)
            self.assertLess(np.abs(written[frame] - wanted).max(), 1e-6)

    def test_a_run_goes_on_with_its_animation_alone(self):
        whole = self.run_json("simulate", self.scene("walk"), "-o", "whole")
        self.run_weft("simulate", "scene.json", "-o", "run", "--frames", "5", "--checkpoint", "5")
        words = [PROGRAM, "simulate", self.scene("wave", "other.json"), "-o", "run", "--resume"]
        done = subprocess.run(words, capture_output=True, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertIn("bodies/0/animation", done.stderr)
        resumed = self.run_json("simulate", self.scene("figure.glb#walk"), "-o", "run", "--resume", "--threads", "2")
        self.assertEqual(resumed["state_hash"], whole["state_hash"])

    def test_names_that_are_not_there_are_told_with_those_that_are(self):
        self.assertRaisesRegex(weft.InputError, "no animation 'run'; one of its 2, 'walk', 'wave'", weft.read_pc2, self.made, clip="run")
        self.assertRaises(TypeError, weft.read_pc2, self.made, clip=3)


if __name__ == "__main__":
    unittest.main()
