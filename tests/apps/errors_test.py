"""Every error of docs/errors.md is provoked: the program says what the page says, to the letter."""
import base64
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import unittest

import numpy as np

from program import PROGRAM, ProgramTest, SOURCE

ENTRY = re.compile(r"^```text\n\$ (.*)\n(weft: .*)\n```", re.M)

MESHES = {
    "index.obj": "v 0 0 0\nv 1 0 0\nf 1 2 9\n",
    "nan.obj": "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "points.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
    "old.gltf": '{"asset": {"version": "1.0"}, "meshes": {}}',
    "two.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n",
    "fan.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n",
    "large.obj": "v 0 0 0\nv 170 0 0\nv 0 0 170\nf 1 3 2\n",
    "coat.fbx": "FBX",
    "moves.gltf": json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64," + base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()}],
        "animations": [{"name": "walk"}, {}]}),
}
SHEET = '"surface": "builtin:sheet", "size": 33, "pins": [{"image": [0, 0]}]'
SCENES = {
    "key.json": '{"clothes": []}',
    "material.json": '{"cloths": [{"surface": "builtin:sheet", "material": "coton"}]}',
    "comma.json": '{"frames": 3\n "substeps": 4}',
    "pin.json": '{"cloths": [{"surface": "builtin:sheet", "pins": [{"image": [2, 0]}]}]}',
    "middle.json": '{"cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": 49}], '
                   '"bodies": [{"name": "ball", "surface": "builtin:sphere", "size": 33}]}',
    "lining.json": '{"cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": 33}, '
                   '{"name": "lining", "surface": "builtin:sheet", "size": 33}]}',
    "own.json": '{"cloths": [{"surface": "builtin:sheet", "size": 33}], '
                '"bodies": [{"name": "ball", "surface": "ball.obj", "size": 33}]}',
    "explicit.json": f'{{"integrator": {{"type": "explicit"}}, "substeps": 1, '
                     f'"cloths": [{{{SHEET}, "material": {{"stretch": 100000}}}}]}}',
    "run.json": f'{{"cloths": [{{{SHEET}}}], "bodies": [{{"surface": "ball.obj", "size": 17, "animation": "moves.gltf#run"}}]}}',
    "counts.json": f'{{"cloths": [{{{SHEET}}}], "bodies": [{{"surface": "ball.obj", "size": 17, "animation": "moves.npz"}}]}}',
    "stiff.json": f'{{"integrator": {{"type": "two_level", "filter_stiffness": 2000}}, '
                  f'"cloths": [{{{SHEET}, "velocity": [0, 0, 3]}}]}}',
}


def twisted_strip():
    """A Moebius strip of 20 quads."""
    count, lines = 20, []
    for i in range(count):
        turn = 2 * math.pi * i / count
        for side in (-0.3, 0.3):
            radius = 1 + side * math.cos(turn / 2)
            lines.append(f"v {radius * math.cos(turn)} {side * math.sin(turn / 2)} {radius * math.sin(turn)}")
    for i in range(count):
        a, b = 2 * i + 1, 2 * i + 2
        c, d = (a + 2, b + 2) if i + 1 < count else (2, 1)
        lines += [f"f {a} {c} {b}", f"f {b} {c} {d}"]
    return "\n".join(lines) + "\n"


def without_place(line):
    """Where a cloth runs away first, and how fast, is no matter of the page."""
    return re.sub(r"at frame \d+, particle \(row \d+, col \d+\), which moves at \S+ m/s", "at FRAME, PARTICLE", line)


class Errors(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, text in {**MESHES, **SCENES, "moebius.obj": twisted_strip()}.items():
            (self.folder / name).write_text(text)
        self.run_weft("shapes", "sphere", "-o", "ball.obj")
        np.savez(self.folder / "moves.npz", vertices=np.zeros((3, 2, 3)))
        self.run_weft("drape", "builtin:sheet", "builtin:sphere", "-o", "draped", "--size", "17", "--frames", "4")
        done = self.run_weft("--help")
        self.commands = ", ".join(re.findall(r"^  (\w+) ", done.stdout.split("Subcommands:\n")[1], re.M))

    def said(self, command):
        """The first line on stderr, with the program at its full path, and the exit code."""
        words = re.sub(r"(^| )weft ", rf"\1{PROGRAM} ", command, count=1)
        done = subprocess.run(["/bin/bash", "-c", f"{words} --quiet" if "large" not in command else words],
                              cwd=self.folder, capture_output=True, text=True, env=dict(os.environ))
        # Files that a scene names are told with their whole path.
        return done.stderr.split("\n")[0].replace(f"{self.folder.resolve()}/", ""), done.returncode

    def test_the_program_says_what_the_page_says(self):
        entries = ENTRY.findall((SOURCE / "docs/errors.md").read_text())
        self.assertGreater(len(entries), 20)
        for command, line in entries:
            with self.subTest(command):
                said, code = self.said(command)
                self.assertEqual(without_place(said), without_place(line.replace("COMMANDS", self.commands)))
                self.assertEqual(code == 0, line.startswith("weft: warning"))

    def test_errors_that_cannot_be_said_leave_their_exit_code(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.assertEqual(subprocess.run([PROGRAM, "nonsense"], stderr=full, check=False).returncode, 2)

    def test_every_heading_has_its_error(self):
        text = (SOURCE / "docs/errors.md").read_text()
        for part in text.split("\n### ")[1:]:
            self.assertRegex(part, ENTRY, pathlib.Path(part.split("\n")[0]).name)


if __name__ == "__main__":
    unittest.main()
