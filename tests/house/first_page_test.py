"""What README.md says in figures is what docs/measured.md has."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def rows(block):
    """The cells of all rows of a block's tables."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines() if line.startswith("| ")]


class FirstPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = " ".join((ROOT / "README.md").read_text().split())
        cls.measured = (ROOT / "docs/measured.md").read_text()

    def block(self, name):
        return self.measured.split(f"<!-- {name} -->")[1].split(f"<!-- /{name} -->")[0]

    def quoted(self, sentence):
        found = re.search(sentence, self.page)
        self.assertIsNotNone(found, sentence)
        return [int(number.replace(" million", "000000")) for number in found.groups()]

    def test_random_starts(self):
        starts, failed = map(int, re.search(r"(\d+) random starts of .*?, (\d+) failed", self.block("soak")).groups())
        self.assertEqual(self.quoted(r"Of (\d+) random starts .*? (\d+) miss(?:es)? a bound"), [starts, failed])

    def test_the_hanging_sheet(self):
        took = {(row[1], row[2]): round(float(row[3])) for row in rows(self.block("hanging")) if row[0] == "newton"}
        sentence = r"takes (\d+) ms a frame at 129 x 129 on one thread and (\d+) on two, (\d+) and (\d+) at 257 x 257"
        self.assertEqual(self.quoted(sentence), [took[f"{n} x {n}", threads] for n in (129, 257) for threads in ("1", "2")])

    def test_largest_meshes(self):
        largest = max(int(row[1]) for row in rows(self.block("growth")) if row[1].isdigit())
        self.assertEqual(self.quoted(r"grow up to (\d+ million) triangles"), [largest // 1000000 * 1000000])

    def test_where_the_default_is_ahead(self):
        """Nothing reaches the error that is told of, or less down to 1 mm, in less time."""
        [below] = self.quoted(r"ahead wherever less than (\d+) mm are wanted")
        points = [(row[0], float(row[3]), float(row[4])) for row in rows(self.block("error_fabrics")) if row[0] != "method"]
        fabrics = self.block("error_fabrics").count("| method |")
        per_fabric = len(points) // fabrics
        self.assertGreater(per_fabric, 20)
        for first in range(0, len(points), per_fabric):
            some = points[first:first + per_fabric]
            ours = [(time, error) for name, time, error in some if name == "newton"]
            for name, time, error in some:
                if name != "newton" and 1 < error < below:
                    self.assertLess(min(t for t, e in ours if e <= max(error, min(e for _, e in ours))), time, (name, error))


if __name__ == "__main__":
    unittest.main()
