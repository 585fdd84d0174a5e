"""bench/stale.py finds every measured block that no longer tells of its sources."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench"))
import stamp  # noqa: E402
STAMP = "`./dev bench speed` at commit `{}`, 2026-01-02, on a bench (2 processors); of `{}`.\n\n"


class Stale(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.git("init", "-q")
        self.git("config", "user.name", "test")
        self.git("config", "user.email", "test@example.org")
        (self.root / "docs").mkdir()
        (self.root / "src").mkdir()
        self.first = self.change("src/solver.cpp")

    def git(self, *words):
        return subprocess.run(["git", *words], cwd=self.root, check=True, capture_output=True, text=True).stdout.strip()

    def change(self, name):
        with open(self.root / name, "a") as file:
            file.write("more\n")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "change")
        return self.git("rev-parse", "--short", "HEAD")

    def write_block(self, line):
        (self.root / "docs/measured.md").write_text(f"# Measured\n<!-- speed -->\n{line}| ms |\n<!-- /speed -->\n")

    def stale(self, most):
        done = subprocess.run([sys.executable, ROOT / "bench/stale.py", "--root", self.root, "--most", str(most)],
                              capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_commands_name_no_file_of_the_machine(self):
        words = ["bench/soak.py", "--seeds", "3", "--keep", "/here", "--figures", "/here/f.csv", "--resume", "--jobs", "2", "--write"]
        self.assertEqual(stamp.command(words), "./dev bench soak --seeds 3 --jobs 2")

    def test_commits_of_its_sources_alone_make_a_block_stale(self):
        self.write_block(STAMP.format(self.first, "src"))
        for _ in range(2):
            self.change("src/solver.cpp")
            self.change("README.md")
        self.assertEqual(self.stale(2)[0], 0)
        code, text = self.stale(1)
        self.assertEqual(code, 1)
        self.assertIn(f"docs/measured.md: speed: 2 commits changed its sources since {self.first}", text)
        self.assertIn("1 of 1 measured blocks are stale", text)

    def test_blocks_must_say_where_they_come_from(self):
        for line, reason in (("", "says neither commit"), (STAMP.format("0123456", "src"), "not in this history"),
                             (STAMP.format(self.first, "src").replace("`, 2026", "+`, 2026"), "differ from commit"),
                             (STAMP.format(self.first, "src/gone.cpp"), "is no more")):
            self.write_block(line)
            code, text = self.stale(9)
            self.assertEqual(code, 1, line)
            self.assertIn(reason, text)

    def test_documents_without_any_block_are_no_success(self):
        self.assertEqual(self.stale(9)[0], 1)


if __name__ == "__main__":
    unittest.main()
