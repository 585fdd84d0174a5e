#!/usr/bin/env python3
"""Renews what pages take from elsewhere: the commands' pages the program's own help, scene.md the keys of its schema.

Usage: pages.py PROGRAM [--check]     with --check nothing is written; exit 1 and the names of pages that differ
"""
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
# commands.md has the help of the program itself.
BLOCK = re.compile(r"(<!-- help of weft( \w+)? -->\n).*?(<!-- end of help -->)", re.S)


def help_of(program, command=None):
    words = [program, *([command] if command else []), "--help"]
    text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    # As many threads as the machine has are not the page's concern.
    return re.sub(r"(--threads [^=\n]*)=\d+", r"\1", text).rstrip() + "\n"


def commands(program):
    listed = help_of(program).split("Subcommands:\n")[1]
    return re.findall(r"^  (\w+) ", listed, re.M)


def renewed(text, program):
    def block(match):
        command = match[2].strip() if match[2] else None
        return f"{match[1]}```text\n{help_of(program, command)}```\n{match[3]}"
    return BLOCK.sub(block, text)


def pages(program):
    """Each command's page, and that of the program."""
    return [HERE / "commands.md", *(HERE / "commands" / f"{name}.md" for name in commands(program))]


def bounds_of(node):
    """What a number may be, in words."""
    words = []
    for key, sign in (("exclusiveMinimum", "> "), ("minimum", ">= "), ("exclusiveMaximum", "< "), ("maximum", "<= ")):
        if key in node:
            words.append(f"{sign}{node[key]}")
    return ", ".join(words)


def kind_of(node):
    """What a value is, in words: one of the parts of the schema is a link to its table."""
    if "$ref" in node:
        return node["$ref"].rsplit("/", 1)[1]
    if "const" in node:
        return f"`{json.dumps(node['const'])}`"
    if "enum" in node:
        return ", ".join(f"`{json.dumps(value)}`" for value in node["enum"])
    for key in ("oneOf", "anyOf"):
        if key in node:
            return " or ".join(dict.fromkeys(kind_of(part) for part in node[key]))
    kind = node.get("type", "")
    if isinstance(kind, list):
        return " or ".join(kind)
    if kind == "array":
        return f"list of {kind_of(node.get('items', {}))}" if "items" in node else "list"
    return " ".join(word for word in (kind, bounds_of(node)) if word)


def table_of(node):
    rows = ["| key | value | default | meaning |", "|---|---|---|---|"]
    needed = node.get("required", [])
    for key, value in node["properties"].items():
        default = "needed" if key in needed else f"`{json.dumps(value['default'])}`" if "default" in value else ""
        cells = (f"`{key}`", kind_of(value), default, value.get("description", ""))
        rows.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(rows) + "\n"


def scene_with_keys(text):
    """The scene's page with a table of keys for the scene and for each of its parts."""
    schema = json.loads((HERE / "scene.schema.json").read_text())
    tables = "\n### scene\n\n" + table_of(schema)
    for name, part in schema["$defs"].items():
        if "properties" in part:
            tables += f"\n### {name}\n\n" + table_of(part)
    begin, end = "<!-- keys of scene.schema.json -->\n", "<!-- end of keys -->"
    first, last = text.index(begin) + len(begin), text.index(end)
    return text[:first] + tables + "\n" + text[last:]


def outdated(program):
    """Pages that are missing or differ from the program's help, with the text that they should have."""
    wrong = {}
    for path in pages(program):
        text = path.read_text() if path.exists() else f"# weft {path.stem}\n\n"
        if not BLOCK.search(text):
            text += f"<!-- help of weft {path.stem} -->\n<!-- end of help -->\n"
        new = renewed(text, program)
        if not path.exists() or new != path.read_text():
            wrong[path] = new
    scene = HERE / "scene.md"
    new = scene_with_keys(scene.read_text())
    if new != scene.read_text():
        wrong[scene] = new
    return wrong


def main():
    program, check = sys.argv[1], "--check" in sys.argv[2:]
    wrong = outdated(program)
    for path, text in wrong.items():
        print(path.name)
        if not check:
            path.write_text(text)
    return 1 if check and wrong else 0


if __name__ == "__main__":
    sys.exit(main())
