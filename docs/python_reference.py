#!/usr/bin/env python3
"""Writes docs/python-reference.md from the docstrings of the module: python_reference.py, with the module on PYTHONPATH."""
import importlib
import inspect
import pathlib
import textwrap

PAGE = pathlib.Path(__file__).with_name("python-reference.md")
MODULES = ("weft", "weft.omages", "weft.garmage")
HEAD = """# Python reference

Made from the docstrings by `./dev pages`; [the guide](python.md) tells how these go together.
"""


def signature_of(name, thing):
    found = inspect.signature(thing)
    kept = [kind for key, kind in found.parameters.items() if key not in ("self", "cls")]
    return name + str(found.replace(parameters=kept))


def text_of(thing):
    """The docstring: what it begins with, and a block of the rest as it is laid out there."""
    first, _, rest = inspect.getdoc(thing).partition("\n")
    rest = rest.strip("\n")
    return first + (f"\n\n```text\n{rest}\n```" if rest else "")


def members_of(kind):
    """Lines of a class's own methods and properties, in the order of its source."""
    for key, value in vars(kind).items():
        if key.startswith("_"):
            continue
        if isinstance(value, property):
            yield f"- `{key}`: {indented(text_of(value.fget))}"
        elif isinstance(value, classmethod) or inspect.isfunction(value):
            function = value.__func__ if isinstance(value, classmethod) else value
            yield f"- `{signature_of(key, function)}`: {indented(text_of(function))}"


def indented(text):
    return textwrap.indent(text, "  ").lstrip()


def entry(module, name):
    thing = getattr(module, name)
    whole = f"{module.__name__}.{name}"
    if not inspect.isclass(thing):
        return f"## `{whole}`\n\n`{signature_of(name, thing)}`\n\n{text_of(thing)}\n"
    constructed = "" if issubclass(thing, (Exception, tuple)) or name in ("Chart", "Cloth", "Frame", "GeometryImage") else \
        f"`{signature_of(name, thing)}`\n\n"
    members = "\n".join(members_of(thing)) if not issubclass(thing, (Exception, tuple)) else ""
    return f"## `{whole}`\n\n{constructed}{text_of(thing)}\n" + (f"\n{members}\n" if members else "")


def page():
    parts = [HEAD]
    for module in map(importlib.import_module, MODULES):
        parts.append(f"# `{module.__name__}`\n\n{text_of(module)}\n")
        parts += [entry(module, name) for name in module.__all__]
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page())
