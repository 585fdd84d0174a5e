"""The contract of --export, --on, --unit and --up: files, counts, refusals, resuming; and of caches.json."""
import json
import os
import pathlib
import resource
import signal
import struct
import subprocess
import time
import unittest

import numpy

from patterns import pattern_of_a_tube
from program import PROGRAM, ProgramTest

ALL = "obj,pc2,mdd,glb,ply,vtp,exr,usda"


def scene(frames=4, size=17, **changes):
    cloths = [{"name": "shirt", "surface": "tube.obj", "size": size, "translate": [0, 0.5, 0]},
              {"name": "ring", "surface": "builtin:torus", "size": size, "translate": [0, 1.5, 0]}]
    bodies = [{"name": "post", "surface": "builtin:torus", "size": 17, "scale": 0.5,
               "motion": [{"time": 0}, {"time": 1, "rotate": [0, 90, 0]}]}]
    return {"version": 1, "frames": frames, "cloths": cloths, "bodies": bodies, **changes}


def tube(path, scale=1.0, z_up=False, lift=0.0):
    """An open tube of 12 x 7 vertices and 72 quads."""
    rows = [[(0.2 * x, lift + 0.1 * j, 0.2 * z) for x, z in
             [(1, 0), (0.8, -0.5), (0.5, -0.8), (0, -1), (-0.5, -0.8), (-0.8, -0.5),
              (-1, 0), (-0.8, 0.5), (-0.5, 0.8), (0, 1), (0.5, 0.8), (0.8, 0.5)]] for j in range(7)]
    points = [p for row in rows for p in row]
    if z_up:
        points = [(x, -z, y) for x, y, z in points]
    lines = ["v " + " ".join(f"{scale * c:.9g}" for c in p) for p in points]
    lines += [f"f {12 * j + i + 1} {12 * j + (i + 1) % 12 + 1} {12 * j + (i + 1) % 12 + 13} {12 * j + i + 13}"
              for j in range(6) for i in range(12)]
    path.write_text("\n".join(lines) + "\n")


def read_pc2(path):
    """A list of points for each frame."""
    data = path.read_bytes()
    points, frames = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    return [list(struct.iter_unpack("<3f", data[32 + 12 * points * k:32 + 12 * points * (k + 1)])) for k in range(frames)]


class ExportTest(ProgramTest):
    def setUp(self):
        super().setUp()
        tube(self.folder / "tube.obj")
        self.write_scene(scene())

    def write_scene(self, made, name="scene.json"):
        (self.folder / name).write_text(json.dumps(made))

    def simulate(self, folder, *words):
        return self.run_json("simulate", "scene.json", "-o", folder, *words)

    def files(self, folder):
        """Of every file the bytes, but for what holds times or is the checkpoint."""
        place = self.folder / folder
        return {str(path.relative_to(place)): path.read_bytes() for path in sorted(place.rglob("*"))
                if path.is_file() and path.name not in ("frames.csv", "weft-checkpoint.bin")}


class Exports(ExportTest):
    def test_every_format_is_written_and_listed(self):
        report = self.simulate("run", "--export", ALL)
        for path in report["outputs"]:
            self.assertTrue((self.folder / path).exists(), path)
        listed = json.loads((self.folder / "run/caches.json").read_text())
        self.assertEqual((listed["unit"], listed["up"], listed["frame_rate"]), ("m", "y", 60))
        self.assertEqual((listed["first_frame"], listed["last_frame"], listed["frames"]), (0, 4, 5))
        surfaces = {surface["name"]: surface for surface in listed["surfaces"]}
        self.assertEqual([(s["kind"], s["moves"]) for s in surfaces.values()], [("cloth", True), ("cloth", True), ("body", True)])
        shirt = {file["path"]: file for file in surfaces["shirt"]["files"]}
        self.assertEqual(set(shirt), {"shirt.obj", "shirt.pc2", "shirt.image.pc2", "shirt.mdd", "shirt.glb", "shirt_ply",
                                      "shirt_vtp", "shirt.pvd", "shirt_exr", "shirt.usda"})
        # What artists open has their 84 vertices, what others do has the samples.
        for name in ("shirt.obj", "shirt.pc2", "shirt.mdd", "shirt.glb"):
            self.assertEqual((shirt[name]["on"], shirt[name]["vertices"]), ("input", 84), name)
        for name in ("shirt.image.pc2", "shirt_ply", "shirt_vtp", "shirt_exr", "shirt.usda"):
            self.assertEqual(shirt[name]["on"], "image", name)
            self.assertGreater(shirt[name]["vertices"], 200)
        for kind in ("ply", "vtp", "exr"):
            names = sorted(os.listdir(self.folder / f"run/shirt_{kind}"))
            self.assertEqual(names, [f"shirt_{k:04}.{kind}" for k in range(5)])

    def test_formats_made_at_the_end_bring_the_cache_that_they_are_made_of(self):
        self.simulate("run", "--export", "glb")
        names = set(os.listdir(self.folder / "run"))
        self.assertLessEqual({"shirt.glb", "shirt.pc2", "shirt.image.pc2", "ring.glb", "ring.pc2", "post.glb"}, names)
        self.assertNotIn("shirt.obj", names)
        self.simulate("still", "--export", "obj")
        self.assertEqual([name for name in os.listdir(self.folder / "still") if name.endswith(".pc2")], [])

    def test_pictures_are_drawn_from_the_samples_whatever_is_exported(self):
        self.simulate("run", "--export", "glb", "--unit", "cm", "--up", "z")
        self.run_weft("render", "run", "-o", "run.png", "--width", "96", "--height", "64")
        self.assertGreater((self.folder / "run.png").stat().st_size, 500)

    def test_unknown_and_impossible_words_are_told(self):
        self.error_of("simulate", "scene.json", "-o", "run", "--export", "fbx", code=2)
        self.error_of("simulate", "scene.json", "-o", "run", "--on", "mesh", code=2)
        self.error_of("simulate", "scene.json", "-o", "run", "--unit", "ft", code=2)
        self.assertIn("--unwelded", self.error_of("simulate", "scene.json", "-o", "run", "--on", "input", "--unwelded", code=2))
        self.run_weft("convert", "tube.obj", "-o", "tube.exr", "--size", "17")
        made = scene()
        made["cloths"][0]["surface"] = "tube.exr"
        self.write_scene(made)
        line = self.error_of("simulate", "scene.json", "-o", "run", "--on", "input", code=2)
        self.assertIn("tube.exr, which holds no mesh; the mesh that it was made from in its place, or --on image", line)
        self.write_scene(scene(unit="furlong"))
        self.assertIn("scene.json:unit: 'furlong'; m, cm, mm or in is wanted",
                      self.error_of("simulate", "scene.json", "-o", "run", code=3))
        self.write_scene(scene(up="x"))
        self.assertIn("scene.json:up: 'x'", self.error_of("simulate", "scene.json", "-o", "run", code=3))
        self.assertFalse((self.folder / "run").exists())

    def test_frame_zero_is_the_users_mesh_in_the_users_unit(self):
        still = scene(frames=1)
        still["cloths"] = [{"name": "shirt", "surface": "tube.obj", "size": 17}]
        for unit, metres, up in (("m", 1, "y"), ("cm", 0.01, "z"), ("in", 0.0254, "z"), ("mm", 0.001, "y")):
            tube(self.folder / "tube.obj", 1 / metres, up == "z")
            self.write_scene(dict(still, unit=unit, up=up))
            self.simulate(unit)
            wanted = [tuple(map(float, line.split()[1:])) for line in (self.folder / "tube.obj").read_text().splitlines()
                      if line.startswith("v ")]
            found = read_pc2(self.folder / unit / "shirt.pc2")[0]
            self.assertEqual(found, [struct.unpack("3f", struct.pack("3f", *p)) for p in wanted], unit)

    def test_drape_reads_and_writes_the_unit_and_its_scene_does_too(self):
        tube(self.folder / "cm.obj", 100, z_up=True, lift=3)
        words = ["--size", "17", "--frames", "2", "--unit", "cm", "--up", "z"]
        first = self.run_json("drape", "cm.obj", "builtin:sphere", "-o", "draped", *words)
        again = self.run_json("simulate", "draped/scene.json", "-o", "again")
        self.assertEqual(first["state_hash"], again["state_hash"])
        heights = [p[2] for p in read_pc2(self.folder / "draped/cloth.pc2")[0]]
        self.assertAlmostEqual(min(heights), 102, delta=0.5)  # 2 cm above a body of 1 m, in cm with z up
        self.assertEqual((self.folder / "draped/cloth.pc2").read_bytes(), (self.folder / "again/cloth.pc2").read_bytes())


class ExportsGoOn(ExportTest):
    WORDS = ("--export", ALL, "--checkpoint", "2")

    def start(self):
        command = [PROGRAM, "simulate", "scene.json", "-o", "run", "--resume", *self.WORDS]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def stopped(self, sent):
        process = self.start()
        checkpoint = self.folder / "run/weft-checkpoint.bin"
        before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else None
        while process.poll() is None and (checkpoint.stat().st_mtime_ns if checkpoint.exists() else None) == before:
            time.sleep(0.001)
        process.send_signal(sent)
        errors = process.communicate(timeout=60)[1]
        return process.returncode, errors

    def test_killed_and_interrupted_runs_end_in_the_same_files(self):
        self.write_scene(scene(frames=16, size=33))
        self.simulate("whole", *self.WORDS)
        for sent in (signal.SIGKILL, signal.SIGINT, signal.SIGKILL):
            code, errors = self.stopped(sent)
            self.assertIn(code, (0, 130, -signal.SIGKILL), errors)
            if code == 130:
                self.assertEqual(errors, "weft: error: interrupted\n")
                self.assertEqual([name for name in os.listdir(self.folder / "run") if ".part" in name], [])
                # What was finished is whole, in every format.
                frames = json.loads((self.folder / "run/caches.json").read_text())["frames"]
                self.assertEqual(len(read_pc2(self.folder / "run/shirt.pc2")), frames)
                self.assertGreaterEqual(len(os.listdir(self.folder / "run/shirt_ply")), frames)
                self.assertTrue((self.folder / "run/shirt.glb").exists())
        self.simulate("run", "--resume", *self.WORDS)
        self.assertEqual(self.files("run"), self.files("whole"))

    def test_more_frames_go_on_and_lost_files_are_told(self):
        self.simulate("run", *self.WORDS)
        self.simulate("run", "--resume", "--frames", "6", *self.WORDS)
        self.simulate("whole", "--frames", "6", *self.WORDS)
        self.assertEqual(self.files("run"), self.files("whole"))
        (self.folder / "run/shirt_ply/shirt_0003.ply").unlink()
        line = self.error_of("simulate", "scene.json", "-o", "run", "--resume", "--frames", "7", *self.WORDS, code=3)
        self.assertIn("run/shirt_ply/shirt_0003.ply: is not there", line)
        self.assertIn("--on", self.error_of("simulate", "scene.json", "-o", "run", "--resume", "--frames", "7", "--on", "image",
                                            *self.WORDS, code=3))

    def test_a_shorter_run_leaves_no_frames_of_a_longer_one(self):
        self.simulate("run", "--export", "ply", "--frames", "6")
        self.simulate("run", "--export", "ply", "--frames", "2")
        self.assertEqual(len(os.listdir(self.folder / "run/shirt_ply")), 3)

    def on_small_disk(self, most, *words):
        """The one line of a run whose files may have so many bytes."""
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

        done = self.run_weft("simulate", "scene.json", "-o", "run", *words, code=3, preexec_fn=small_files)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("cannot be written whole", done.stderr)
        return done.stderr

    def test_file_that_is_made_at_the_end_and_finds_no_room_costs_nothing_else(self):
        words = ("--export", "pc2,glb")
        self.assertIn("run/ring.glb", self.on_small_disk(30_000, *words))
        self.assertEqual(len(read_pc2(self.folder / "run/post.pc2")), 5)
        self.simulate("run", "--resume", *words)
        self.simulate("whole", *words)
        self.assertEqual(self.files("run"), self.files("whole"))

    def test_full_disk_ends_with_one_line_and_whole_files(self):
        self.on_small_disk(60_000, "--frames", "20", *self.WORDS)
        frames = read_pc2(self.folder / "run/shirt.pc2")
        self.assertGreater(len(frames), 1)
        self.assertEqual({len(points) for points in frames}, {84})


class ExportsOfGarments(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "tube.json").write_text(json.dumps(pattern_of_a_tube()))
        self.words = ("garment", "tube.json", "--body", "builtin:sphere", "--spacing", "30", "--frames", "3")

    def test_panels_are_arrays_of_numpy(self):
        found = self.run_json(*self.words, "-o", "run")
        names = {pathlib.Path(path).name for path in found["outputs"]}
        self.assertLessEqual({"garment.obj", "garment.draped.obj", "garment.pc2", "garment.panels.exr", "garment.panels.npz"}, names)
        with numpy.load(self.folder / "run/garment.panels.npz") as arrays:
            self.assertEqual(sorted(arrays), ["back_left.pattern", "back_left.position", "front.pattern", "front.position"])
            flat, placed = arrays["front.pattern"], arrays["front.position"]
        groups = {line.split()[1] for line in (self.folder / "run/garment.obj").read_text().splitlines() if line.startswith("g ")}
        self.assertLessEqual({"back_left", "front"}, groups)
        self.assertEqual(flat.shape[:2], placed.shape[:2])
        self.assertEqual((flat.dtype, flat.shape[2], placed.shape[2]), (numpy.float32, 2, 3))
        numpy.testing.assert_allclose((flat.min(), flat[..., 0].max(), flat[..., 1].max()), (0, 30, 20), rtol=1e-6)
        last = read_pc2(self.folder / "run/garment.image.pc2")[-1]
        self.assertIn(tuple(placed[0, 0]), last)

    def test_open_seams_are_warned_of_and_meshes_are_no_patterns(self):
        said = self.run_weft(*self.words[:-1], "1", "-o", "run").stderr
        self.assertIn("seams are open", said)
        seams = self.run_json(*self.words[:-1], "1", "-o", "run")["seams"]
        self.assertEqual(len(seams["open"]), seams["count"] - seams["closed"])
        gaps = [seam["gap_mm"] for seam in seams["open"]]
        self.assertEqual(gaps, sorted(gaps, reverse=True))
        self.assertEqual(gaps[0], seams["largest_gap_mm"])
        self.assertEqual(seams["open"][0]["cloth"], "garment")
        self.assertIn(f"({seams['open'][0]['seam']} {gaps[0]:.2f}", said)
        self.assertIn("is no sewing pattern",
                      self.error_of("garment", "builtin:tshirt", "--body", "builtin:sphere", "-o", "mesh", code=3))

    def test_seams_that_are_too_narrow_are_warned_of(self):
        corners = [(x, y, z) for z in (-0.1, 0.1) for y in (0, 3) for x in (-0.09, 0.09)]
        faces = ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6))
        column = ["v {} {} {}".format(*corner) for corner in corners] + ["f {} {} {} {}".format(*face) for face in faces]
        (self.folder / "column.obj").write_text("\n".join(column) + "\n")
        done = self.run_weft("garment", "tube.json", "--body", "column.obj", "--spacing", "30", "--frames", "40",
                             "-o", "run", "--json")
        tight = json.loads(done.stdout)["seams"]["tight"]
        stretches = [seam["stretch_percent"] for seam in tight]
        self.assertEqual(stretches, sorted(stretches, reverse=True))
        self.assertGreater(stretches[-1], 10)
        self.assertEqual(tight[0]["cloth"], "garment")
        self.assertRegex(done.stderr, f"too narrow for what .* round .{tight[0]['seam']} {stretches[0]:.0f} %")

    def test_panels_of_few_samples_are_warned_of(self):
        words = ["160" if word == "30" else word for word in self.words]
        said = self.run_weft(*words, "-o", "run").stderr
        self.assertIn("2 of 2 panels are narrower than two spacings of samples, 160 mm each", said)

    def test_on_image_leaves_panels_apart(self):
        self.run_weft(*self.words, "-o", "sewn")
        self.run_weft(*self.words, "-o", "apart", "--on", "image")
        points = {run: len(read_pc2(self.folder / run / "garment.pc2")[0]) for run in ("sewn", "apart")}
        self.assertGreater(points["apart"], points["sewn"])
        self.assertFalse((self.folder / "apart/garment.image.pc2").exists())

    def test_resuming_a_finished_run_leaves_the_same_files(self):
        self.run_weft(*self.words, "-o", "run")
        once = {path.name: path.read_bytes() for path in (self.folder / "run").glob("garment.*")}
        self.run_weft(*self.words, "-o", "run", "--resume")
        again = {path.name: path.read_bytes() for path in (self.folder / "run").glob("garment.*")}
        self.assertEqual(once, again)


if __name__ == "__main__":
    unittest.main()
