"""Every shell command in the documents runs: fenced blocks marked `sh`, a folder a document; links lead somewhere."""
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest, SOURCE

FENCE = re.compile(r"^```sh\n(.*?)^```", re.S | re.M)


# Run elsewhere or by people: the rest of a line that begins so is not run here.
LEFT_OUT = ("git clone", "./dev", "cd ")


def documents():
    return [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "examples" / "README.md",
            *sorted((SOURCE / "docs").rglob("*.md"))]


def blocks(path):
    """The shell blocks of a document, without the lines that are left out."""
    for block in FENCE.findall(path.read_text()):
        lines = [line for line in block.splitlines() if not line.startswith(LEFT_OUT)]
        if any(line.strip() and not line.startswith("#") for line in lines):
            yield "\n".join(lines) + "\n"


def with_window(block):
    """Windows open on a display of their own and close after two pictures."""
    return re.sub(r"^(weft view [^\n#]*)", r"xvfb-run -a \1 --frames 2 --width 640 --height 480 ", block, flags=re.M)


def drawn_small(block):
    """Pictures and movies at a size that costs little: the size is no matter of these tests."""
    def small(match):
        line = re.sub(r" --(width|height) \d+", "", match[0])
        return re.sub(r"(?=\s*(#|$))", " --width 96 --height 72", line, count=1)
    return re.sub(r"^weft render .*$", small, block, flags=re.M)


def of_few_frames(block):
    """Runs of few frames, and pictures of these: their length matters only where seams are to close."""
    enough = 48 if "weft garment" in block or '"sew"' in block else 20
    return re.sub(r'(--frames? |"frames": )(\d+)', lambda match: f"{match[1]}{min(int(match[2]), enough)}", block)


PYTHON = pathlib.Path(PROGRAM).parents[1] / "python"


def lacking(block):
    """What a block wants and does not have here; empty where it has all."""
    if "weft view" in block and not shutil.which("xvfb-run"):
        return "xvfb-run"
    if "WEFT_PYTHON" in block and (os.environ.get("WEFT_SANITIZE") or not list(PYTHON.glob("weft/_weft*.so"))):
        return "a Python module without sanitizers"
    return ""


class Documents(ProgramTest):
    def run_document(self, path, environment):
        folder = self.folder / "-".join(path.relative_to(SOURCE).with_suffix("").parts)
        folder.mkdir()
        for block in blocks(path):
            if lacks := lacking(block):
                print(f"{path.name}: not run without {lacks}:\n{block}")
                continue
            command = with_window(drawn_small(of_few_frames(block)))
            done = subprocess.run(["bash", "-e", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{path.name}:\n{block}\n{done.stderr}")

    def test_every_command_runs(self):
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}",
                           WEFT_PYTHON=str(PYTHON))
        self.assertGreater(sum(len(list(blocks(path))) for path in documents()), 15)
        for path in documents():
            with self.subTest(path.name):
                self.run_document(path, environment)

    def test_every_word_of_dev_is_one(self):
        words = subprocess.run([SOURCE / "dev"], capture_output=True, text=True).stdout
        for path in documents():
            for word in re.findall(r"\./dev ([a-z]+)", path.read_text()):
                self.assertRegex(words, rf"(?m)^  {word}\b", f"{path.name}: ./dev {word}")

    def test_every_local_link_leads_somewhere(self):
        for path in documents():
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", path.read_text()):
                self.assertTrue((path.parent / target).exists(), f"{path.name}: {target}")


if __name__ == "__main__":
    unittest.main()
