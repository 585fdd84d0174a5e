"""Weft as others use it: installed, found by CMake, and the example built against it."""
import os
import pathlib
import subprocess
import unittest

from program import PROGRAM, ProgramTest, SOURCE


class Library(ProgramTest):
    def run_tool(self, *words):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
        return done.stdout

    def test_example_builds_against_the_installed_package_and_runs(self):
        build = pathlib.Path(PROGRAM).resolve().parents[1]
        self.run_tool("cmake", "--install", build, "--prefix", self.folder / "weft")
        headers = {str(path.relative_to(SOURCE / "src")) for path in (SOURCE / "src/weft").rglob("*.h")}
        there = {str(path.relative_to(self.folder / "weft/include")) for path in (self.folder / "weft/include").rglob("*.*")}
        self.assertEqual(there, headers)
        self.run_tool("cmake", "-S", SOURCE / "examples/library", "-B", "example", "-G", "Ninja",
                      f"-DCMAKE_PREFIX_PATH={self.folder / 'weft'}", "-DCMAKE_BUILD_TYPE=Release")
        self.run_tool("cmake", "--build", "example")
        words = self.run_tool(self.folder / "example/hang").splitlines()
        self.assertRegex(words[0], r"^converted: \d\d\.\d dB, Euler number -2$")  # a shirt has four openings
        self.assertRegex(words[1], r"^frame 10: lowest point at -?\d\.\d{4} m$")
        self.assertTrue((self.folder / "shirt.exr").exists())
        # The installed program is the program.
        version = self.run_tool(self.folder / "weft/bin/weft", "--version")
        self.assertEqual(version, self.run_weft("--version").stdout)
        targets = (next((self.folder / "weft").rglob("WeftTargets.cmake"))).read_text()
        self.assertNotIn(str(SOURCE), targets)
        self.assertNotIn(os.fspath(build), targets)


if __name__ == "__main__":
    unittest.main()
