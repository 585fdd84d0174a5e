"""Every shell command in the documents runs: fenced blocks marked `sh`, a folder a document."""
import os
import pathlib
import re
import subprocess
import unittest

from program import PROGRAM, ProgramTest, SOURCE

FENCE = re.compile(r"^```sh\n(.*?)^```", re.S | re.M)


def documents():
    return [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]


def commands(path):
    """The lines of all shell blocks, continued lines joined."""
    blocks = "".join(FENCE.findall(path.read_text())).replace("\\\n", " ")
    return [line.strip() for line in blocks.splitlines() if line.strip() and not line.startswith("#")]


class Documents(ProgramTest):
    def run_document(self, path, environment):
        folder = self.folder / "-".join(path.relative_to(SOURCE).with_suffix("").parts)
        folder.mkdir()
        words = subprocess.run([SOURCE / "dev"], capture_output=True, text=True).stdout
        for command in commands(path):
            if command.startswith("./dev"):
                self.assertRegex(words, rf"(?m)^  {command.split()[1]}\b", command)
            elif not command.startswith("git clone") and not command.startswith("cd "):
                done = subprocess.run(["bash", "-e", "-c", command], cwd=folder, env=environment,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{path.name}: {command}\n{done.stderr}")

    def test_every_command_runs(self):
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}")
        self.assertGreater(sum(len(commands(path)) for path in documents()), 8)
        for path in documents():
            with self.subTest(path.name):
                self.run_document(path, environment)

    def test_every_local_link_leads_somewhere(self):
        for path in documents():
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", path.read_text()):
                self.assertTrue((path.parent / target).exists(), f"{path.name}: {target}")


if __name__ == "__main__":
    unittest.main()
