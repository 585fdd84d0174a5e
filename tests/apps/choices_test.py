"""The contract of convert's choices: sizes, components, seams, units, texture coordinates, seed triangles."""
import json
import unittest

from program import ProgramTest

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
TETRAHEDRON = "v 3 0 0\nv 3.5 0 0\nv 3 0.5 0\nv 3 0 0.5\n"
# Component 0: a square; component 1: a tetrahedron; component 2: three triangles on one edge.
SOUND = SQUARE + TETRAHEDRON + "f 1 2 3 4\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n"
WITH_A_FAN = SOUND + ("v 5 0 0\nv 5.1 0 0\nv 5 0.1 0\nv 5 0 0.1\nv 5 -0.1 0\n"
                      "f 9 10 11\nf 9 10 12\nf 10 9 13\n")


class ChoiceTest(ProgramTest):
    def convert(self, mesh, *words, size=9):
        """The report of a conversion to m.exr."""
        return self.run_json("convert", mesh, "-o", "m.exr", "--size", str(size), *words)

    def refuse(self, mesh, *words, code=3):
        """The error, after which no image is there."""
        (self.folder / "m.exr").unlink(missing_ok=True)
        line = self.error_of("convert", mesh, "-o", "m.exr", "--size", "9", *words, code=code)
        self.assertFalse((self.folder / "m.exr").exists())
        return line

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name


class Choices(ChoiceTest):
    def test_size_auto_picks_one_that_suits(self):
        chosen = self.convert("builtin:cone", size="auto")["image"]["size"]
        self.assertIn(chosen, [2 ** k + 1 for k in range(5, 11)])
        self.assertEqual(self.run_json("inspect", "m.exr")["image"]["size"], chosen)
        for word in ("some", "4", "9000", "1e2"):
            self.assertIn("auto", self.error_of("convert", "builtin:cone", "-o", "m.exr", "--size", word, code=2))

    def test_all_components_are_written_and_those_that_fail_are_named(self):
        sound = self.run_json("convert", self.write("two.obj", SOUND), "-o", "t.exr", "--size", "17",
                              "--component", "all")
        self.assertEqual((len(sound["conversions"]), sound["failed"]), (2, []))
        mesh = self.write("three.obj", WITH_A_FAN)
        done = self.run_weft("convert", mesh, "-o", "m.exr", "--size", "17", "--component", "all", "--json", code=3)
        report = json.loads(done.stdout)
        self.assertEqual([c["outputs"] for c in report["conversions"]], [["m-0.exr"], ["m-1.exr"]])
        self.assertEqual([c["input"]["genus"] for c in report["conversions"]], [0, 0])
        self.assertEqual([f["component"] for f in report["failed"]], [2])
        self.assertIn("non-manifold", report["failed"][0]["error"])
        self.assertIn("1 of 3 components did not convert: 2", done.stderr.splitlines()[-1])
        self.assertTrue((self.folder / "m-1.exr").exists())
        self.assertFalse((self.folder / "m-2.exr").exists())

    def test_a_component_that_is_not_there_is_refused(self):
        mesh = self.write("two.obj", SOUND)
        self.assertIn("0 to 1", self.refuse(mesh, "--component", "2"))
        self.refuse(mesh, "--component", "two", code=2)
        self.assertEqual(self.convert(mesh, "--component", "1")["input"]["triangles"], 4)

    def test_seed_triangle_counts_as_the_file_does(self):
        mesh = self.write("two.obj", SOUND)
        self.convert(mesh, "--component", "1", "--seed-triangle", "2")
        self.assertIn("seed triangle: 1 is not in", self.refuse(mesh, "--component", "1", "--seed-triangle", "1"))
        self.refuse(mesh, "--component", "all", "--seed-triangle", "1", code=2)

    def test_normal_maps_have_their_own_size(self):
        for size in (5, 9, 64, 100):
            report = self.convert("builtin:cone", "--normal-map", str(size), size=33)
            self.assertEqual(report["outputs"], ["m.exr", "m-normals.exr"])
        self.refuse("builtin:cone", "--normal-map", "4", code=2)

    def test_texture_coordinates_are_written_beside(self):
        mesh = self.write("square.obj", SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
        report = self.run_json("convert", mesh, "-o", "s.png", "--size", "9", "--keep-uv")
        self.assertEqual(report["outputs"], ["s.png", "s-uv.exr"])
        self.assertEqual((self.folder / "s-uv.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")
        self.assertIn("bare.obj", self.refuse(self.write("bare.obj", SQUARE + "f 1 2 3 4\n"), "--keep-uv"))


class Seams(ChoiceTest):
    def setUp(self):
        super().setUp()
        self.run_weft("shapes", "torus", "-o", "torus.obj")  # 96 x 40 vertices, 96 a row

    def test_a_seam_that_opens_the_mesh_is_the_cut(self):
        ring = " ".join(str(k % 96) for k in range(97))
        tube = " ".join(str(96 * (k % 40)) for k in range(41))
        self.write("seam.txt", f"# around the hole\n{ring}\n{tube}\n")
        for mesh in ("torus.obj", "builtin:torus"):
            report = self.convert(mesh, "--cut", "seam.txt", size=65)
            self.assertEqual(report["warnings"], [])
            self.assertEqual((report["cut"]["paths"], report["cut"]["nodes"], report["cut"]["rounds"]), (2, 1, 0))
            self.assertAlmostEqual(report["cut"]["length"], 2 * 3.14159 * (0.5 + 0.15), delta=0.01)

    def test_one_that_does_not_suffice_is_completed_with_a_warning(self):
        self.write("seam.txt", "0 48 0\n")
        report = self.convert("torus.obj", "--cut", "seam.txt", size=65)
        self.assertEqual(len(report["warnings"]), 1)
        self.assertIn("seam.txt", report["warnings"][0])
        self.assertEqual(report["map"]["flipped"], 0)

    def test_bad_seams_are_refused_with_their_line(self):
        self.write("seam.txt", "0 1 97 0\n")
        self.assertIn("seam.txt:1: this path cuts the surface in pieces", self.refuse("torus.obj", "--cut", "seam.txt"))
        self.write("seam.txt", "0 1\n\n0 3840\n")
        self.assertIn("seam.txt:3: vertex 3840", self.refuse("torus.obj", "--cut", "seam.txt"))
        self.write("seam.txt", "0 1 x\n")
        self.assertIn("seam.txt:1", self.refuse("torus.obj", "--cut", "seam.txt"))
        self.assertIn("none.txt", self.refuse("torus.obj", "--cut", "none.txt"))
        self.write("seam.txt", "0 1\n")
        self.refuse("torus.obj", "--cut", "seam.txt", "--component", "all", code=2)


class Units(ChoiceTest):
    def check_box(self, expected, *words):
        """Of a tetrahedron's image; its samples do not meet every tip."""
        mesh = self.write("t.obj", TETRAHEDRON + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        self.convert(mesh, *words, size=65)
        self.run_weft("rebuild", "m.exr", "-o", "again.obj")
        lines = (self.folder / "again.obj").read_text().splitlines()
        points = [[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")]
        for axis, (least, largest) in zip(zip(*points), expected):
            self.assertAlmostEqual(min(axis), least, delta=0.06 * (largest - least))
            self.assertAlmostEqual(max(axis), largest, delta=0.06 * (largest - least))

    def test_numbers_are_what_the_user_says(self):
        self.check_box([(3, 3.5), (0, 0.5), (0, 0.5)])
        self.check_box([(0.0762, 0.0889), (0, 0.0127), (0, 0.0127)], "--unit", "in")
        self.check_box([(3, 3.5), (0, 0.5), (-0.5, 0)], "--up", "z")

    def test_implausible_sizes_are_worth_a_warning(self):
        mesh = self.write("cm.obj", "v 0 0 0\nv 170 0 0\nv 0 60 0\nf 1 2 3\n")
        for command in (["convert", mesh, "-o", "m.exr", "--size", "9"], ["inspect", mesh]):
            done = self.run_weft(*command, "--json")
            self.assertIn("weft: warning: cm.obj", done.stderr)
            self.assertIn("--unit cm", json.loads(done.stdout)["warnings"][0])
            self.assertEqual(self.run_json(*command, "--unit", "cm")["warnings"], [])

    def test_drape_warns_of_cloth_of_an_implausible_size(self):
        self.write("cm.obj", "v 0 0 0\nv 170 0 0\nv 0 0 60\nf 1 3 2\n")
        command = ["drape", "cm.obj", "builtin:sphere", "-o", "run", "--size", "9", "--frames", "1"]
        self.assertIn("weft: warning: cm.obj: its largest side", self.run_weft(*command).stderr)
        self.assertEqual(self.run_weft(*command, "--unit", "cm").stderr, "")

    def test_unknown_words_are_usage_errors(self):
        for words in (["--unit", "ft"], ["--up", "x"]):
            self.refuse("builtin:cone", *words, code=2)


if __name__ == "__main__":
    unittest.main()
