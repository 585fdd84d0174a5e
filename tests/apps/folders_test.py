"""What is in the folder of a run: nothing of another one, nothing of one that was refused, and on a full disk what tells of it."""
import os
import resource
import shutil
import signal
import subprocess
import unittest

from program import PROGRAM, ProgramTest
from scenes import SceneTest, sheet_scene

ALL_FORMATS = "obj,pc2,mdd,glb,ply,vtp,exr,usda"


class Leftovers(SceneTest):
    def listing(self, folder):
        return sorted(str(path.relative_to(self.folder / folder)) for path in (self.folder / folder).rglob("*"))

    def test_files_of_an_earlier_run_that_are_not_asked_for_again_go(self):
        scene = self.write_scene(sheet_scene(frames=2))
        other = self.write_scene(sheet_scene(frames=2, cloths=[{"name": "other", "surface": "builtin:sheet", "size": 9}]),
                                 "other.json")
        self.run_weft("simulate", scene, "-o", "run", "--export", ALL_FORMATS)
        for name in ("note.txt", "sheet_ply/note.txt", "sheet.fbx"):
            (self.folder / "run" / name).write_text("mine")
        self.run_weft("simulate", other, "-o", "run", "--export", "glb")
        self.run_weft("simulate", scene, "-o", "run", "--export", "mdd")
        self.run_weft("simulate", scene, "-o", "fresh", "--export", "mdd")
        mine = ["note.txt", "sheet_ply", "sheet_ply/note.txt", "sheet.fbx", "other.exr"]
        self.assertEqual(self.listing("run"), sorted(self.listing("fresh") + mine))

    def test_what_the_scene_is_made_of_stays(self):
        self.run_weft("simulate", self.write_scene(sheet_scene(frames=2)), "-o", "run")
        self.write_scene(sheet_scene(frames=2, cloths=[{"name": "again", "surface": "sheet.obj", "size": 9}]), "run/again.json")
        self.run_weft("simulate", "run/again.json", "-o", "run")
        self.assertTrue((self.folder / "run/sheet.obj").exists())
        self.assertFalse((self.folder / "run/sheet.pc2").exists())

    def test_names_with_folders_in_them_are_not_believed(self):
        scene = self.write_scene(sheet_scene(frames=1))
        self.run_weft("simulate", scene, "-o", "run")
        (self.folder / "precious.obj").write_text("mine")
        caches = self.folder / "run/caches.json"
        caches.write_text(caches.read_text().replace("sheet.obj", "../precious.obj"))
        self.run_weft("simulate", scene, "-o", "run", "--export", "pc2")
        self.assertTrue((self.folder / "precious.obj").exists())
        for text in ("", "{", "[]", '{"surfaces": 3}', '{"surfaces": [{"files": [{"path": 7}]}]}'):
            caches.write_text(text)
            self.run_weft("simulate", scene, "-o", "run")

    def test_refused_runs_leave_no_folder(self):
        sheet = {"name": "sheet", "surface": "builtin:sheet", "size": 9}
        for scene in (sheet_scene(cloths=[]), sheet_scene(cloths=[{**sheet, "surface": "missing.obj"}]),
                      sheet_scene(cloths=[sheet], bodies=[{"surface": "missing.obj"}])):
            self.write_scene(scene)
            self.error_of("simulate", "scene.json", "-o", "deep/er/run", code=3)
            self.assertEqual(self.listing("."), ["scene.json"])
        self.error_of("drape", "builtin:sheet", "missing.obj", "-o", "run/", code=3)
        self.assertEqual(self.listing("."), ["scene.json"])
        (self.folder / "mine").mkdir()
        self.error_of("simulate", "scene.json", "-o", "mine/run", code=3)
        self.assertEqual(self.listing("."), ["mine", "scene.json"])


class Inputs(SceneTest):
    """What a command reads stays as it is, whatever else is in the folder that it writes to."""

    def refused(self, *words):
        files = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        line = self.error_of(*words, code=3)
        self.assertIn("would be overwritten, and is read here", line)
        self.assertEqual(files, {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()})
        return line

    def test_runs_do_not_overwrite_what_their_scene_is_made_of(self):
        self.run_weft("shapes", "disk", "-o", "sheet.obj")
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        cloth = {"name": "sheet", "surface": "sheet.obj", "size": 9}
        self.write_scene(sheet_scene(frames=1, cloths=[cloth]))
        self.assertIn("sheet.obj", self.refused("simulate", "scene.json", "-o", "."))
        self.run_weft("simulate", "scene.json", "-o", ".", "--export", "pc2")
        self.run_weft("simulate", "scene.json", "-o", "elsewhere")
        (self.folder / "linked").symlink_to(self.folder)
        self.refused("simulate", "scene.json", "-o", "linked")
        image = {"name": "sheet", "surface": "sheet.exr", "size": 9}
        self.write_scene(sheet_scene(frames=1, cloths=[image]))
        self.assertIn("sheet.exr", self.refused("simulate", "scene.json", "-o", ".", "--export", "pc2"))
        other = {"name": "cloth", "surface": "builtin:sheet", "size": 9}
        self.write_scene(sheet_scene(frames=1, cloths=[other], bodies=[{"name": "ball", "surface": "ball.obj", "size": 9}]))
        self.assertIn("ball.obj", self.refused("simulate", "scene.json", "-o", "."))
        self.write_scene(sheet_scene(frames=1, cloths=[other]), "caches.json")
        self.assertIn("caches.json", self.refused("simulate", "caches.json", "-o", "."))

    def test_drapes_and_pictures_do_not_overwrite_their_subjects(self):
        self.run_weft("shapes", "disk", "-o", "cloth.obj")
        self.run_weft("shapes", "sphere", "-o", "body.obj")
        self.refused("drape", "cloth.obj", "builtin:sphere", "-o", ".", "--frames", "1")
        self.refused("drape", "builtin:sheet", "body.obj", "-o", ".", "--frames", "1")
        self.run_weft("convert", "body.obj", "-o", "body.png", "--size", "33")
        self.refused("render", "body.png", "-o", "body.png")


class FullDisk(SceneTest):
    def test_run_on_a_full_disk_tells_of_the_frames_that_are_there(self):
        self.write_scene(sheet_scene(frames=300))
        small = "mount -t tmpfs -o size=1000k none disk && "
        if subprocess.run(["unshare", "-rm", "sh", "-c", small + "true"], cwd=self.folder, capture_output=True,
                          preexec_fn=lambda: os.makedirs(self.folder / "disk", exist_ok=True)).returncode != 0:
            self.skipTest("no file system of a size of its own can be mounted here")
        script = (f"{small} {PROGRAM} simulate scene.json -o disk/run --checkpoint 50; code=$?; "
                  f"cp -r disk/run run; exit $code")
        done = subprocess.run(["unshare", "-rm", "sh", "-c", script], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        frames = len(self.table("run"))
        self.assertGreater(frames, 50)
        self.assertLess(frames, 300)
        self.assertEqual((self.folder / "run/sheet.pc2").stat().st_size, 32 + (frames + 1) * 289 * 12)
        self.run_weft("render", "run", "-o", "last.png", "--width", 64, "--height", 64, "--frame", frames)
        self.run_weft("simulate", "scene.json", "-o", "run", "--resume")
        self.assertEqual(len(self.table("run")), 300)

    def test_every_line_about_a_full_disk_says_what_is_wanted(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (400, 400))

        self.run_weft("simulate", self.write_scene(sheet_scene(frames=2)), "-o", "run")
        small = ("--width", 64, "--height", 64)
        ways = [("convert", "builtin:torus", "--size", 9, "-o", "x.exr"), ("convert", "builtin:torus", "--size", 9, "-o", "x.png"),
                ("shapes", "torus", "-o", "x.obj"), ("render", "run", "-o", "x.png", *small)]
        if shutil.which("ffmpeg"):
            ways.append(("render", "run", "-o", "x.gif", *small))
        before = sorted(self.folder.rglob("*"))
        for words in ways:
            with self.subTest(words):
                done = self.run_weft(*words, code=3, preexec_fn=small_files)
                self.assertRegex(done.stderr, r"\Aweft: error: x\.\w+: .+; .+ wanted\n\Z")
                self.assertNotIn(".part", done.stderr)
                self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_standard_output_without_room_is_told(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "shapes"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"\Aweft: error: stdout: .+; .+ wanted\n\Z")


class Unreadable(ProgramTest):
    def test_folders_that_may_not_be_looked_into_are_named(self):
        closed = self.folder / "closed"
        closed.mkdir(mode=0)
        self.addCleanup(closed.chmod, 0o700)
        if os.access(closed, os.R_OK):
            self.folder.chmod(0o777)
            as_nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
            if not shutil.which("setpriv") or subprocess.run([*as_nobody, PROGRAM, "--version"]).returncode != 0:
                self.skipTest("this user may read everything")
        else:
            as_nobody = []
        for words in (["render", "closed", "-o", "x.png"], ["render", "closed/a.exr", "-o", "x.png"],
                      ["inspect", "closed/a.obj"]):
            done = subprocess.run([*as_nobody, PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertRegex(done.stderr, r"\Aweft: error: closed\S*: .*Permission denied; .+ wanted\n\Z")


if __name__ == "__main__":
    unittest.main()
