"""Scenes that are refused, draped ones and their pictures, and the examples."""
import json
import resource
import signal
import subprocess
import sys
import unittest

from program import PROGRAM, ProgramTest, SOURCE
from scenes import SceneTest, sheet_scene


class BadScenes(SceneTest):
    def refuse(self, scene, *fragments):
        line = self.error_of("simulate", self.write_scene(scene), "-o", "run", code=3)
        for fragment in ("scene.json", *fragments):
            self.assertIn(fragment, line)

    def test_unknown_keys_name_their_neighbour(self):
        self.refuse(sheet_scene(framez=3), "framez", "frames")
        scene = sheet_scene()
        scene["cloths"][0]["materail"] = "cotton"
        self.refuse(scene, "materail", "material")

    def test_wrong_types_and_ranges_name_the_key(self):
        self.refuse(sheet_scene(frames="many"), "frames")
        self.refuse(sheet_scene(substeps=0), "substeps")
        self.refuse(sheet_scene(gravity=[0, 1]), "gravity")
        self.refuse(sheet_scene(integrator={"type": "implicitt"}), "implicit")
        self.refuse(sheet_scene(version=99), "version")

    def test_what_is_not_json_names_the_line(self):
        self.refuse('{ "version": 1,\n  "frames": }\n', "scene.json:2")
        self.refuse("")

    def test_cloth_without_area_is_named_with_its_scene(self):
        scene = sheet_scene()
        scene["cloths"][0]["scale"] = [1, 1, 1e-200]
        self.refuse(scene, "'sheet': ", "a rest shape without area", "; a surface, not a point or a curve, is wanted")

    def test_missing_surfaces_are_named(self):
        scene = sheet_scene()
        scene["cloths"][0]["surface"] = "none.obj"
        line = self.error_of("simulate", self.write_scene(scene), "-o", "run", code=3)
        self.assertIn("none.obj", line)

    def test_builtin_shapes_that_do_not_exist_are_the_scenes_fault(self):
        scene = sheet_scene()
        scene["cloths"][0]["surface"] = "builtin:shet"
        self.refuse(scene, "sheet", "builtin:shet")

    def test_names_whose_files_would_meet_are_refused(self):
        ball = {"name": "ball", "surface": "builtin:sphere", "size": 17}
        scene = sheet_scene(bodies=[ball])
        scene["cloths"][0]["name"] = "ball.normals"
        self.refuse(scene, "ball.normals")
        for name in ("ball", "../ball", "a/b", "..", ""):
            scene["cloths"][0]["name"] = name
            self.refuse(scene, "name")

    def test_numbers_beyond_doubles_are_refused(self):
        self.refuse('{"frame_rate": 1e999}', "number")

    def test_folders_that_cannot_be_made(self):
        (self.folder / "file").write_text("")
        scene = self.write_scene(sheet_scene())
        for words in (["simulate", scene], ["drape", "builtin:sheet", "builtin:sphere"], ["demo"]):
            for folder in ("file", "file/below"):
                self.assertIn(folder, self.error_of(*words, "-o", folder, code=3))

    def test_explicit_instability_names_frame_cloth_particle_and_a_step(self):
        scene = sheet_scene(frames=60, integrator={"type": "explicit", "limiter_passes": 0}, substeps=1)
        scene["cloths"][0].update(pins=[{"image": [0, 0]}], material={"stretch": 1e6, "strain_limit": 0})
        caution, error = self.run_weft("simulate", self.write_scene(scene), "-o", "run", code=3).stderr.splitlines()
        self.assertIn("may tremble or run away", caution)
        for word in ("weft: error", "frame", "sheet", "particle", "step"):
            self.assertIn(word, error)


class DrapeAndRender(ProgramTest):
    def test_drape_makes_a_scene_that_runs_again_to_the_same_hash(self):
        draped = self.run_json("drape", "builtin:sheet", "builtin:sphere", "-o", "a", "--size", "33", "--frames", "20")
        self.assertIn("a/scene.json", draped["outputs"])
        again = self.run_json("simulate", "a/scene.json", "-o", "b")
        self.assertEqual(draped["state_hash"], again["state_hash"])
        self.assertGreater(draped["contacts_max"], 0)

    def test_closed_cloth_is_one_particle_a_surface_point(self):
        draped = self.run_json("drape", "builtin:torus", "builtin:sphere", "-o", "t", "--size", "33", "--frames", "5")
        self.assertEqual(draped["particles"], 32 * 32)

    def test_run_becomes_picture_and_movie(self):
        self.run_weft("drape", "builtin:sheet", "builtin:sphere", "-o", "a", "--size", "17", "--frames", "3")
        self.run_weft("render", "a", "-o", "a.png", "--width", "160", "--height", "120")
        self.assertEqual((self.folder / "a.png").read_bytes()[1:4], b"PNG")
        self.run_weft("render", "a", "-o", "a.mp4", "--width", "160", "--height", "120")
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames",
                                "-of", "csv=p=0", self.folder / "a.mp4"], capture_output=True, text=True)
        self.assertEqual(probe.stdout.strip(), "4")

    def test_a_movie_that_does_not_fit_is_refused(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

        self.run_weft("drape", "builtin:sheet", "builtin:sphere", "-o", "a", "--size", "17", "--frames", "3")
        for ending in ("mp4", "gif", "png"):
            done = self.run_weft("render", "a", "-o", f"a.{ending}", "--width", 160, "--height", 120, code=3, preexec_fn=small_files)
            self.assertIn(f"a.{ending}", done.stderr)
            self.assertFalse((self.folder / f"a.{ending}").exists())

    def test_rendering_what_is_no_run_is_refused(self):
        (self.folder / "empty").mkdir()
        self.assertIn("empty", self.error_of("render", "empty", "-o", "a.png", code=3))
        self.error_of("render", "builtin:sphere", "-o", "a.mp4", code=2)


class Examples(ProgramTest):
    def scenes(self):
        """Those of the repository, at a size that tests have time for; what is generated lies beside them."""
        for path in sorted((SOURCE / "examples/scenes").glob("*.json")):
            scene = json.loads(path.read_text())
            if "walk.pc2" in path.read_text():
                subprocess.run([sys.executable, SOURCE / "examples/walk.py", self.folder / "walk.pc2", "--weft", PROGRAM],
                               check=True)
            if "figure.glb" in path.read_text():
                subprocess.run([sys.executable, SOURCE / "examples/make_walker.py", self.folder / "figure.glb", "--weft", PROGRAM],
                               check=True)
            for part in scene["cloths"] + scene.get("bodies", []):
                if part["surface"].endswith(".json"):
                    part["surface"] = str(path.parent / part["surface"])
                    part["sew"] = {"spacing": 0.03}
                    continue
                part["size"] = 33
                if "animation" not in part:
                    part["surface"] = self.image_of(part["surface"])
            copy = self.folder / path.name
            copy.write_text(json.dumps(scene))
            yield copy

    def image_of(self, surface):
        """Converted once for all scenes that have it."""
        image = self.folder / f"{surface.removeprefix('builtin:')}.exr"
        if not image.exists():
            self.run_weft("convert", surface, "-o", image, "--size", "33")
        return str(image)

    def test_no_example_scene_passes_through_a_body_or_the_ground(self):
        names = []
        for path in self.scenes():
            names.append(path.stem)
            with self.subTest(path.name):
                report = self.run_json("simulate", path, "-o", path.stem, "--frames", "2")
                self.assertEqual(report["frames"], 2)
                found = report["intersections_found"]
                self.assertEqual((found["bodies"], found["ground"]), (0, 0))
        self.assertGreaterEqual(len(names), 20)


if __name__ == "__main__":
    unittest.main()
