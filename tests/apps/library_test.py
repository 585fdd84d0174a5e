"""Weft as others use it: installed, found by CMake, and the examples built against it."""
import os
import pathlib
import re
import subprocess
import unittest

from program import PROGRAM, ProgramTest, SOURCE


class Library(ProgramTest):
    def run_tool(self, *words):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
        return done.stdout

    def test_examples_build_against_the_installed_package_and_run(self):
        build = pathlib.Path(PROGRAM).resolve().parents[1]
        self.run_tool("cmake", "--install", build, "--prefix", self.folder / "weft")
        headers = {f"weft/{path.name}" for path in (SOURCE / "include/weft").glob("*.h")}
        there = {str(path.relative_to(self.folder / "weft/include")) for path in (self.folder / "weft/include").rglob("*.*")}
        self.assertEqual(there, headers)
        self.run_tool("cmake", "-S", SOURCE / "examples/library", "-B", "example", "-G", "Ninja",
                      f"-DCMAKE_PREFIX_PATH={self.folder / 'weft'}", "-DCMAKE_BUILD_TYPE=Release")
        self.run_tool("cmake", "--build", "example")
        words = self.run_tool(self.folder / "example/convert").splitlines()
        self.assertRegex(words[0], r"^converted: \d\d\.\d dB, Euler number -2, stretch 1\.\d{3}$")  # a shirt has four openings
        self.assertRegex(words[1], r"^rebuilt: 1\d{3} vertices, 2\d{3} triangles$")
        self.assertTrue((self.folder / "shirt.exr").exists())
        words = self.run_tool(self.folder / "example/drape")
        found = re.match(r"^frame 30: lowest point at (-?\d\.\d{4}) m, (\d+) contacts, strain (\d+\.\d\d) %, ", words)
        self.assertTrue(found, words)
        self.assertGreater(float(found[1]), -1e-3)
        self.assertGreater(int(found[2]), 0)
        self.assertLess(float(found[3]), 5)
        words = self.run_tool(self.folder / "example/game_loop")
        self.assertEqual(words, "frame 30: played again alike\nstopped\n")
        # The installed program is the program.
        version = self.run_tool(self.folder / "weft/bin/weft", "--version")
        self.assertEqual(version, self.run_weft("--version").stdout)
        targets = (next((self.folder / "weft").rglob("WeftTargets.cmake"))).read_text()
        self.assertNotIn(str(SOURCE), targets)
        self.assertNotIn(os.fspath(build), targets)


if __name__ == "__main__":
    unittest.main()
