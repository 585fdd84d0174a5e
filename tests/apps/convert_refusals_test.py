"""What convert and its sisters refuse, in one line, and that nothing is left then."""
import resource
import signal
import struct
import subprocess
import unittest

from program import PROGRAM, ProgramTest


class BadInput(ProgramTest):
    def refuse(self, name, content, *fragments, options=()):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        line = self.error_of("convert", name, "-o", "out.exr", *options, code=3)
        for fragment in (name, *fragments):
            self.assertIn(fragment, line)
        path.unlink()
        self.assert_nothing_left()

    def test_files_that_are_no_meshes(self):
        self.refuse("empty.obj", "")
        self.refuse("text.obj", "Dear reader,\nthis is not a mesh.\n")
        self.refuse("text.off", "Dear reader,\nthis is not a mesh.\n")
        self.refuse("text.ply", "Dear reader,\nthis is not a mesh.\n")
        self.refuse("text.stl", "Dear reader,\nthis is not a mesh.\n")
        self.refuse("text.glb", "Dear reader,\nthis is not a mesh.\n", "text.glb:1")
        self.refuse("text.gltf", "{}", "asset")
        self.refuse("mesh.xyz", "1 2 3\n")

    def test_broken_numbers_and_indices_name_the_line(self):
        self.refuse("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "range.obj:4")
        self.refuse("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:2")
        self.refuse("huge.off", "OFF\n3 1 0\n0 0 0\n1e300 0 0\n0 1 0\n3 0 1 2\n", "huge.off:4")
        self.refuse("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n")

    def test_counts_that_lie_are_not_believed(self):
        self.refuse("lie.stl", b"\0" * 80 + struct.pack("<I", 4_000_000_000) + b"\0" * 50)
        self.refuse("lie.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                    "property float x\nproperty float y\nproperty float z\n"
                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n")

    def test_surfaces_that_cannot_be_images(self):
        three_on_an_edge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n"
        self.refuse("fan.obj", three_on_an_edge, "non-manifold", "0", "1", options=("--charts", "1"))
        moebius = "".join(f"v {x} {y} {z}\n" for x, y, z in
                          ((1, 0, 0), (1, 0, 1), (-1, 1, 0), (-1, 1, 1), (-1, -1, 0), (-1, -1, 1)))
        moebius += "f 1 3 2\nf 2 3 4\nf 3 5 4\nf 4 5 6\nf 5 2 6\nf 6 2 1\n"
        self.refuse("moebius.obj", moebius, "orient", options=("--charts", "1"))

    def test_places_that_cannot_be_read_or_written(self):
        self.assertIn("none.obj", self.error_of("convert", "none.obj", "-o", "m.exr", code=3))
        self.assertIn("folder", self.error_of("convert", self.folder, "-o", "m.exr", code=3))
        line = self.error_of("convert", "builtin:sphere", "-o", "no/such/m.exr", code=3)
        self.assertIn("no/such/m.exr", line)
        self.assert_nothing_left()

    def test_size_too_small_for_the_cut_names_the_least(self):
        mesh = self.shared_mesh("cgal_turbine.off")
        line = self.error_of("convert", mesh, "-o", "m.exr", "--size", "9", code=3)
        self.assertRegex(line, r"n = \d+|size \d+|at least \d+")

    def test_usage_errors_are_one_line_with_exit_2(self):
        self.assertIn("--sise", self.error_of("convert", "builtin:sphere", "-o", "m.exr", "--sise", "9", code=2))
        self.error_of("convert", "builtin:sphere", code=2)
        self.error_of("unknown", code=2)
        self.assertIn("sphere", self.error_of("convert", "builtin:spher", "-o", "m.exr", code=2))
        self.assertIn(".exr", self.error_of("convert", "builtin:sphere", "-o", "m.jpg", code=2))
        self.assert_nothing_left()

    def test_a_missing_or_unknown_command_is_named(self):
        self.assertIn("'draw'", self.error_of("draw", "me", code=2))
        self.assertIn("convert, rebuild", self.error_of(code=2))

    def test_numbers_that_an_option_does_not_take_are_named(self):
        for seed in ("-1", "1.5", "1" + 20 * "0"):
            self.assertIn("a whole number from 0", self.error_of("shapes", "--seed", seed, code=2))
        for error in ("0", "-1", "nan", "1e-400"):
            line = self.error_of("convert", "builtin:sphere", "-o", "m.weft", "--error", error, code=2)
            self.assertIn("a number above 0 is wanted", line)
        line = self.error_of("convert", "builtin:sphere", "-o", "m.exr", "--seed-triangle", "-1", code=2)
        self.assertLess(len(line), 120)

    def test_no_option_takes_what_is_no_finite_number(self):
        for words in (["convert", "builtin:sphere", "-o", "m.weft", "--error"], ["render", "none", "-o", "m.png", "--azimuth"],
                      ["render", "none", "-o", "m.png", "--elevation"], ["render", "none", "-o", "m.png", "--show", "strain", "--full-strain"],
                      ["garment", "none.json", "--body", "builtin:sphere", "-o", "run", "--spacing"],
                      ["fabric", "--bending", "3", "--mass"], ["fabric", "--mass", "9", "--drape"],
                      ["fabric", "--mass", "9", "--bending"], ["fabric", "--mass", "9", "--length"]):
            for number in ("nan", "NaN", "inf", "-inf", "1e400", "-1e400", "3x"):
                with self.subTest(words=words, number=number):
                    line = self.error_of(*words[:-1], f"{words[-1]}={number}", code=2)
                    self.assertIn(words[-1], line)
                    self.assertIn("wanted", line)
                    self.assertLess(len(line), 140)
        self.assert_nothing_left()

    def test_surfaces_without_area(self):
        self.refuse("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "area")
        self.refuse("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "area")

    def test_a_full_disk_leaves_what_was_there(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

        for name in ("m.exr", "m.png", "m.obj"):
            (self.folder / name).write_text("precious")
            words = ["shapes", "sphere"] if name == "m.obj" else ["convert", "builtin:sphere", "--size", "65"]
            done = self.run_weft(*words, "-o", name, code=3, preexec_fn=small_files)
            self.assertIn(name, done.stderr)
            self.assertEqual((self.folder / name).read_text(), "precious")
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_a_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "shapes"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertIn("stdout", done.stderr)

    def test_damaged_images_are_refused(self):
        self.run_weft("convert", "builtin:torus", "-o", "t.exr", "--size", "17")
        whole = (self.folder / "t.exr").read_bytes()
        (self.folder / "cut.exr").write_bytes(whole[: len(whole) // 2])
        self.assertIn("cut.exr", self.error_of("rebuild", "cut.exr", "-o", "t.obj", code=3))
        self.assertFalse((self.folder / "t.obj").exists())

    def test_truncated_shared_mesh(self):
        # Of an OBJ that ends among its faces nothing tells that there were more.
        for name, part in (("ode_torus.obj", 0.2), ("cgal_eight.off", 0.5)):
            whole = self.shared_mesh(name).read_bytes()
            (self.folder / name).write_bytes(whole[: int(part * len(whole))])
            self.error_of("convert", name, "-o", "m.exr", code=3)


if __name__ == "__main__":
    unittest.main()
