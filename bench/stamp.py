"""What a measured block says of its making, and how far its sources have gone on since.

A block stands between <!-- NAME --> and <!-- /NAME --> of a document. Its first line is its stamp: the command, the commit, the
date, the machine, and the sources that it depends on."""
import dataclasses
import datetime
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# So many commits may change a block's sources before it has to be measured anew.
MAX_COMMITS = 60

# The defaults that a measurement runs on stand in public headers.
CLOTH = ("src/weft/cloth", "include/weft/integrators.h", "include/weft/material.h")
SIMULATION = (*CLOTH, "src/weft/collide", "src/weft/sim", "include/weft/colliders.h", "include/weft/scene.h")
CONVERSION = ("src/weft/mesh", "src/weft/cut", "src/weft/param", "src/weft/image", "src/weft/convert")
SOURCES = {
    "meshes": CONVERSION, "targets": CONVERSION, "more_charts": CONVERSION, "long_pieces": CONVERSION, "growth": CONVERSION, "compression": CONVERSION,
    "omages": (*CONVERSION, "python/weft/omages.py"), "batch": ("python/weft/batch",), "batch_cost": ("python/weft/batch",),
    "hanging": SIMULATION, "hanging_fabrics": SIMULATION, "charts": CLOTH, "table5": CLOTH, "error_129": CLOTH, "error_65": CLOTH, "error_fabrics": (*CLOTH, "src/weft/sim/materials.cpp"), "kernels": CLOTH,
    "solver_fabrics": CLOTH, "solver_random": CLOTH,
    "ccd": ("src/weft/collide/ccd.cpp", "src/weft/collide/ccd.h"), "polar_map": ("src/weft/collide",),
    "broad_phases": ("src/weft/collide/broad_phase",),
    "validate": (*SIMULATION, "tests/cloth", "tests/sim"), "self_cost": SIMULATION, "scenes": SIMULATION, "tight_scenes": SIMULATION, "soak": SIMULATION,
    "patterns": (*SIMULATION, "src/weft/garment"), "at_rest": (*SIMULATION, "src/weft/garment"),
    "random_garments": (*SIMULATION, "src/weft/garment"),
    "drape": (*CLOTH, "src/weft/sim/drape_coefficient.cpp", "src/weft/sim/materials.cpp"),
}
# Options whose next word is a file or a folder that a bench keeps its work in.
LOCAL_FILES = ("--done", "--figures", "--keep", "--pictures", "--shared")
LINE = re.compile(r"`(?P<command>[^`]+)` at commit `(?P<commit>[0-9a-f]+)(?P<dirty>\+?)`, (?P<date>\d{4}-\d\d-\d\d), on "
                  r"(?P<machine>[^;\n]+); of (?P<sources>`[^\n]+`)\.\n")
BLOCK = re.compile(r"<!-- (?P<name>\w+) -->\n(?P<text>.*?)<!-- /(?P=name) -->", re.S)


def git(*words, root=ROOT):
    """What it prints, or None."""
    done = subprocess.run(["git", *words], cwd=root, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


def machine():
    """The processor's name, and how many of them there are."""
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else os.uname().machine} ({len(os.sched_getaffinity(0))} processors)"


def command(argv):
    """The words of ./dev that run a script; without those that name files of the machine, which change no figure."""
    words, given = [], iter(argv[1:])
    for word in given:
        if word in LOCAL_FILES:
            next(given, None)
        elif word not in ("--write", "--resume"):
            words.append(word)
    name = pathlib.Path(argv[0]).stem
    return " ".join(["./dev bench", *([] if name == "native" else [name]), *words])


def stamp(name):
    """The line of a block that is measured now."""
    sources = SOURCES[name]
    dirty = "+" if git("status", "--porcelain", "--", *sources) else ""
    named = ", ".join(f"`{source}`" for source in sources)
    return (f"`{command(sys.argv)}` at commit `{git('rev-parse', '--short', 'HEAD')}{dirty}`, {datetime.date.today()}, on {machine()}; "
            f"of {named}.\n")


@dataclasses.dataclass
class Finding:
    """A block of a document and why it has to be measured anew; None: it need not."""
    document: pathlib.Path
    name: str
    reason: str | None


def reason_for(text, root, most_commits):
    found = LINE.match(text)
    if not found:
        return "says neither commit, date, machine, command nor sources"
    commit, sources = found["commit"], re.findall(r"`([^`]+)`", found["sources"])
    if found["dirty"]:
        return f"measured sources that differ from commit {commit}"
    gone = [source for source in sources if not (root / source).exists()]
    if gone:
        return f"depends on {', '.join(gone)}, which is no more"
    newer = git("rev-list", "--count", "--no-merges", f"{commit}..HEAD", "--", *sources, root=root)
    if newer is None:
        return f"names commit {commit}, which is not in this history"
    if int(newer) > most_commits:
        return f"{newer} commits changed its sources since {commit} ({found['date']}); {most_commits} may; {found['command']}"
    return None


def findings(root=ROOT, most_commits=MAX_COMMITS):
    """One for each block of the documents, in their order."""
    for document in sorted((root / "docs").rglob("*.md")):
        for block in BLOCK.finditer(document.read_text()):
            yield Finding(document.relative_to(root), block["name"], reason_for(block["text"], root, most_commits))
