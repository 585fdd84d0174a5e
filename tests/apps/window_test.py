"""weft view in a real window of a virtual display, driven by real mouse and key events.

Nothing here waits for a time: what must happen is waited for, as long as it takes on a slow machine.
"""
import json
import os
import select
import shutil
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest

WIDTH, HEIGHT = 480, 360
LONGEST = 120  # seconds that anything may take

LYING_SHEET = {"version": 1, "substeps": 2, "cloths": [
    {"surface": "builtin:sheet", "size": 33, "translate": [0, 0.03, 0], "material": "cotton"}]}
CURTAIN = {"version": 1, "substeps": 2, "ground": None, "cloths": [
    {"surface": "builtin:sheet", "size": 33, "rotate": [90, 0, 0], "translate": [0, 1, 0], "material": "cotton",
     "pins": [{"image": [0, 0]}, {"image": [1, 0]}]}]}
RUNAWAY = {"version": 1, "substeps": 1, "gravity": [3, -9.81, 0], "integrator": {"type": "explicit"},
           "cloths": [{"surface": "builtin:sheet", "size": 33, "translate": [0, 1, 0]}]}


class Display:
    """An X server that nobody sees."""

    def __init__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp"],
            pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        number = b""
        while not number.endswith(b"\n"):
            if not select.select([reading], [], [], LONGEST)[0]:
                raise AssertionError("Xvfb does not start")
            read = os.read(reading, 16)
            if not read:
                raise AssertionError("Xvfb ended")
            number += read
        os.close(reading)
        self.name = f":{number.decode().strip()}"

    def close(self):
        self.server.terminate()
        self.server.wait()


class Window(ProgramTest):
    @classmethod
    def setUpClass(cls):
        if os.environ.get("WEFT_SANITIZE"):
            raise unittest.SkipTest("the drivers of the display are not built for sanitizers")
        for tool in ("Xvfb", "xdotool"):
            if not shutil.which(tool):
                raise unittest.SkipTest(f"{tool} is not there")
        cls.display = Display()
        cls.addClassCleanup(cls.display.close)

    def setUp(self):
        super().setUp()
        self.environment = dict(os.environ, DISPLAY=self.display.name)
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.program = None
        self.addCleanup(self.end)

    def end(self):
        if self.program and self.program.poll() is None:
            self.program.kill()
            self.program.communicate()

    def start(self, subject, *words):
        if isinstance(subject, dict):
            (self.folder / "scene.json").write_text(json.dumps(subject))
            subject = "scene.json"
        (self.folder / "status.json").unlink(missing_ok=True)
        self.program = subprocess.Popen(
            [PROGRAM, "view", subject, "--json", "--width", str(WIDTH), "--height", str(HEIGHT),
             "--status", "status.json", *words],
            cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.wait_for(lambda now: now["subject"] > 0 or now["error"])
        self.xdo("mousemove", "470", "10")

    def xdo(self, *words):
        subprocess.run(["xdotool", *[str(word) for word in words]], env=self.environment, check=True, timeout=LONGEST)

    def now(self):
        try:
            return json.loads((self.folder / "status.json").read_text())
        except FileNotFoundError:
            return None

    def wait_for(self, condition):
        """What the window tells once that holds."""
        end = time.monotonic() + LONGEST
        while time.monotonic() < end:
            now = self.now()
            if now and condition(now):
                return now
            self.assertIsNone(self.program.poll(), "the window is gone")
            time.sleep(0.02)
        self.fail(f"that never came; last: {now}")

    def close(self):
        """Closes by Esc; the JSON at the end."""
        self.xdo("key", "Escape")
        out, err = self.program.communicate(timeout=LONGEST)
        self.assertEqual((self.program.returncode, err), (0, ""))
        return json.loads(out)

    def wait_for_picture(self, name):
        self.wait_for(lambda now: name in [path.removeprefix("./") for path in now["outputs"]])
        head = (self.folder / name).read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual((int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")), (WIDTH, HEIGHT))
        return (self.folder / name).read_bytes()

    def test_dragging_with_the_mouse_lifts_the_cloth(self):
        self.start(CURTAIN)
        self.xdo("key", "h")  # the panel covers most of so small a window
        self.xdo("key", "f")
        before = self.now()
        # Some pictures later the camera has come with the keys.
        hanging = self.wait_for(lambda now: now["frames"] > before["frames"] + 10 and now["simulated_frames"] > 30)
        x, y = (round(value) for value in hanging["middle"])
        self.assertTrue(0 < x < WIDTH and 0 < y < HEIGHT, hanging)
        rest = hanging["centre_of_mass"][1]
        self.xdo("mousemove", x, y, "mousedown", 1)
        for step in range(1, 11):
            self.xdo("mousemove", x, y - 8 * step)
        self.wait_for(lambda now: now["held"] and now["centre_of_mass"][1] > rest + 0.03)
        self.xdo("mouseup", 1)
        self.wait_for(lambda now: not now["held"])
        self.wait_for(lambda now: now["centre_of_mass"][1] < rest + 0.01)
        self.assertGreater(self.close()["frames"], 5)

    def test_space_pauses_a_period_steps_and_r_resets(self):
        self.start(LYING_SHEET)
        self.wait_for(lambda now: now["simulated_frames"] > 3)
        self.xdo("key", "space")
        paused = self.wait_for(lambda now: not now["running"])["simulated_frames"]
        self.xdo("key", "period")
        self.wait_for(lambda now: now["simulated_frames"] == paused + 1)
        self.xdo("key", "period", "key", "period")
        self.wait_for(lambda now: now["simulated_frames"] == paused + 3)
        self.xdo("key", "r")
        start = self.wait_for(lambda now: now["simulated_frames"] == 0)
        self.assertAlmostEqual(start["centre_of_mass"][1], 0.03, places=6)
        self.assertFalse(start["running"])
        self.xdo("key", "space")
        self.wait_for(lambda now: now["running"] and now["simulated_frames"] > 2)
        self.assertEqual(self.close()["error"], "")

    def test_s_writes_pictures_that_orbiting_and_the_panel_change(self):
        self.start("builtin:torus", "-o", ".")
        self.xdo("key", "s")
        first = self.wait_for_picture("weft-view-0001.png")
        self.xdo("key", "shift+s")
        self.assertTrue(self.wait_for_picture("weft-view-0002.png") != first)
        self.xdo("mousemove", 460, 20, "mousedown", 1, "mousemove", 400, 40, "mouseup", 1)
        self.xdo("key", "s")
        self.assertTrue(self.wait_for_picture("weft-view-0003.png") != first)
        ended = self.close()
        self.assertEqual(len(ended["outputs"]), 3)
        self.assertEqual(ended["window"], [WIDTH, HEIGHT])

    def test_what_goes_wrong_is_a_line_in_a_window_that_lives(self):
        self.start(RUNAWAY)
        error = self.wait_for(lambda now: now["error"])["error"]
        self.assertIn("ran away", error)
        self.xdo("key", "space", "key", "r")
        self.wait_for(lambda now: not now["error"] and now["simulated_frames"] == 0)
        self.close()
        self.start("missing.obj")
        self.assertIn("missing.obj", self.now()["error"])
        self.close()

    def run_to_its_end(self, *words):
        done = subprocess.run([PROGRAM, "view", *words, "--screenshot", "end.png", "--json"], cwd=self.folder,
                              env=self.environment, capture_output=True, text=True, timeout=LONGEST)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def test_windows_close_and_take_pictures_by_themselves(self):
        told = self.run_to_its_end("builtin:sheet", "--frames", "4")
        self.assertGreaterEqual(told["frames"], 4)
        self.assertEqual((told["stage"], told["message"]), ("", "opened builtin:sheet"))
        (self.folder / "scene.json").write_text(json.dumps(LYING_SHEET))
        told = self.run_to_its_end("scene.json", "--until", "9")
        self.assertEqual(told["simulated_frames"], 9)
        self.run_weft("simulate", "scene.json", "-o", "run", "--frames", "5")
        self.assertEqual(self.run_to_its_end("run", "--until", "4")["simulated_frames"], 4)
        self.assertEqual(told["outputs"], ["end.png"])
        self.assertTrue((self.folder / "end.png").read_bytes().startswith(b"\x89PNG"))

    def test_what_cannot_be_shown_to_nobody_is_an_error(self):
        (self.folder / "cut.obj").write_text("v 0 0\n")
        for words in (["--frames", "2"], ["--until", "3"]):
            done = subprocess.run([PROGRAM, "view", "cut.obj", *words], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True, timeout=LONGEST)
            self.assertEqual(done.returncode, 3)
            self.assertRegex(done.stderr, r"\Aweft: error: cut\.obj:1: .*\n\Z")


class WithoutDisplay(ProgramTest):
    def test_is_one_line(self):
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = self.run_weft("view", "builtin:sheet", code=3, env=environment)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("no display", done.stderr)

    def test_help_has_an_example(self):
        self.assertIn("Example: weft view", self.run_weft("view", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
