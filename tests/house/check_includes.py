#!/usr/bin/env python3
"""Checks who includes whom: lower modules never see higher ones; the program, the window, the examples, the Python
module and the tests of contract see the public headers alone, which see each other alone; every source of the library begins with the header
beside it; and what a header takes from the standard library and from fmt it includes, or has of what it includes (they
are compiled with those headers in front, cmake/WeftModule.cmake).

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
    "garment": {"core", "mesh", "image"},
    "convert": {"core", "mesh", "image", "garment", "cut", "param"},
    "cloth": {"core", "image"},
    "collide": {"core", "mesh", "image"},
    "sim": {"core", "mesh", "image", "garment", "convert", "cloth", "collide"},
    "run": {"core", "mesh", "image", "garment", "convert", "cloth", "collide", "sim"},
    "view": {"core", "mesh", "cut", "param", "image", "garment", "convert"},
}
# Which module declares itself in which of the public headers; who may include the module may include these.
PUBLIC = {
    "core": {"methods", "vec", "error", "progress", "grid", "contact", "threads", "files"},
    "mesh": {"mesh", "point_cache", "shapes", "repair", "mesh_statistics", "mesh_colours"},
    "image": {"geometry_image", "image_file", "image_quality"},
    "cut": {"cut"},
    "param": {"parameterizer"},
    "convert": {"convert"},
    "garment": {"garment"},
    "cloth": {"material", "cloth_state", "integrators", "table5"},
    "collide": {"colliders"},
    "sim": {"scene", "scene_file", "simulation", "fabric"},
    "run": {"run", "run_folder", "drape_scene", "state_bytes"},
    "view": {"picture", "camera", "drawing", "window_canvas"},
}
OWNER = {header: module for module, headers in PUBLIC.items() for header in headers}
# Who uses the library by its public headers alone.
OUTSIDE = ("apps/weft", "apps/viewer", "examples/library", "tests/contract", "python/src")
EIGEN_MODULES = {"cut", "param", "cloth"}  # and only in .cpp files
# Where names of the standard library, and of fmt, come from.
PROVIDERS = {
    "algorithm": "sort stable_sort max_element min_element count_if find_if any_of all_of none_of fill copy clamp lower_bound",
    "array": "array", "atomic": "atomic memory_order_relaxed", "chrono": "chrono", "cmath": "sqrt hypot floor ceil isfinite lround",
    "condition_variable": "condition_variable", "cstdint": "uint8_t uint16_t uint32_t uint64_t int32_t int64_t",
    "filesystem": "filesystem", "functional": "function less greater", "fstream": "ifstream ofstream", "limits": "numeric_limits",
    "map": "map", "memory": "unique_ptr shared_ptr make_unique make_shared weak_ptr", "mutex": "mutex lock_guard unique_lock",
    "numeric": "accumulate iota", "optional": "optional nullopt", "queue": "priority_queue queue", "set": "set", "span": "span",
    "string": "string to_string", "string_view": "string_view", "thread": "thread", "tuple": "tuple tie",
    "type_traits": "is_same_v conditional_t decay_t remove_cvref_t", "unordered_map": "unordered_map",
    "utility": "pair move swap exchange forward", "variant": "variant visit holds_alternative", "vector": "vector",
}
PROVIDER = {name: header for header, names in PROVIDERS.items() for name in names.split()}
# Headers that promise more than the names after which they are called.
ALSO = {"algorithm": {"utility"}, "array": {"utility"}, "filesystem": {"string", "string_view"}, "fstream": {"string"},
        "functional": {"utility"}, "map": {"utility"}, "memory": {"utility"}, "optional": {"utility"},
        "string": {"string_view"}, "tuple": {"utility"}, "variant": {"utility"}, "vector": {"utility"}}
STANDARD_NAME = re.compile(r"\bstd::(\w+)")
COMMENT = re.compile(r"//.*")
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


def included(root: pathlib.Path, path: pathlib.Path, seen: dict):
    """The names between angle brackets that a header brings, by itself and by what it includes of this library."""
    if path in seen:
        return seen[path]
    seen[path] = found = set()
    for line in path.read_text().splitlines():
        match = INCLUDE.match(line)
        if match and match[1] == "<":
            found |= {match[2]} | ALSO.get(match[2], set())
        elif match:
            other = next((top / match[2] for top in (root / "include", root / "src") if (top / match[2]).exists()), None)
            found |= included(root, other, seen) if other else set()
    return found


def missing_includes(root: pathlib.Path):
    seen: dict = {}
    for path in sorted([*(root / "include").rglob("*.h"), *(root / "src/weft").rglob("*.h")]):
        code = COMMENT.sub("", path.read_text())
        wanted = {PROVIDER[name] for name in STANDARD_NAME.findall(code) if name in PROVIDER}
        if "fmt::" in code:
            wanted.add("fmt/format.h")
        for header in sorted(wanted - included(root, path, seen)):
            yield f"{path}: uses <{header}> and does not include it"


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    found = [*violations(root), *public_violations(root), *missing_includes(root)]
    print("\n".join(found) if found else "includes are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
