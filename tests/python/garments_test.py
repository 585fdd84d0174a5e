"""Sewing patterns as arrays, and garments that are the program's."""
import json
import pickle
import unittest

import numpy as np

import weft
from module import ModuleTest

CORNERS = {"front": [[0, 0], [30, 0], [30, 20], [0, 20]], "back": [[0, 0], [0, 20], [30, 20], [30, 0]]}


def tube():
    """A band of two panels that face each other, sewn along both sides; one edge is an arc's chord bent by a curve."""
    def panel(name, z):
        edges = [{"endpoints": [k, (k + 1) % 4]} for k in range(4)]
        return {"vertices": CORNERS[name], "edges": edges, "translation": [-15, 100, z], "rotation": [0, 0, 0]}
    panels = {"front": panel("front", 12), "back": panel("back", -12)}
    panels["front"]["edges"][0] |= {"curvature": {"type": "quadratic", "params": [[0.5, -0.1]]}, "label": "waist"}
    stitches = [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}], [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 0}]]
    return {"pattern": {"panels": panels, "stitches": stitches}, "properties": {"units_in_meter": 100}}


def read_obj(path):
    """Faces as vertices and as texture coordinates."""
    texture, faces, corners = [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[0] == "vt":
            texture.append([float(word) for word in words[1:]])
        elif words[0] == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
            corners.append([int(word.split("/")[1]) - 1 for word in words[1:]])
    return np.array(faces), np.array(texture)[np.array(corners)]


class Garments(ModuleTest):
    def setUp(self):
        super().setUp()
        (self.folder / "tube.json").write_text(json.dumps(tube()))

    def test_patterns_are_arrays_in_metres(self):
        pattern = weft.read_pattern("tube.json")
        panels = {panel.name: panel for panel in pattern.panels}
        np.testing.assert_allclose(panels["front"].vertices, np.array(CORNERS["front"]) / 100)
        self.assertEqual(panels["front"].translate, (-0.15, 1.0, 0.12))
        waist = panels["front"].edges[0]
        self.assertEqual((waist.ends, waist.kind, waist.label, waist.radius), ((0, 1), "bezier", "waist", None))
        np.testing.assert_allclose(waist.controls, [[0.15, -0.03]])
        names = [panel.name for panel in pattern.panels]
        self.assertEqual(pattern.stitches[0][:4], (names.index("front"), 1, names.index("back"), 2))
        with self.assertRaises(ValueError):
            panels["front"].vertices[0] = 1

    def test_garments_are_the_program_s(self):
        garment = weft.read_pattern("tube.json").garment(spacing=0.03)
        self.run_weft("garment", "tube.json", "--body", "builtin:sphere", "--spacing", 30, "--frames", 1, "-o", "run")
        faces, texture = read_obj(self.folder / "run/garment.obj")
        np.testing.assert_array_equal(garment.faces, faces)
        np.testing.assert_allclose(100 * garment.corner_places, texture, atol=1e-5)
        self.assertEqual(len(garment.sample_of), weft.read_pc2("run/garment.pc2")[0].shape[1])
        names = [chart.name for chart in garment.image.charts]
        areas = [np.abs(np.linalg.det(np.diff(garment.corner_places[garment.panel_of == k], axis=1))).sum() / 2 for k in range(2)]
        self.assertAlmostEqual(areas[names.index("back")], 0.3 * 0.2, places=6)
        self.assertGreater(areas[names.index("front")], 0.3 * 0.2)
        for pairs in garment.seams.values():
            joined = garment.classes.ravel()[pairs]
            np.testing.assert_array_equal(joined[:, 0], joined[:, 1])
        with self.assertRaises(ValueError):
            garment.places[0, 0] = 1

    def test_simulations_take_patterns(self):
        told = self.run_json("garment", "tube.json", "--body", "builtin:sphere", "--spacing", 30, "--frames", 5, "-o", "run")
        simulation = weft.Simulation(threads=1)
        simulation.add_body("builtin:sphere")
        simulation.add_cloth(weft.read_pattern("tube.json"), spacing=0.03, fabric={})
        for _ in simulation.run(5):
            pass
        self.assertEqual(simulation.state_hash, told["state_hash"])

    def test_patterns_keep_what_was_read(self):
        pattern = weft.read_pattern("tube.json")
        panels = [panel.vertices for panel in pattern.panels]
        early = weft.Simulation(threads=1)
        early.add_cloth(pattern, spacing=0.03)
        wanted = pattern.garment(spacing=0.03)
        other = tube()
        for panel in other["pattern"]["panels"].values():
            panel["vertices"] = [[0, 0], [9, 0], [9, 9], [0, 9]]
        for change in (lambda: (self.folder / "tube.json").write_text(json.dumps(other)), (self.folder / "tube.json").unlink):
            change()
            for kept in (pattern, pickle.loads(pickle.dumps(pattern))):
                np.testing.assert_array_equal(kept.garment(spacing=0.03).places, wanted.places)
                np.testing.assert_array_equal([panel.vertices for panel in kept.panels], panels)
                with self.assertRaisesRegex(weft.InputError, "tube.json: (has changed since|cannot be opened)"):
                    weft.Simulation().add_cloth(kept)
            with self.assertRaisesRegex(weft.InputError, "tube.json: (has changed since|cannot be opened)"):
                early.start()

    def test_arrays_of_garments_are_read_only_after_pickling_too(self):
        garment = weft.read_pattern("tube.json").garment(spacing=0.03)
        garment.faces  # what it makes when asked
        for kept in (garment, pickle.loads(pickle.dumps(garment))):
            arrays = (kept.places, kept.classes, kept.sample_of, kept.faces, kept.panel_of, kept.corner_places,
                      *kept.seams.values())
            self.assertEqual([array.flags.writeable for array in arrays], [False] * 8)
            np.testing.assert_array_equal(kept.corner_places, garment.corner_places)

    def test_garments_are_slowed_only_where_their_rest_is_wanted(self):
        damping = []
        for words, frames in ((["--frames", 5], range(5, 6)), ([], range(20, 239))):
            told = self.run_json("garment", "tube.json", "--body", "builtin:sphere", "--spacing", 30, *words, "-o", f"run{len(damping)}")
            self.assertIn(told["frames"], frames)
            damping.append(json.loads((self.folder / f"run{len(damping)}/scene.json").read_text())["air_damping"])
        self.assertEqual(damping[0], 0)
        self.assertGreater(damping[1], 1)

    def test_texture_is_a_rest_shape(self):
        (self.folder / "square.obj").write_text(
            "v 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nvt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nf 1/1 3/3 2/2\nf 1/1 4/4 3/3\n")
        widths = []
        for scale in (None, 0.5, 0.45):
            simulation = weft.Simulation(threads=1, gravity=(0, 0, 0))
            cloth = simulation.add_cloth("square.obj", size=9, rest="uv", uv_scale=scale)
            *_, frame = simulation.run(10)
            widths.append(np.ptp(frame.positions(cloth)[:, 0]))
        np.testing.assert_allclose(widths, (1, 1, 0.9), rtol=0.02)

    def test_what_is_no_pattern_is_refused(self):
        with self.assertRaises(FileNotFoundError):
            weft.read_pattern("missing.json")
        (self.folder / "bad.json").write_text(json.dumps({"pattern": {"panels": {}}}))
        with self.assertRaisesRegex(weft.InputError, "bad.json"):
            weft.read_pattern("bad.json")
        with self.assertRaisesRegex(ValueError, "spacing"):
            weft.read_pattern("tube.json").garment(spacing=0)
        with self.assertRaisesRegex(ValueError, "rest"):
            weft.Simulation().add_cloth("builtin:sheet", rest="flat")


if __name__ == "__main__":
    unittest.main()
