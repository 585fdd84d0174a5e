#!/usr/bin/env python3
"""Checks who includes whom: lower modules never see higher ones; app-level code sees all; and every source of the library
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
                if other != module and other not in ALLOWED[module]:
                    yield f"{where}: {module} must not include {other}"


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
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "includes are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
