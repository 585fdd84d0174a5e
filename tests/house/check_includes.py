#!/usr/bin/env python3
"""Checks who includes whom: lower modules never see higher ones; the program, the window, the examples and the tests of
contract see the public headers alone, which see each other alone; and every source of the library
begins with the header beside it, which so is compiled with nothing before it.

Usage: check_includes.py SOURCE_FOLDER   (exit 1 and one line a violation)
"""
import pathlib
import re
import sys

# What each module may include besides itself (docs/architecture.md draws the same).
ALLOWED = {
    "core": set(),
    "mesh": {"core"},
    "image": {"core", "mesh"},
    "cut": {"core", "mesh"},
    "param": {"core", "mesh", "cut"},
    "convert": {"core", "mesh", "image", "cut", "param"},
    "cloth": {"core", "image"},
    "collide": {"core", "mesh", "image"},
    "sim": {"core", "mesh", "image", "convert", "cloth", "collide"},
    "run": {"core", "mesh", "image", "convert", "cloth", "collide", "sim"},
    "view": {"core", "mesh", "cut", "param", "image", "convert"},
}
# Which module declares itself in which of the public headers; who may include the module may include these.
PUBLIC = {
    "core": {"methods", "vec", "error", "progress", "grid", "contact", "threads", "files"},
    "mesh": {"mesh", "shapes", "repair", "mesh_statistics"},
    "image": {"geometry_image", "image_file", "image_quality"},
    "cut": {"cut"},
    "param": {"parameterizer"},
    "convert": {"convert"},
    "cloth": {"material", "cloth_state", "integrators", "table5"},
    "collide": {"colliders"},
    "sim": {"scene", "scene_file", "simulation", "fabric"},
    "run": {"run", "run_folder", "drape_scene"},
    "view": {"picture", "camera", "drawing", "window_canvas"},
}
OWNER = {header: module for module, headers in PUBLIC.items() for header in headers}
# Who uses the library by its public headers alone.
OUTSIDE = ("apps/weft", "apps/viewer", "examples/library", "tests/contract")
EIGEN_MODULES = {"cut", "param", "cloth"}  # and only in .cpp files
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def violations(root: pathlib.Path):
    for path in sorted((root / "src/weft").rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        yield from header_not_first(root, path)
        module = path.relative_to(root / "src/weft").parts[0]
        if module not in ALLOWED:
            yield f"{path}: folder '{module}' is no module; known: {', '.join(ALLOWED)}"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            kind, name = match.groups()
            where = f"{path}:{number}"
            if name.startswith("Eigen/") and (path.suffix == ".h" or module not in EIGEN_MODULES):
                yield f"{where}: Eigen belongs into .cpp files of {', '.join(sorted(EIGEN_MODULES))}"
            if kind == '"' and not name.startswith("weft/"):
                yield f"{where}: '{name}' is not a full path; write \"weft/...\""
            if name.startswith("weft/"):
                other = name.split("/")[1]
                if other.endswith(".h"):
                    if other[:-2] not in OWNER:
                        yield f"{where}: no public header '{other}'"
                        continue
                    other = OWNER[other[:-2]]
                if other != module and other not in ALLOWED[module]:
                    yield f"{where}: {module} must not include {other}"


def public_violations(root: pathlib.Path):
    """Public headers include each other alone, and those who stand outside include nothing else."""
    for folder in ("include/weft", *OUTSIDE):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            if folder == "include/weft" and path.stem not in OWNER:
                yield f"{path}: a public header of no module"
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match and match[2].startswith("weft/") and match[2].count("/") > 1:
                    yield f"{path}:{number}: {match[2]} is internal"


def header_not_first(root: pathlib.Path, path: pathlib.Path):
    own = path.with_suffix(".h")
    if path.suffix != ".cpp" or not own.exists():
        return
    lines = path.read_text().splitlines()
    first = next((line for line in lines if line.strip() and not line.lstrip().startswith("//")), "")
    wanted = own.relative_to(root / "src").as_posix()
    if first != f'#include "{wanted}"':
        yield f"{path}: its own header {wanted} comes first"


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    found = [*violations(root), *public_violations(root)]
    print("\n".join(found) if found else "includes are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
