"""Checkpoints and --resume of simulate and drape: kills, interruptions, damage, full disks."""
import json
import os
import random
import resource
import signal
import subprocess
import time
import unittest

from patterns import pattern_of_a_tube
from program import PROGRAM, ProgramTest

FILES = ("sheet.pc2", "ring.pc2", "sheet.obj", "ring.obj", "post.obj")
CHECKPOINT = "weft-checkpoint.bin"


def two_cloths(frames=60):
    """A sheet that hangs onto a post and a ring that falls to the ground, large enough to take a while."""
    return {"version": 1, "frames": frames, "integrator": {"type": "multigrid"},
            "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": 49, "translate": [0, 1, 0],
                        "pins": [{"image": [0, 0]}, {"image": [1, 0]}]},
                       {"name": "ring", "surface": "builtin:torus", "size": 49, "translate": [0, 0.2, 0]}],
            "bodies": [{"name": "post", "surface": "builtin:torus", "size": 17, "scale": 0.5, "translate": [0, 0.8, 0]}]}


class ResumeTest(ProgramTest):
    def write_scene(self, scene, name="scene.json"):
        (self.folder / name).write_text(json.dumps(scene))
        return name

    def start(self, *words, command=("simulate", "scene.json")):
        command = [PROGRAM, *command, "-o", "run", *map(str, words)]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def stamp(self):
        """Changes with every checkpoint."""
        try:
            return (self.folder / "run" / CHECKPOINT).stat().st_mtime_ns
        except FileNotFoundError:
            return None

    def stop_after_checkpoint(self, process, sent, delay=0.0):
        before = self.stamp()
        while self.stamp() == before and process.poll() is None:
            time.sleep(0.001)
        time.sleep(delay)
        process.send_signal(sent)
        errors = process.communicate(timeout=60)[1]
        return process.returncode, errors

    def table(self, folder):
        """frames.csv without its times."""
        lines = (self.folder / folder / "frames.csv").read_text().splitlines()
        return [line.split(",")[:1] + line.split(",")[6:] for line in lines]

    def assert_same(self, report, wanted, folder="run", whole="whole", files=FILES):
        for key in set(wanted) - {"ms_per_frame", "peak_memory_mb", "outputs"}:
            self.assertEqual(report[key], wanted[key], key)
        self.assertEqual(self.table(folder), self.table(whole))
        for name in files:
            self.assertEqual((self.folder / folder / name).read_bytes(), (self.folder / whole / name).read_bytes(), name)
        self.assertEqual(sorted(os.listdir(self.folder / folder)), sorted(os.listdir(self.folder / whole)))


class Resume(ResumeTest):
    def test_run_killed_again_and_again_ends_in_the_same_bytes(self):
        scene = self.write_scene(two_cloths())
        wanted = self.run_json("simulate", scene, "-o", "whole")
        moments = random.Random(11)
        kills = 0
        for round in range(6):
            process = self.start("--resume", "--checkpoint", 2, "--threads", 1 + round % 2)
            # Up to the time of a few frames, so as to strike steps, writing of frames and of checkpoints.
            code, errors = self.stop_after_checkpoint(process, signal.SIGKILL, moments.uniform(0, 0.03))
            kills += code == -signal.SIGKILL
            self.assertIn(code, (0, -signal.SIGKILL), errors)
        self.assertGreaterEqual(kills, 4)
        self.assert_same(self.run_json("simulate", scene, "-o", "run", "--resume"), wanted)

    def test_killed_before_the_first_checkpoint_begins_again(self):
        scene = self.write_scene(two_cloths(10))
        wanted = self.run_json("simulate", scene, "-o", "whole")
        process = self.start("--checkpoint", 1000)
        while not (self.folder / "run/.ring.part.pc2").exists():
            time.sleep(0.001)
        process.kill()
        process.communicate()
        done = self.run_weft("simulate", scene, "-o", "run", "--resume", "--json")
        self.assertIn("nothing to resume", done.stderr)
        self.assert_same(json.loads(done.stdout), wanted)

    def test_interrupted_run_is_whole_and_goes_on(self):
        scene = self.write_scene(two_cloths())
        wanted = self.run_json("simulate", scene, "-o", "whole")
        code, errors = self.stop_after_checkpoint(self.start("--checkpoint", 3), signal.SIGINT)
        self.assertEqual((code, errors), (130, "weft: error: interrupted\n"))
        frames = len(self.table("run")) - 1
        self.assertGreaterEqual(frames, 3)
        self.assertEqual([name for name in os.listdir(self.folder / "run") if ".part" in name], [])
        self.run_weft("render", "run", "-o", "last.png", "--width", "64", "--height", "64")
        done = self.run_weft("simulate", scene, "-o", "run", "--resume", "--json")
        self.assertIn(f"resumed after frame {frames}\n", done.stderr)
        self.assert_same(json.loads(done.stdout), wanted)

    def test_finished_run_says_so_and_goes_on_with_more_frames(self):
        scene = self.write_scene(two_cloths(6))
        first = self.run_json("simulate", scene, "-o", "run")
        done = self.run_weft("simulate", scene, "-o", "run", "--resume", "--json")
        self.assertIn("finished already", done.stderr)
        self.assertEqual(dict(json.loads(done.stdout), peak_memory_mb=0), dict(first, peak_memory_mb=0))
        wanted = self.run_json("simulate", scene, "-o", "whole", "--frames", 9)
        self.assert_same(self.run_json("simulate", scene, "-o", "run", "--resume", "--frames", 9), wanted)

    def test_drape_resumes_and_keeps_the_scene_of_a_run_that_it_refuses(self):
        words = ["drape", "builtin:sheet", "builtin:torus", "-o", "d", "--frames", "3"]
        first = self.run_json(*words, "--size", 17)
        scene = (self.folder / "d/scene.json").read_bytes()
        self.assertIn("cloths/0/size", self.error_of(*words, "--size", 33, "--resume", code=3))
        self.assertEqual((self.folder / "d/scene.json").read_bytes(), scene)
        again = self.run_json(*words, "--size", 17, "--resume")
        self.assertEqual(dict(again, peak_memory_mb=0), dict(first, peak_memory_mb=0))

    def test_checkpoints_can_be_left_out(self):
        self.run_weft("simulate", self.write_scene(two_cloths(2)), "-o", "run", "--checkpoint", "0")
        self.assertNotIn(CHECKPOINT, os.listdir(self.folder / "run"))
        self.error_of("simulate", "scene.json", "-o", "run", "--checkpoint", "-1", code=2)


class Damage(ResumeTest):
    def refuse(self, *fragments, words=()):
        line = self.error_of("simulate", "scene.json", "-o", "run", "--resume", *words, code=3)
        for fragment in fragments:
            self.assertIn(fragment, line)

    def test_damaged_checkpoints_are_refused_by_name_and_the_files_stay(self):
        self.write_scene(two_cloths(2))
        self.run_weft("simulate", "scene.json", "-o", "run")
        path = self.folder / "run" / CHECKPOINT
        whole = path.read_bytes()
        cache = (self.folder / "run/sheet.pc2").read_bytes()
        places = [0, 8, 12, 20, 28, 36, 60, len(whole) // 3, len(whole) // 2, len(whole) - 1]
        damaged = [whole[:at] + bytes([whole[at] ^ 0x10]) + whole[at + 1:] for at in places]
        damaged += [whole[:length] for length in (0, 7, 27, 1000, len(whole) - 1)] + [whole + b"\0"]
        for data in damaged:
            path.write_bytes(data)
            self.refuse(CHECKPOINT, "--resume")
            self.assertEqual(path.read_bytes(), data)
        self.assertEqual((self.folder / "run/sheet.pc2").read_bytes(), cache)
        path.write_bytes(whole)
        self.run_weft("simulate", "scene.json", "-o", "run", "--resume")

    def test_another_scene_is_refused_by_its_key(self):
        self.write_scene(two_cloths(2))
        self.run_weft("simulate", "scene.json", "-o", "run")
        self.refuse("integrator/type", "implicit", words=["--integrator", "implicit"])
        self.write_scene(dict(two_cloths(2), substeps=5))
        self.refuse("scene: substeps is 4 there and 5 here")
        self.write_scene(two_cloths(2))
        self.refuse("at least 2 frames", words=["--frames", "1"])

    def test_another_grain_is_another_cloth(self):
        """Also of a fabric that differs along warp and weft in bending alone."""
        side = 5
        place = "".join(f"v {i} 0 {j}\n" for j in range(side) for i in range(side))
        faces = "".join(f"f {a}/{a} {a + side}/{a + side} {a + side + 1}/{a + side + 1} {a + 1}/{a + 1}\n"
                        for j in range(side - 1) for a in range(side * j + 1, side * j + side))
        scene = {"version": 1, "frames": 2, "cloths": [{"surface": "sheet.obj", "size": 17, "translate": [0, 3, 0],
                                                        "material": {"bending": [1e-4, 1e-6]}}]}
        self.write_scene(scene)

        def write_sheet(turned):
            texture = "".join(f"vt {v} {u}\n" if turned else f"vt {u} {v}\n" for v in range(side) for u in range(side))
            (self.folder / "sheet.obj").write_text(place + texture + faces)
        write_sheet(False)
        self.run_weft("simulate", "scene.json", "-o", "run")
        self.run_weft("simulate", "scene.json", "-o", "run", "--resume", "--frames", "3")
        write_sheet(True)
        line = self.error_of("simulate", "scene.json", "-o", "run", "--resume", "--frames", "4", code=3)
        self.assertIn("surface", line)

    def test_folder_that_cannot_be_written_and_full_disk_end_with_one_line(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1_000_000, 1_000_000))

        self.write_scene(two_cloths(60))
        wanted = self.run_json("simulate", "scene.json", "-o", "whole")
        done = self.run_weft("simulate", "scene.json", "-o", "run", "--checkpoint", 7, code=3, preexec_fn=small_files)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("run/sheet.pc2: cannot be written whole", done.stderr)
        self.assert_same(self.run_json("simulate", "scene.json", "-o", "run", "--resume"), wanted)


class ResumeOfGarments(ResumeTest):
    def test_garment_killed_while_it_is_sewn_ends_in_the_same_bytes(self):
        (self.folder / "tube.json").write_text(json.dumps(pattern_of_a_tube()))
        garment = ("garment", "tube.json", "--body", "builtin:sphere", "--spacing", "15")
        wanted = self.run_json(*garment, "--frames", 30, "-o", "whole")
        for threads in (1, 2, 1):
            process = self.start("--frames", 30, "--resume", "--checkpoint", 2, "--threads", threads, command=garment)
            code, errors = self.stop_after_checkpoint(process, signal.SIGKILL)
            self.assertEqual(code, -signal.SIGKILL, errors)
        done = self.run_weft(*garment, "--frames", 30, "-o", "run", "--resume", "--json")
        resumed = int(done.stderr.split("resumed after frame ")[1].split()[0])
        self.assertLess(resumed, wanted["seams"]["frames"])
        self.assert_same(json.loads(done.stdout), wanted, files=("garment.pc2", "garment.image.pc2", "garment.draped.obj", "garment.panels.npz"))


if __name__ == "__main__":
    unittest.main()
