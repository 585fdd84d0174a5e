"""The pictures of the documents: named ones are there, those there are named, and they are small."""
import re
import unittest

from program import SOURCE

FIGURES = SOURCE / "docs" / "figures"
LARGEST = 300_000  # bytes


class Figures(unittest.TestCase):
    def named(self):
        names = set()
        for path in (SOURCE / "README.md", *(SOURCE / "docs").rglob("*.md")):
            for target in re.findall(r"!\[[^\]]*\]\(([^)]+\.png)\)", path.read_text()):
                self.assertTrue((path.parent / target).resolve().exists(), f"{path.name}: {target}")
                names.add(target.rsplit("/", 1)[-1])
        return names

    def test_documents_and_folder_hold_the_same_pictures(self):
        self.assertEqual(self.named(), {path.name for path in FIGURES.glob("*.png")})

    def test_every_stage_of_a_conversion_has_a_heading_and_most_a_picture(self):
        text = (SOURCE / "docs" / "theory.md").read_text()
        stages = re.findall(r"^### 1\.(\d+) ", text, re.M)
        self.assertEqual(stages, [str(k) for k in range(1, 12)])
        self.assertGreaterEqual(text.count("](figures/"), 11)

    def test_pictures_are_small(self):
        for path in FIGURES.glob("*.png"):
            self.assertLess(path.stat().st_size, LARGEST, path.name)


if __name__ == "__main__":
    unittest.main()
