"""The contract of inspect: what it says of meshes, broken ones too, and of images."""
import json
import math
import unittest

from patterns import pattern_of_a_tube
from program import ProgramTest

# Two unit cubes, the second moved by half its side along x, y and z.
CUBE_FACES = ((1, 3, 4), (1, 4, 2), (5, 6, 8), (5, 8, 7), (1, 2, 6), (1, 6, 5),
              (3, 7, 8), (3, 8, 4), (1, 5, 7), (1, 7, 3), (2, 4, 8), (2, 8, 6))


def cube(shift, first):
    corners = [(x + shift, y + shift, z + shift) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += ["f " + " ".join(str(v + first) for v in face) for face in CUBE_FACES]
    return "\n".join(lines) + "\n"


class Inspect(ProgramTest):
    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def test_closed_mesh_is_told_whole(self):
        found = self.run_json("inspect", self.write("cube.obj", cube(0, 0)))
        self.assertEqual(found["bounding_box"], {"lower": [0, 0, 0], "upper": [1, 1, 1]})
        self.assertEqual((found["closed"], found["orientable"]), (True, True))
        self.assertAlmostEqual(found["area"], 6)
        self.assertAlmostEqual(found["volume"], 1)
        self.assertEqual(found["component_list"], [
            {"triangles": 12, "vertices": 8, "area": 6, "boundaries": 0, "genus": 0, "euler": 2,
             "orientable": True, "closed": True}])
        self.assertEqual(found["self_intersections"], 0)
        self.assertGreaterEqual(found["least_size"], 5)
        self.assertEqual(found["input"]["genus"], 0)

    def test_patterns_are_told_panel_by_panel(self):
        found = self.run_json("inspect", self.write("tube.json", json.dumps(pattern_of_a_tube())))["pattern"]
        front = next(panel for panel in found["panels"] if panel["name"] == "front")
        self.assertAlmostEqual(front["area"], 0.06)
        self.assertEqual([round(x, 9) for x in front["extent"]], [0.3, 0.2])
        self.assertEqual(sorted(round(edge["length"], 9) for edge in front["edges"]), [0.2, 0.2, 0.3, 0.3])
        self.assertEqual(sum(len(edge["sewn_to"]) for panel in found["panels"] for edge in panel["edges"]), 2 * found["seams"])
        self.assertIn("--against", self.error_of("inspect", "tube.json", "--against", "builtin:sphere", code=2))
        self.assertIn("GarmentCode pattern is wanted", self.error_of("inspect", self.write("odd.json", "{}"), code=3))

    def test_a_pattern_with_one_side_only_is_refused_as_garment_refuses_it(self):
        twisted = pattern_of_a_tube()
        twisted["pattern"]["stitches"][0].append("right_wrong")
        name = self.write("twisted.json", json.dumps(twisted))
        error = self.error_of("inspect", name, code=3)
        self.assertIn("leaves one side only", error)
        self.assertEqual(error, self.error_of("garment", name, "--body", "builtin:sphere", "-o", "run", code=3))

    def test_unit_and_axis_of_no_mesh_are_refused(self):
        self.run_weft("convert", "builtin:sphere", "-o", "s.exr", "--size", "17")
        self.write("tube.json", json.dumps(pattern_of_a_tube()))
        self.write("square.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n")
        for words in (["--unit", "cm"], ["--up", "y"]):
            for subject in ("s.exr", "tube.json"):
                error = self.error_of("inspect", subject, *words, code=2)
                self.assertRegex(error, f"^weft: error: {words[0]}: .*leave it out$")
            self.run_weft("inspect", "s.exr", "--against", "square.obj", *words)
            self.run_weft("inspect", "square.obj", *words)
            for command in (["inspect", "builtin:torus"], ["inspect", "builtin:torus", "--against", "builtin:cone"],
                            ["inspect", "s.exr", "--against", "builtin:sphere"],
                            ["convert", "builtin:torus", "-o", "t.exr"]):
                error = self.error_of(*command, *words, code=2)
                self.assertRegex(error, f"^weft: error: {words[0]}: .*metres with y up; leave it out$")
            self.run_weft("inspect", "builtin:sphere", "--against", "square.obj", *words)

    def test_two_cubes_pushed_into_each_other_cross(self):
        found = self.run_json("inspect", self.write("two.obj", cube(0, 0) + cube(0.5, 8)))
        self.assertEqual(found["input"]["components"], 2)
        self.assertEqual([c["triangles"] for c in found["component_list"]], [12, 12])
        self.assertEqual((found["input"]["euler"], found["input"]["genus"]), (4, 0))
        self.assertGreaterEqual(found["least_size"], 10)
        # Three faces of each cube meet three of the other in six segments of half a side, each on one
        # side of the diagonals of both faces.
        self.assertEqual(found["self_intersections"], 6)
        for pair in found["self_intersection_list"]:
            self.assertTrue(pair[0] < 12 <= pair[1], pair)

    def test_places_are_named_by_vertex(self):
        mesh = self.write("fan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\n"
                                     "f 1 2 3\nf 1 2 4\nf 2 1 5\n")
        found = self.run_json("inspect", mesh)
        self.assertEqual((found["nonmanifold_edges"], found["nonmanifold_edge_list"]), (1, [[0, 1]]))
        self.assertEqual(found["unreferenced_vertices"], 1)
        self.assertIsNone(found["component_list"][0]["genus"])
        said = self.run_weft("inspect", mesh).stdout
        self.assertIn("0-1", said)
        self.assertIn("parted at 1 edge", said.splitlines()[-1])

    def test_charts_are_those_that_convert_makes(self):
        band = [f"v {x} {y} 0" for x in range(6) for y in range(2)]
        band += [f"f {2 * i + 1} {2 * i + 2} {2 * i + 4}\nf {2 * i + 1} {2 * i + 4} {2 * i + 3}" for i in range(5)]
        turned = "\n".join(band + ["f 11 12 1", "f 11 1 2"]) + "\n"  # the last edge to the first, the other way round
        fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n"
        for mesh, charts, may_be_split in ((self.write("turned.obj", turned), None, False), (self.write("fan.obj", fan), 3, False),
                                           (self.write("two.obj", cube(0, 0) + cube(0.5, 8)), 2, False),
                                           ("builtin:torus", 1, True)):
            found = self.run_json("inspect", mesh)["charts"]
            made = self.run_json("convert", mesh, "-o", "made.exr", "--size", "65")["charts"]
            self.assertEqual(found, {"least": charts or len(made), "may_be_split": may_be_split}, mesh)
            self.assertEqual(len(made), found["least"], mesh)
        self.assertIn("1 chart, more where that image would be poor", self.run_weft("inspect", "builtin:torus").stdout)

    def test_borders_are_measured(self):
        found = self.run_json("inspect", self.write("square.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n"))
        self.assertEqual(found["border_loops"],
                         [{"vertices": 4, "length": 8, "component": 0, "least_vertex": 0}])
        self.assertIsNone(found["volume"])
        self.assertIs(found["closed"], False)

    def test_texture_coordinates_are_seen(self):
        plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        textured = self.write("uv.obj", plain + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        self.assertIs(self.run_json("inspect", textured)["texture_coordinates"], True)
        bare = self.write("bare.obj", plain + "f 1 2 3\n")
        self.assertIs(self.run_json("inspect", bare)["texture_coordinates"], False)

    def test_verdict_tells_repairs_and_the_least_size_works(self):
        mesh = self.write("turned.obj", cube(0, 0).replace("f 1 3 4", "f 1 4 3"))
        found = self.run_json("inspect", mesh)
        self.assertEqual(found["inconsistent_edges"], 3)
        self.assertEqual(len(found["input"]["repairs"]), 1)
        self.assertIn(found["input"]["repairs"][0], self.run_weft("inspect", mesh).stdout.splitlines()[-1])
        least = found["least_size"]
        self.run_weft("convert", "builtin:torus", "-o", "t.exr",
                      "--size", self.run_json("inspect", "builtin:torus")["least_size"] + 4)
        self.assertIsInstance(least, int)

    def test_image_is_measured_from_both_sides(self):
        self.run_weft("convert", "builtin:torus", "-o", "t.exr", "--size", "33")
        found = self.run_json("inspect", "t.exr", "--against", "builtin:torus")["image"]
        self.assertEqual(found["bytes"], (self.folder / "t.exr").stat().st_size)
        self.assertGreater(found["stretch_l2"], 0.99)
        self.assertLessEqual(found["stretch_l2"], found["stretch_linf"])
        # A few are left beside a node of the border, see docs/decisions/0018.
        self.assertLess(found["folded_quads"], 5)
        self.assertEqual(len(found["worst_quad"]), 2)
        self.assertGreaterEqual(found["largest_mate_class"], 2)
        for side in ("from_mesh", "from_image"):
            self.assertGreater(found[side]["largest"], found[side]["rms"])
        self.assertGreater(found["psnr_db"], 40)
        self.assertLess(found["bounding_box"]["lower"][0], found["bounding_box"]["upper"][0])

    def test_meshes_are_compared_with_meshes(self):
        same = self.run_json("inspect", "builtin:torus", "--against", "builtin:torus")["against"]
        self.assertGreater(same["psnr_db"], 200)
        (self.folder / "low.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        (self.folder / "high.obj").write_text("v 0 0 0.01\nv 1 0 0.01\nv 1 1 0.01\nv 0 1 0.01\nf 1 2 3 4\n")
        apart = self.run_json("inspect", "low.obj", "--against", "high.obj")["against"]
        self.assertAlmostEqual(apart["psnr_db"], 20 * math.log10(2 ** 0.5 / 0.01), places=6)
        for kind in ("mean", "rms", "largest"):
            self.assertAlmostEqual(apart["from_subject"][kind], 0.01, places=9)


if __name__ == "__main__":
    unittest.main()
