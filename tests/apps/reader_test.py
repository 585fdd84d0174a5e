"""A reader of 50 lines, written by docs/formats.md, rebuilds from an EXR file alone what `weft rebuild` does."""
import contextlib
import io
import itertools
import math
import subprocess
import sys
import unittest
import unittest.mock

from drawn_images import draw_image, exr_bytes
from program import PROGRAM, SOURCE, ProgramTest

READER = SOURCE / "tests" / "image" / "read_exr.py"


def parse_obj(text):
    """Vertices and triangles in their order; numbers are written with all their digits."""
    lines = [line.split() for line in text.splitlines()]
    return ([tuple(float(x) for x in line[1:]) for line in lines if line[0] == "v"],
            [tuple(int(k) for k in line[1:]) for line in lines if line[0] == "f"])


def obj_text(vertices, triangles):
    return "".join([f"v {x} {y} {z}\n" for x, y, z in vertices] + [f"f {a} {b} {c}\n" for a, b, c in triangles])


def beside(meshes, distance=3):
    """Several meshes as one, side by side."""
    vertices, triangles = [], []
    for k, (points, corners) in enumerate(meshes):
        triangles += [tuple(v + len(vertices) for v in t) for t in corners]
        vertices += [(x + distance * k, y, z) for x, y, z in points]
    return vertices, triangles


def strip(columns, rows, place):
    """A strip of quads: `place(i, j)` for i in 0 .. columns, j in 0 .. rows; equal places are one vertex."""
    number = {}
    triangles = []
    for i, j in itertools.product(range(columns), range(rows)):
        corners = place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)
        a, b, c, d = (number.setdefault(corner, len(number) + 1) for corner in corners)
        triangles += [(a, b, c), (a, c, d)]
    return list(number), triangles


def book(pages):
    """Pages that meet in one edge, which so has as many triangles."""
    triangles, number = [], {}
    for page in range(pages):
        x, y = math.cos(2 * math.pi * page / pages), math.sin(2 * math.pi * page / pages)
        points, corners = strip(6, 6, lambda i, j: (i * x + 0.0, i * y + 0.0, j))
        triangles += [tuple(number.setdefault(points[v - 1], len(number) + 1) for v in t) for t in corners]
    return list(number), triangles


def moebius_band():
    around, across = 40, 6

    def place(i, j):
        if i == around:
            i, j = 0, across - j
        turn, width = 2 * math.pi * i / around, (j / across - 0.5) * 0.8
        ring = 1 + width * math.cos(turn / 2)
        return (ring * math.cos(turn), ring * math.sin(turn), width * math.sin(turn / 2))
    return strip(around, across, place)


# What the reader does, and what it might do in its place.
PARTS = (
    ("here and p[-1] != p[1]", "here"),
    ("p[-1] == p[1]", "False"),
    ("p[0] == p[2]", "False"),
    ("before and p[1] in (p[-2], p[-3])", "False"),
    ("p[1] in (p[-2], p[-3])", "p[1] == p[-2]"),
    ("p[1] in (p[-2], p[-3])", "p[1] == p[-3]"),
    ("before and ", ""),
    ("after and p[0] == p[3]", "False"),
    ("after and ", ""),
    (" and not ahead", ""),
    ("(q // n + q % n) % 2", "0"),
    ("k if any(turned) else -k", "-k"),
    ("min(point.get", "max(point.get"),
    ("if len(set(t)) == 3", ""),
    ("sorted(rising)", "rising"),
    ("zip(line[2 * n:], line[n:], line)", "zip(line, line[n:], line[2 * n:])"),
)


def run_inside(source, path):
    """What the reader's source prints of a file, without a process of its own."""
    with contextlib.redirect_stdout(io.StringIO()) as printed, unittest.mock.patch("sys.argv", ["read_exr.py", path]):
        exec(compile(source, READER, "exec"), {})
    return parse_obj(printed.getvalue())


class Reader(ProgramTest):
    def read(self, name):
        done = subprocess.run([sys.executable, "-B", READER, name], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return parse_obj(done.stdout)

    def rebuilt(self, name):
        self.run_weft("rebuild", name, "-o", "rebuilt.obj", "--quiet")
        return parse_obj((self.folder / "rebuilt.obj").read_text())

    def assert_same(self, found, wanted):
        """The same bits and order; no difference is printed in full, it would be long."""
        for kind, some, others in zip(("vertices", "triangles"), found, wanted):
            self.assertEqual(len(some), len(others), kind)
            for k, (one, other) in enumerate(zip(some, others)):
                self.assertEqual(one, other, f"{kind}, {k}")

    def check_mesh(self, mesh, sizes, version=1, charts="auto"):
        for size in sizes:
            with self.subTest(mesh, size=size):
                self.run_weft("convert", mesh, "-o", "image.exr", "--size", size, "--charts", charts, "--quiet")
                self.assertIn(b'"version":%d' % version, (self.folder / "image.exr").read_bytes())
                wanted = self.rebuilt("image.exr")
                self.assertGreater(len(wanted[1]), size * size / 2)
                self.assert_same(self.read("image.exr"), wanted)

    def drawn_images(self, count):
        """Files of images with any borders whatever, with what Weft makes of them."""
        images = []
        for seed in range(count):
            path, mesh = self.folder / f"{seed}.exr", self.folder / f"{seed}.obj"
            path.write_bytes(exr_bytes(*draw_image(seed, several=seed % 2 == 1)))
            done = subprocess.run([PROGRAM, "rebuild", path, "-o", mesh, "--quiet"], capture_output=True, text=True)
            if done.returncode == 0:
                images.append((path, parse_obj(mesh.read_text())))
            else:  # joined at random, one chart may have edges of three triangles, which are refused
                self.assertRegex(done.stderr, "has [3-9] triangles")
        self.assertGreater(len(images), 0.9 * count)
        return images

    def write(self, name, mesh):
        (self.folder / name).write_text(obj_text(*mesh))
        return name

    def shape(self, name):
        self.run_weft("shapes", name, "-o", "shape.obj")
        return parse_obj((self.folder / "shape.obj").read_text())

    def test_is_short(self):
        lines = READER.read_text().splitlines()
        self.assertLessEqual(len(lines), 50)
        self.assertLessEqual(max(map(len, lines)), 110)

    def test_shapes_of_one_chart(self):
        for name in ("box", "torus", "tshirt"):
            self.check_mesh(f"builtin:{name}", (33,))
        self.check_mesh("builtin:knot", (65,))
        self.check_mesh("builtin:genus20", (65,), charts="1")  # else it would be several
        self.check_mesh("builtin:mannequin", (33,))

    def test_colours_are_stepped_over(self):
        points, triangles = self.shape("torus")
        (self.folder / "painted.obj").write_text("".join(f"v {x} {y} {z} 0 {k % 2} 0.5\n" for k, (x, y, z) in enumerate(points)) +
                                                 "".join(f"f {a} {b} {c}\n" for a, b, c in triangles))
        self.run_weft("convert", "painted.obj", "-o", "image.exr", "--size", 33, "--colours")
        self.run_weft("convert", "painted.obj", "-o", "plain.exr", "--size", 33)
        self.assertIn(b"colour.R", (self.folder / "image.exr").read_bytes())
        self.assert_same(self.read("image.exr"), self.rebuilt("plain.exr"))

    def test_pieces_pages_and_bands_of_several_charts(self):
        pieces = beside([self.shape(name) for name in ("sphere", "torus", "tshirt")])
        self.check_mesh(self.write("pieces.obj", pieces), (65,), version=2)
        self.check_mesh(self.write("book.obj", book(3)), (33, 65), version=2)
        self.check_mesh(self.write("band.obj", moebius_band()), (33, 65), version=2)

    def test_images_whose_borders_are_joined_in_any_way(self):
        for path, wanted in self.drawn_images(80):
            with self.subTest(path.name):
                self.assert_same(run_inside(READER.read_text(), path), wanted)

    def test_leaving_out_any_part_of_the_rule_is_seen(self):
        images = self.drawn_images(80)
        source = READER.read_text()
        for part, other in PARTS:
            with self.subTest(part):
                self.assertEqual(source.count(part), 1)
                changed = source.replace(part, other)
                self.assertTrue(any(run_inside(changed, path) != wanted for path, wanted in images))


if __name__ == "__main__":
    unittest.main()
