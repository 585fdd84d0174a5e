#!/usr/bin/env python3
"""Runs the commands of a tutorial and keeps the pictures that it shows, docs/figures/PAGE-NAME.png.

Usage: tutorial.py PROGRAM FOLDER PAGE     of docs, without .md; the folder for all that the commands write; pictures go to docs/figures
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


def main():
    program, folder, page = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), sys.argv[3]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    text = (DOCS / f"{page}.md").read_text()
    # Smaller than what people make for themselves: pages are narrow.
    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}")
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M):
        small = re.sub(r"^(weft render .*\.png.*)$", r"\1 --width 600 --height 400", block, flags=re.M)
        subprocess.run(["bash", "-e", "-c", small], cwd=folder, env=environment, check=True)
    for name in re.findall(rf"\(figures/{page}-(\w+)\.png\)", text):
        shutil.copy(folder / f"{name}.png", DOCS / "figures" / f"{page}-{name}.png")


if __name__ == "__main__":
    main()
