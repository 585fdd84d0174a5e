"""Runs the program under test; shared by the tests of the program and of the Python module."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["WEFT_PROGRAM"]
SHARED = pathlib.Path(os.environ["WEFT_SHARED_DIR"])
SOURCE = pathlib.Path(os.environ["WEFT_SOURCE_DIR"])


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, gone at its end."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="weft-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_weft(self, *words, code=0, **options):
        """The finished process, after checking its exit code."""
        command = [PROGRAM, *[str(word) for word in words]]
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, **options)
        self.assertEqual(done.returncode, code, f"{command}\n{done.stdout}\n{done.stderr}")
        return done

    def run_json(self, *words):
        """The one JSON object on stdout."""
        return json.loads(self.run_weft(*words, "--json").stdout)

    def error_of(self, *words, code):
        """The one line on stderr of a command that fails."""
        done = self.run_weft(*words, code=code)
        self.assertEqual(done.stdout, "")
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("weft: error: "), lines[0])
        return lines[0]

    def shared_mesh(self, name):
        path = SHARED / "meshes" / name
        if not path.exists():
            self.skipTest(f"{path} is not there")
        return path

    def assert_nothing_left(self):
        left = sorted(str(path) for path in self.folder.rglob("*"))
        self.assertEqual(left, [])
