"""The contract of convert, rebuild, inspect and shapes: fields, exit codes, errors, files."""
import json
import math
import resource
import signal
import struct
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest

INPUT_FIELDS = ["path", "vertices", "triangles", "components", "boundaries", "genus", "euler", "repairs"]
TOP_FIELDS = {
    "input": INPUT_FIELDS,
    "cut": ["paths", "nodes", "length", "rounds"],
    "map": ["parameterizer", "flipped", "degenerate", "stretch_l2", "stretch_linf"],
    "image": ["size", "mates_bit_equal", "euler", "boundaries", "psnr_db", "hausdorff_percent"],
    "seconds": ["load", "cut", "map", "sample", "measure", "total"],
}


class Convert(ProgramTest):
    def check_promises(self, report):
        for group, fields in TOP_FIELDS.items():
            for field in fields:
                self.assertIn(field, report[group], group)
        self.assertEqual(report["map"]["flipped"], 0)
        self.assertEqual(report["map"]["degenerate"], 0)
        self.assertIs(report["image"]["mates_bit_equal"], True)
        self.assertEqual(report["image"]["euler"], report["input"]["euler"])
        self.assertEqual(report["image"]["boundaries"], report["input"]["boundaries"])
        self.assertGreater(report["image"]["psnr_db"], 30)

    def test_report_of_a_sphere_keeps_every_promise(self):
        report = self.run_json("convert", "builtin:sphere", "-o", "s.exr", "--size", "65")
        self.check_promises(report)
        self.assertEqual(report["input"]["euler"], 2)
        self.assertEqual(report["outputs"], ["s.exr"])
        self.assertTrue((self.folder / "s.exr").stat().st_size > 1000)

    def test_peak_memory_is_what_the_system_says(self):
        report = self.run_json("convert", "builtin:sphere", "-o", "s.exr", "--size", "65")
        # Of the largest child so far; no child of this test is larger by much.
        largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024e-6
        self.assertGreater(report["peak_memory_mb"], 5)
        self.assertLessEqual(report["peak_memory_mb"], largest)
        words = self.run_weft("convert", "builtin:sphere", "-o", "s.exr", "--size", "65").stdout
        self.assertRegex(words, r"memory  \d+ MB at most")

    def test_both_parameterizers_are_named_in_the_report(self):
        for name in ("floater", "stretch"):
            report = self.run_json("convert", "builtin:sphere", "-o", "s.exr", "--size", "33",
                                   "--parameterizer", name)
            self.assertEqual(report["map"]["parameterizer"], name)

    def painted(self, name="painted.ply"):
        """A ball, red where x < 0 and blue elsewhere."""
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        lines = (self.folder / "ball.obj").read_text().splitlines()
        points = [line.split()[1:] for line in lines if line.startswith("v ")]
        faces = [[int(word) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")]
        header = ("ply\nformat ascii 1.0\nelement vertex {}\n" + "".join(f"property double {axis}\n" for axis in "xyz") +
                  "".join(f"property uchar {colour}\n" for colour in ("red", "green", "blue")) +
                  "element face {}\nproperty list uchar int vertex_indices\nend_header\n")
        with open(self.folder / name, "w", encoding="utf-8") as file:
            file.write(header.format(len(points), len(faces)))
            file.writelines(" ".join(p) + (" 255 0 0\n" if float(p[0]) < 0 else " 0 0 255\n") for p in points)
            file.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces)
        return name

    def points_of(self, name):
        """Vertices of a PLY that weft wrote, without colours."""
        head, body = (self.folder / name).read_bytes().split(b"end_header\n", 1)
        count = int(head.split(b"element vertex ")[1].split()[0])
        return [struct.unpack_from("<3d", body, 24 * k) for k in range(count)]

    def colours_of(self, name):
        """Positions and colours of a PLY that weft wrote."""
        data = (self.folder / name).read_bytes()
        head, body = data.split(b"end_header\n", 1)
        self.assertIn(b"property uchar red\n", head)
        count = int(head.split(b"element vertex ")[1].split()[0])
        return [struct.unpack_from("<3d3B", body, 27 * k) for k in range(count)]

    def test_colours_go_through_the_image_into_the_mesh(self):
        report = self.run_json("convert", self.painted(), "-o", "ball.exr", "--size", "65", "--colours")
        self.assertEqual(report["outputs"], ["ball.exr", "ball-colour.png"])
        width, height = struct.unpack(">II", (self.folder / "ball-colour.png").read_bytes()[16:24])
        self.assertEqual((width, height), (257, 257))
        plain = self.run_json("convert", "painted.ply", "-o", "plain.exr", "--size", "65")
        self.assertEqual(plain["image"]["psnr_db"], report["image"]["psnr_db"])
        self.assertEqual(plain["outputs"], ["plain.exr"])
        self.run_weft("convert", "painted.ply", "-o", "ball.weft", "--size", "65", "--colours")
        for image in ("ball.exr", "ball.weft"):
            self.run_weft("rebuild", image, "-o", "again.ply")
            far = [(x, colour) for x, _, _, *colour in self.colours_of("again.ply") if abs(x) > 0.1]
            self.assertGreater(len(far), 1000)
            for x, colour in far:
                self.assertEqual(colour, [255, 0, 0] if x < 0 else [0, 0, 255])

    def test_rebuilt_meshes_hold_texture_coordinates_and_units(self):
        self.run_weft("convert", "builtin:torus", "-o", "t.exr", "--size", "17")
        self.run_weft("rebuild", "t.exr", "-o", "plain.obj")
        self.run_weft("rebuild", "t.exr", "-o", "t.obj", "--texture", "33", "--unit", "cm", "--up", "z")
        lines = {name: [line.split() for line in (self.folder / name).read_text().splitlines()] for name in ("plain.obj", "t.obj")}
        points = {name: [[float(x) for x in line[1:]] for line in found if line[0] == "v"] for name, found in lines.items()}
        for (x, y, z), moved in zip(points["plain.obj"], points["t.obj"], strict=True):
            for a, b in zip((100 * x, -100 * z, 100 * y), moved, strict=True):
                self.assertAlmostEqual(a, b, places=9)
        texture = sorted([float(x) for x in line[1:]] for line in lines["t.obj"] if line[0] == "vt")
        self.assertGreaterEqual(len(texture), 15 * 15)
        for found, wanted in ((texture[0], (0.5 / 33, 0.5 / 33)), (texture[-1], (32.5 / 33, 32.5 / 33))):
            for a, b in zip(found, wanted, strict=True):
                self.assertAlmostEqual(a, b, places=6)
        faces = [[corner.split("/")[0] for corner in line[1:]] for line in lines["t.obj"] if line[0] == "f"]
        self.assertEqual(faces, [line[1:] for line in lines["plain.obj"] if line[0] == "f"])
        self.assertIn("--texture", self.error_of("rebuild", "t.exr", "-o", "t.ply", "--texture", "33", code=2))

    def test_pictures_of_the_mesh_are_not_written_over(self):
        self.run_weft("convert", self.painted(), "-o", "ball.exr", "--size", "33", "--colours")
        (self.folder / "ball.exr").unlink()
        picture = (self.folder / "ball-colour.png").read_bytes()
        (self.folder / "ball.mtl").write_text("newmtl two  words # one\nmap_Kd ball-colour.png\n")
        (self.folder / "ball.obj").write_text("mtllib ball.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                              "usemtl two words\nf 1/1 2/2 3/3 4/4\n")
        line = self.error_of("convert", "ball.obj", "-o", "ball.exr", "--colours", code=3)
        self.assertIn("ball-colour.png: would be overwritten, and is read here", line)
        self.assertEqual((self.folder / "ball-colour.png").read_bytes(), picture)
        self.assertFalse((self.folder / "ball.exr").exists())
        self.run_weft("convert", "ball.obj", "-o", "other.exr", "--colours")

    def test_what_lies_beside_the_image_is_looked_at_before_any_is_written(self):
        (self.folder / "ring-normals.exr").mkdir()
        line = self.error_of("convert", "builtin:torus", "-o", "ring.exr", "--size", "17", "--normal-map", "17", code=3)
        self.assertIn("ring-normals.exr: is a folder", line)
        self.assertFalse((self.folder / "ring.exr").exists())

    def test_vertices_of_no_triangle_change_no_measure(self):
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        (self.folder / "stray.obj").write_text((self.folder / "ball.obj").read_text() + "v 100 100 100\n")
        image = self.run_json("convert", "stray.obj", "-o", "stray.exr", "--size", "33")["image"]
        for mesh in ("ball.obj", "stray.obj"):
            found = self.run_json("inspect", "stray.exr", "--against", mesh)["image"]
            self.assertAlmostEqual(found["psnr_db"], image["psnr_db"], places=6, msg=mesh)

    def test_normals_of_a_compressed_image_are_an_exr(self):
        report = self.run_json("convert", "builtin:torus", "-o", "ring.weft", "--size", "33", "--normal-map", "33")
        self.assertEqual(report["outputs"], ["ring.weft", "ring-normals.exr"])

    def test_colours_that_are_not_there_are_an_error(self):
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        line = self.error_of("convert", "ball.obj", "-o", "b.exr", "--colours", code=3)
        self.assertIn("ball.obj: has no colours; vertex colours, or materials", line)
        self.assertIn("--colours", self.error_of("convert", "builtin:sphere", "-o", "b.exr", "--colours", code=2))
        self.assertFalse((self.folder / "b.exr").exists())

    def test_compressed_images_are_small_and_keep_their_word(self):
        whole = self.run_json("convert", "builtin:knot", "-o", "m.exr", "--size", "129")
        small = self.run_json("convert", "builtin:knot", "-o", "m.weft", "--size", "129", "--precision", "11")
        self.check_promises(small)
        self.assertEqual(small["image"]["bytes"], (self.folder / "m.weft").stat().st_size)
        self.assertLess(small["image"]["bytes"], whole["image"]["bytes"] / 6)
        self.assertGreater(small["image"]["psnr_db"], whole["image"]["psnr_db"] - 1.5)
        against = self.run_json("inspect", "m.weft", "--against", "builtin:knot")["image"]
        self.assertAlmostEqual(against["psnr_db"], small["image"]["psnr_db"], places=9)
        self.run_weft("rebuild", "m.weft", "-o", "m.ply")
        self.run_weft("rebuild", "m.exr", "-o", "whole.ply")
        apart = [math.dist(p, q) for p, q in zip(self.points_of("m.ply"), self.points_of("whole.ply"), strict=True)]
        self.assertLess(1000 * max(apart), small["image"]["largest_error_mm"])
        self.assertGreater(1000 * max(apart), 0.5 * small["image"]["largest_error_mm"])

    def test_error_says_how_far_samples_may_move(self):
        for error in (2, 0.1):
            image = self.run_json("convert", "builtin:sphere", "-o", "s.weft", "--size", "65", "--error", error)["image"]
            self.assertLessEqual(image["largest_error_mm"], error)
            self.assertGreater(image["largest_error_mm"], 0.98 * error)
        line = self.error_of("convert", "builtin:sphere", "-o", "s.weft", "--size", "17", "--error", "1e-6", code=2)
        self.assertIn("--error", line)
        # Before it converts, which two pieces in one chart would not.
        (self.folder / "two.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 2 1 0\nf 1 2 3\nf 4 5 6\n")
        two = ["convert", "two.obj", "-o", "s.weft", "--size", "17", "--charts", "1", "--error"]
        self.assertIn("for a side of 3 m at least 0.04 mm", self.error_of(*two, "1e-6", code=2))
        self.error_of(*two, "1", code=3)
        for option in ("--error", "--precision"):
            self.assertIn(option, self.error_of("convert", "builtin:sphere", "-o", "m.exr", option, "8", code=2))
        for output in ("m.exr", "m.weft"):
            self.error_of("convert", "builtin:sphere", "-o", output, "--size", "17", "--error", "nan", code=2)

    def test_normal_map_is_written_beside(self):
        report = self.run_json("convert", "builtin:sphere", "-o", "s.png", "--size", "33", "--normal-map", "64")
        self.assertEqual(report["outputs"], ["s.png", "s-normals.png"])
        for name in report["outputs"]:
            self.assertEqual((self.folder / name).read_bytes()[:4], b"\x89PNG")

    def test_shared_meshes_keep_topology(self):
        for name in ("gpt_mannequin.off", "opt_cube.obj", "cgal_eight.off", "opt_torus_with_holes.obj"):
            with self.subTest(name):
                mesh = self.shared_mesh(name)
                self.check_promises(self.run_json("convert", mesh, "-o", "m.exr", "--size", "65"))

    def test_glb_becomes_an_image(self):
        self.run_weft("shapes", "torus", "-o", "t.obj")
        lines = [line.split() for line in (self.folder / "t.obj").read_text().splitlines()]
        points = [[float(x) for x in line[1:4]] for line in lines if line[0] == "v"]
        corners = [points[int(i) - 1] for line in lines if line[0] == "f" for i in line[1:4]]
        # Every corner a vertex of its own, as programs write them that keep a normal for each.
        binary = b"".join(struct.pack("<3f", *corner) for corner in corners)
        text = json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": len(binary)}],
            "buffers": [{"byteLength": len(binary)}]}).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
        (self.folder / "t.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        report = self.run_json("convert", "t.glb", "-o", "t.exr", "--size", "33")
        self.check_promises(report)
        self.assertEqual((report["input"]["vertices"], report["input"]["genus"]), (len(points), 1))

    def test_png_and_exr_rebuild_to_the_input_topology(self):
        for ending in ("exr", "png"):
            self.run_weft("convert", "builtin:torus", "-o", f"t.{ending}", "--size", "33")
            rebuilt = self.run_json("rebuild", f"t.{ending}", "-o", "t.obj")
            self.assertEqual(rebuilt["image"]["euler"], 0)
            found = self.run_json("inspect", "t.obj")
            self.assertEqual((found["input"]["genus"], found["input"]["boundaries"]), (1, 0))

    def test_same_input_gives_the_same_bytes(self):
        for name, threads in (("a.exr", 1), ("b.exr", 2)):
            self.run_weft("convert", "builtin:sphere", "-o", name, "--size", "33", "--threads", threads)
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes())

    def test_seed_moves_the_measuring_samples_only(self):
        reports = [self.run_json("convert", "builtin:sphere", "-o", f"{seed}.exr", "--size", "33", "--seed", seed)
                   for seed in (1, 2)]
        self.assertNotEqual(reports[0]["image"]["psnr_db"], reports[1]["image"]["psnr_db"])
        self.assertEqual((self.folder / "1.exr").read_bytes(), (self.folder / "2.exr").read_bytes())

    def test_fitted_samples_raise_psnr_and_keep_every_promise(self):
        plain = self.run_json("convert", "builtin:torus", "-o", "plain.exr", "--size", "33")
        fitted = self.run_json("convert", "builtin:torus", "-o", "fitted.exr", "--size", "33", "--fit")
        self.check_promises(fitted)
        self.assertGreater(fitted["image"]["psnr_db"], plain["image"]["psnr_db"] + 2)
        for field in ("parameterizer", "flipped", "degenerate", "stretch_l2", "stretch_linf"):
            self.assertEqual(fitted["map"][field], plain["map"][field])
        again = self.run_json("rebuild", "fitted.exr", "-o", "t.obj")
        self.assertEqual(again["image"]["euler"], 0)

    def test_pieces_become_charts_or_are_chosen_or_refused(self):
        two = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 1 3 4\nf 5 6 7\n"
        (self.folder / "two.obj").write_text(two)
        both = self.run_json("convert", "two.obj", "-o", "m.exr", "--size", "33")
        self.assertEqual(both["input"]["components"], 2)
        self.assertEqual((both["image"]["euler"], both["image"]["boundaries"], both["image"]["size"]), (2, 2, 33))
        self.assertEqual(len(both["charts"]), 2)
        for chart in both["charts"]:
            self.assertEqual(sorted(chart), ["col", "cols", "name", "row", "rows"])
        self.assertGreater(both["image"]["psnr_db"], 80)
        again = self.run_json("rebuild", "m.exr", "-o", "again.obj")
        self.assertEqual((again["image"]["euler"], len(again["image"]["charts"])), (2, 2))
        level = self.run_json("rebuild", "m.exr", "-o", "coarse.obj", "--level", "1")
        self.assertEqual((level["image"]["euler"], level["image"]["size"]), (2, 17))
        self.assertIn("a level from 0 to", self.error_of("rebuild", "m.exr", "-o", "coarse.obj", "--level", "9", code=2))
        self.assertGreaterEqual(both["image"]["coarsest_level"], 1)
        self.assertAlmostEqual(both["map"]["area_ratio"], 1, 2)
        self.assertLess(both["map"]["reversed_area"], 1e-4)
        small = self.run_json("convert", "two.obj", "-o", "m.exr", "--size", "9")
        self.assertEqual(small["image"]["size"], 17)
        self.assertIn("do not fit into 9 x 9", small["warnings"][0])
        counted = self.run_json("convert", "two.obj", "-o", "m.exr", "--samples", "4000")
        self.assertEqual(counted["image"]["size"], 61)
        self.error_of("convert", "two.obj", "-o", "m.exr", "--samples", "4000", "--size", "9", code=2)
        line = self.error_of("convert", "two.obj", "-o", "m.exr", "--size", "9", "--charts", "1", code=3)
        self.assertIn("2 components", line)
        self.assertIn("--component", line)
        chosen = self.run_json("convert", "two.obj", "-o", "m.exr", "--size", "9", "--component", "largest")
        self.assertEqual((chosen["input"]["triangles"], chosen["input"]["components"]), (2, 2))
        every = self.run_json("convert", "two.obj", "-o", "m.exr", "--size", "9", "--component", "all")
        self.assertEqual([c["outputs"] for c in every["conversions"]], [["m-0.exr"], ["m-1.exr"]])


class Interruption(ProgramTest):
    def write_torus(self, around, across):
        points, faces = [], []
        for i in range(around):
            for j in range(across):
                a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
                ring = 1 + 0.4 * math.cos(b)
                points.append(f"v {ring * math.cos(a)} {0.4 * math.sin(b)} {-ring * math.sin(a)}\n")
                v = [p % around * across + q % across + 1 for p in (i, i + 1) for q in (j, j + 1)]
                faces.append(f"f {v[0]} {v[2]} {v[3]}\nf {v[0]} {v[3]} {v[1]}\n")
        (self.folder / "torus.obj").write_text("".join(points + faces))

    def convert_torus(self):
        return subprocess.Popen([PROGRAM, "convert", "torus.obj", "-o", "t.exr", "--quiet"], cwd=self.folder,
                                stderr=subprocess.PIPE, text=True)

    def test_a_stop_at_any_time_leaves_nothing_behind(self):
        self.write_torus(250, 200)
        start = time.monotonic()
        self.convert_torus().communicate()
        whole = time.monotonic() - start
        stopped = 0
        for part in (0.1, 0.3, 0.5, 0.7):
            (self.folder / "t.exr").unlink(missing_ok=True)
            with self.subTest(part), self.convert_torus() as process:
                time.sleep(part * whole)
                process.send_signal(signal.SIGINT)
                _, errors = process.communicate(timeout=20)
                if process.returncode == 0:
                    continue  # the machine became faster meanwhile
                stopped += 1
                self.assertEqual(process.returncode, 130, errors)
                self.assertEqual(errors, "weft: error: interrupted\n")
                self.assertEqual([path.name for path in self.folder.iterdir()], ["torus.obj"])
        self.assertGreaterEqual(stopped, 2)


class Shapes(ProgramTest):
    def test_every_shape_is_written_and_found_sound(self):
        listed = [shape["name"] for shape in self.run_json("shapes")["shapes"]]
        for name in ("sheet", "disk", "torus", "cylinder", "sphere", "cone", "box", "rod", "double_torus", "knot",
                     "genus20", "mannequin", "tshirt", "skirt"):
            self.assertIn(name, listed)
        for name in listed:
            self.run_weft("shapes", name, "-o", f"{name}.ply")
            found = self.run_json("inspect", f"{name}.ply")
            self.assertEqual(found["nonmanifold_edges"], 0, name)
            self.assertEqual(found["input"]["repairs"], [], name)

    def test_help_of_every_command_shows_an_example(self):
        for command in ("convert", "rebuild", "inspect", "simulate", "drape", "render", "shapes", "demo"):
            self.assertIn("Example: weft " + command, self.run_weft(command, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
