"""The contract of render: what can be shown of meshes and images, sizes of pictures, errors."""
import json
import struct
import subprocess
import unittest

from patterns import pattern_of_a_tube
from program import ProgramTest


class Render(ProgramTest):
    def size_of(self, name):
        head = (self.folder / name).read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        return struct.unpack(">II", head[16:24])

    def test_every_word_shows_a_mesh(self):
        for word in ("cut", "map", "stretch", "colours", "mates", "error"):
            self.run_weft("render", "builtin:torus", "-o", f"{word}.png", "--show", word, "--size", "33",
                          "--width", "160", "--height", "120")
        self.run_weft("render", "builtin:torus", "-o", "surface.png", "--show", "surface", "--width", "160",
                      "--height", "120")
        for word in ("cut", "stretch", "surface", "error"):
            self.assertEqual(self.size_of(f"{word}.png"), (160, 120), word)
        pictures = [(self.folder / f"{word}.png").read_bytes()
                    for word in ("cut", "map", "stretch", "colours", "surface", "mates", "error")]
        self.assertEqual(len(set(pictures)), 7)

    def test_every_word_shows_an_image(self):
        self.run_weft("convert", "builtin:torus", "-o", "t.exr", "--size", "33")
        for word in ("surface", "cut", "stretch", "mates"):
            self.run_weft("render", "t.exr", "-o", f"{word}.png", "--show", word, "--width", "160", "--height", "120")
        self.run_weft("render", "t.exr", "-o", "error.png", "--show", "error", "--against", "builtin:torus",
                      "--width", "160", "--height", "120")
        self.run_weft("render", "t.exr", "-o", "colours.png")
        self.assertEqual(self.size_of("colours.png"), (33 * 8, 33 * 8))
        self.run_weft("render", "t.exr", "-o", "small.png", "--width", "160", "--height", "120")
        self.assertEqual(self.size_of("small.png"), (33 * 4, 33 * 4))

    def colours_of(self, name):
        """How many pixels of a picture are clearly red, green, blue."""
        done = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", self.folder / name, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                              capture_output=True, check=True)
        pixels = zip(*[iter(done.stdout)] * 3)
        counts = [0, 0, 0]
        for pixel in pixels:
            for k in range(3):
                counts[k] += pixel[k] > 2 * max(pixel[k - 1], pixel[k - 2])
        return counts

    def test_images_are_drawn_in_their_colours(self):
        (self.folder / "painted.obj").write_text("v -1 0 0 1 0 0\nv 0 0 0 1 0 0\nv -1 1 0 1 0 0\nv 0 1 0 0 0 1\nv 1 0 0 0 0 1\n"
                                                 "v 1 1 0 0 0 1\nf 1 2 4 3\nf 2 5 6 4\n")
        for words, name in ((["--colours"], "painted"), ([], "plain")):
            self.run_weft("convert", "painted.obj", "-o", f"{name}.exr", "--size", "33", *words)
            self.run_weft("render", f"{name}.exr", "-o", f"{name}.png", "--show", "surface", "--width", "160", "--height", "120")
        red, green, blue = self.colours_of("painted.png")
        self.assertGreater(min(red, blue), 500)
        self.assertEqual(green, 0)
        self.assertEqual(self.colours_of("plain.png"), [0, 0, 0])

    def test_vertices_of_no_triangle_move_no_camera(self):
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        (self.folder / "stray.obj").write_text((self.folder / "ball.obj").read_text() + "v 100 100 100\n")
        for name in ("ball", "stray"):
            self.run_weft("render", f"{name}.obj", "-o", f"{name}.png", "--show", "surface", "--width", 96, "--height", 72)
        self.assertEqual((self.folder / "ball.png").read_bytes(), (self.folder / "stray.png").read_bytes())

    def test_the_same_words_give_the_same_bytes(self):
        for name in ("a.png", "b.png"):
            self.run_weft("render", "builtin:torus", "-o", name, "--width", "160", "--height", "120")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_turntable_is_a_movie(self):
        self.run_weft("render", "builtin:sphere", "-o", "t.gif", "--show", "surface", "--turntable", "--width", "64",
                      "--height", "64")
        self.assertEqual((self.folder / "t.gif").read_bytes()[:3], b"GIF")

    def frames_of(self, name):
        """Frames that a GIF holds."""
        done = subprocess.run(["ffprobe", "-loglevel", "error", "-count_frames", "-show_entries",
                               "stream=nb_read_frames", "-of", "csv=p=0", self.folder / name],
                              capture_output=True, text=True, check=True)
        return int(done.stdout)

    def movie_size(self, name):
        done = subprocess.run(["ffprobe", "-loglevel", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0",
                               self.folder / name], capture_output=True, text=True, check=True)
        return tuple(int(side) for side in done.stdout.strip().split(","))

    def make_tiny_run(self):
        (self.folder / "tiny.json").write_text('{"frames": 2, "cloths": [{"surface": "builtin:sheet", "size": 9}]}')
        self.run_weft("simulate", "tiny.json", "-o", "tiny")

    def test_odd_sizes_are_refused_of_an_mp4_alone(self):
        self.make_tiny_run()
        for width, height, option in ((101, 98, "--width"), (100, 99, "--height")):
            size = ["--width", width, "--height", height]
            error = self.error_of("render", "tiny", "-o", "m.mp4", *size, code=2)
            self.assertEqual(error, f"weft: error: {option}: {width if width % 2 else height} pixels of an .mp4; "
                                    "an even number, or a .gif, is wanted")
            self.assertFalse((self.folder / "m.mp4").exists())
        self.run_weft("render", "tiny", "-o", "m.gif", *size)
        self.assertEqual(self.movie_size("m.gif"), (100, 99))
        self.run_weft("render", "tiny", "-o", "m.png", *size)
        self.assertEqual(self.size_of("m.png"), (100, 99))

    def test_a_row_that_comes_out_odd_is_a_movie_of_an_even_size(self):
        self.make_tiny_run()
        size = ["--width", 321, "--height", 120]
        self.run_weft("render", "tiny", "tiny", "tiny", "-o", "odd.png", *size)
        self.assertEqual(self.size_of("odd.png"), (319, 120))  # 3 * 97 and two gaps of 14
        size[1] = 320
        self.run_weft("render", "tiny", "tiny", "tiny", "-o", "even.mp4", *size)
        self.assertEqual(self.movie_size("even.mp4"), (320, 120))

    def make_runs(self):
        for name, frames in (("short", 2), ("long", 5)):
            self.run_weft("drape", "builtin:sheet", "builtin:sphere", "-o", name, "--size", "17", "--frames", frames)

    def test_several_subjects_stand_side_by_side_with_their_names(self):
        self.make_runs()
        small = ["--width", "320", "--height", "160"]
        self.run_weft("render", "short", "long", "builtin:torus", "-o", "all.png", "--show", "surface", *small)
        self.assertEqual(self.size_of("all.png")[1], 160)
        self.assertIn(self.size_of("all.png")[0], range(316, 321))
        self.run_weft("render", "short", "long", "builtin:torus", "-o", "named.png", "--show", "surface", *small,
                      "--labels", "a,b,c")
        self.assertNotEqual((self.folder / "all.png").read_bytes(), (self.folder / "named.png").read_bytes())
        report = self.run_json("render", "short", "long", "-o", "two.gif", *small)
        self.assertEqual(report["inputs"], [{"path": "short"}, {"path": "long"}])
        self.assertEqual(report["input"], {"path": "short"})
        self.assertEqual(self.frames_of("two.gif"), 5)  # five sixtieths of a second, at fifty pictures a second

    def test_runs_are_coloured_by_strain(self):
        self.make_runs()
        small = ["--width", "160", "--height", "120"]
        for name, words in {"plain": [], "strain": ["--show", "strain"], "five": ["--show", "strain", "--full-strain", 5],
                            "six": ["--show", "strain", "--full-strain", 6]}.items():
            self.run_weft("render", "long", "-o", f"{name}.png", *words, *small)
            self.assertEqual(self.size_of(f"{name}.png"), (160, 120), name)
        self.assertEqual(len({(self.folder / f"{name}.png").read_bytes() for name in ("plain", "strain", "five", "six")}), 4)
        self.run_weft("render", "short", "long", "-o", "two.gif", "--show", "strain", *small)
        self.assertEqual(self.frames_of("two.gif"), 5)
        manifest = self.folder / "long/weft-run.json"
        told = json.loads(manifest.read_text())
        del told["cloths"][0]["rest"]  # as folders of before
        manifest.write_text(json.dumps(told))
        self.assertIn("rest shape was not recorded", self.error_of("render", "long", "-o", "p.png", "--show", "strain", code=2))
        self.run_weft("render", "long", "-o", "plain again.png", *small)
        self.assertEqual((self.folder / "plain.png").read_bytes(), (self.folder / "plain again.png").read_bytes())

    def test_a_turntable_of_a_run_plays_it_and_turns_for_four_seconds(self):
        (self.folder / "slow.json").write_text(
            '{"frame_rate": 10, "frames": 3, "cloths": [{"surface": "builtin:sheet", "size": 9}]}')
        self.run_weft("simulate", "slow.json", "-o", "slow")
        self.run_weft("render", "slow", "-o", "turn.gif", "--turntable", "--width", "64", "--height", "64")
        self.assertEqual(self.frames_of("turn.gif"), 40)

    def test_a_mesh_with_edges_of_three_triangles_is_drawn_with_its_cuts(self):
        (self.folder / "fan.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n")
        done = self.run_weft("render", "fan.obj", "-o", "fan.png", "--width", "160", "--height", "120")
        self.assertEqual(done.stderr, "")
        self.assertTrue((self.folder / "fan.png").exists())

    def test_far_from_the_origin_looks_as_near_it(self):
        self.run_weft("shapes", "box", "-o", "box.obj")
        lines = (self.folder / "box.obj").read_text().splitlines()
        moved = [f"v {float(line.split()[1]) + 2**20} {' '.join(line.split()[2:])}" if line.startswith("v ") else line for line in lines]
        (self.folder / "far.obj").write_text("\n".join(moved) + "\n")
        for name in ("box", "far"):
            self.run_weft("render", f"{name}.obj", "-o", f"{name}.png", "--show", "surface", "--width", 96, "--height", 72)
        self.assertEqual((self.folder / "box.png").read_bytes(), (self.folder / "far.png").read_bytes())

    def test_patterns_are_drawn_flat(self):
        (self.folder / "tube.json").write_text(json.dumps(pattern_of_a_tube()))
        self.run_weft("render", "tube.json", "-o", "tube.png", "--width", "320", "--height", "200")
        self.assertEqual(struct.unpack(">II", (self.folder / "tube.png").read_bytes()[16:24]), (320, 200))
        self.run_weft("render", "tube.json", "builtin:torus", "-o", "both.png")
        self.assertIn("--show", self.error_of("render", "tube.json", "-o", "p.png", "--show", "surface", code=2))
        self.assertIn("flat", self.error_of("render", "tube.json", "-o", "p.gif", "--turntable", code=2))
        (self.folder / "scene.json").write_text("{}")
        self.assertIn("scene.json", self.error_of("render", "scene.json", "-o", "p.png", code=3))

    def test_words_that_make_no_sense_together(self):
        self.run_weft("convert", "builtin:torus", "-o", "t.exr", "--size", "17")
        for words, fragment in (
                (["t.exr", "-o", "p.png", "--show", "map"], "colours, surface"),
                (["t.exr", "-o", "p.png", "--show", "error"], "--against"),
                (["t.exr", "-o", "p.png", "--show", "surface", "--size", "33"], "--size"),
                (["t.exr", "-o", "p.png", "--against", "builtin:torus"], "--against"),
                (["t.exr", "-o", "p.mp4"], "--turntable"),
                (["t.exr", "-o", "p.mp4", "--turntable"], "flat"),
                (["t.exr", "-o", "p.png", "--turntable"], ".mp4"),
                (["t.exr", "-o", "p.png", "--frame", "3"], "--frame"),
                (["builtin:torus", "-o", "p.png", "--labels", "one,two"], "1 are wanted"),
                (["builtin:torus", "builtin:box", "builtin:rod", "-o", "p.png", "--width", "64"], "--width"),
                (["builtin:torus", "-o", "p.png", "--show", "surface", "--size", "33"], "--size"),
                (["builtin:torus", "-o", "p.png", "--show", "cut", "--parameterizer", "floater"], "--parameterizer"),
                (["builtin:torus", "-o", "p.png", "--show", "run"], "cut, map"),
                (["builtin:torus", "-o", "p.png", "--show", "strain"], "no folder of a run"),
                (["nowhere", "-o", "p.png", "--show", "strain"], "no folder of a run"),
                (["builtin:torus", "-o", "p.png", "--full-strain", "5"], "--show strain"),
                (["builtin:torus", "-o", "p.png", "--show", "cats"], "--show")):
            with self.subTest(words):
                self.assertIn(fragment, self.error_of("render", *words, code=2))
        self.assertFalse((self.folder / "p.png").exists() or (self.folder / "p.mp4").exists())


if __name__ == "__main__":
    unittest.main()
