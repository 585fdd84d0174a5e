"""Jobs: what a file of them says, with names expanded, paths resolved, and an identity."""
import csv
import glob
import hashlib
import json
import os
import re
import subprocess

from .. import __version__
from ..errors import InputError, UsageError

# The words that a command wants before its options. A job gives them by name.
WORDS = {"convert": ("mesh",), "drape": ("cloth", "body"), "simulate": ("scene",), "garment": ("pattern",)}
FILES = ("body", "cut")  # options that name files
OWN = ("command", "timeout", "memory")  # keys of this command, not of the program's
REFUSED = ("output", "json", "quiet", "help", "resume", "version")
NOT_OF_THE_RESULT = ("threads",)
# Values that make several images of one mesh, where a job makes one.
SEVERAL = {("component", "all"): "one piece a job, its number or largest,"}
MESHES = (".obj", ".off", ".ply", ".stl", ".glb", ".gltf")


class Job:
    """One run of the program: ``command``, ``words`` (its arguments in order), ``options``, limits, and ``id``."""

    def __init__(self, command, words, options, timeout=None, memory=None):
        self.command, self.words, self.options = command, words, options
        self.timeout, self.memory = timeout, memory
        self.id = None

    def named(self):
        """The files and built-in shapes that its result depends on, each in its place."""
        return [*self.words, *(self.options[key] for key in FILES if key in self.options)]

    def arguments(self, output):
        """The program's arguments, with what it writes in a folder."""
        place = os.path.join(output, "image.exr") if self.command == "convert" else output
        flags = [word for key, value in sorted(self.options.items()) for word in _flags(key, value)]
        return [self.command, *self.words, "-o", place, "--json", *flags]

    def line(self):
        """The job as a line of a file of jobs, in which its names are no patterns."""
        words = [word if word.startswith("builtin:") else glob.escape(word) for word in self.words]
        limits = {key: value for key, value in (("timeout", self.timeout), ("memory", self.memory)) if value is not None}
        return {"command": self.command, **dict(zip(WORDS[self.command], words)), **self.options, **limits}


def _flags(key, value):
    if value is True:
        return [f"--{key}"]
    if value is False:
        return []
    return [f"--{key}", _text(value)]


def _text(value):
    return ",".join(map(str, value)) if isinstance(value, list) else str(value)


def known_options(program, command):
    """The options of a command and those of all commands, as the program's help lists them."""
    told = [subprocess.run([program, *words, "--help"], capture_output=True, text=True) for words in ([command], [])]
    if told[0].returncode != 0:
        raise UsageError(f"'{command}' is no command of {program}", found=command, wanted="a command of the program")
    return {name for help_ in told for name in re.findall(r"--([a-z][a-z-]*)", help_.stdout)}


class Reader:
    """Reads jobs and gives each its identity."""

    def __init__(self, program):
        self._program, self._options, self._hashes = program, {}, {}

    def read(self, path):
        """The jobs of a CSV or JSON-lines file, or one conversion for each mesh of a folder; each once, in order.

        Raises InputError with FILE:LINE.
        """
        jobs = {}
        for where, folder, entry in self._entries(path):
            for job in self._jobs_of(where, folder, entry):
                job.id = self.identity(job)
                jobs.setdefault(job.id, job)
        if not jobs:
            raise InputError(f"{path}: no jobs", where=str(path), found="no jobs", wanted="one at least")
        return list(jobs.values())

    def _entries(self, path):
        if os.path.isdir(path):
            for name in sorted(os.listdir(path)):
                if name.lower().endswith(MESHES):
                    yield path, path, {"command": "convert", "mesh": glob.escape(name)}
            return
        folder = os.path.dirname(os.path.abspath(path))
        with open(path, encoding="utf-8-sig", newline="") as file:
            if path.lower().endswith(".csv"):
                rows = csv.DictReader(file)
                for row in rows:
                    if None in row or None in row.values():
                        raise _wrong(f"{path}:{rows.line_num}", "not as many cells as the first line has")
                    yield f"{path}:{rows.line_num}", folder, {key.strip(): _value(cell) for key, cell in row.items() if cell.strip()}
                return
            for number, line in enumerate(file, 1):
                if line.strip():
                    yield f"{path}:{number}", folder, _object(line, f"{path}:{number}")

    def _jobs_of(self, where, folder, entry):
        command = entry.get("command", "convert")
        if command not in WORDS:
            raise _wrong(where, f"the command {command!r}", "one of " + ", ".join(WORDS))
        options = {key.replace("_", "-"): value for key, value in entry.items() if key not in (*WORDS[command], *OWN)}
        if command not in self._options:
            self._options[command] = known_options(self._program, command)
        for key, value in options.items():
            if key in REFUSED or key not in self._options[command]:
                raise _wrong(where, f"the option '{key}'", f"one that weft {command} --help lists")
            if isinstance(value, dict) or value is None:
                raise _wrong(where, f"the option '{key}'", "a number, a text, a list, true or false")
            if (key, _text(value)) in SEVERAL:
                raise _wrong(where, f"the option '{key}' with {_text(value)!r}", SEVERAL[key, _text(value)])
            if key in FILES:
                options[key] = _resolved(str(value), folder)
        missing = [word for word in WORDS[command] if word not in entry]
        if missing:
            raise _wrong(where, f"no '{missing[0]}'")
        limits = {key: _limit(entry[key], key, where) for key in ("timeout", "memory") if key in entry}
        for words in self._expanded([str(entry[word]) for word in WORDS[command]], folder, where):
            yield Job(command, words, dict(options), **limits)

    @staticmethod
    def _expanded(words, folder, where):
        """Every way to fill the words, where they are patterns of names."""
        ways = [[]]
        for word in words:
            if word.startswith("builtin:"):
                found = [word]
            else:
                found = sorted(glob.glob(os.path.join(glob.escape(folder), word), recursive=True))
                found = [os.path.abspath(name) for name in found if os.path.isfile(name)]
                if not found and glob.has_magic(word):
                    raise _wrong(where, f"no file is named {word}")
                found = found or [_resolved(word, folder)]
            ways = [[*way, name] for way in ways for name in found]
        return ways

    def identity(self, job):
        """16 hexadecimal digits over the version, the command, its options and its inputs: names of shapes, bytes of files."""
        options = {key: value for key, value in job.options.items() if key not in (*NOT_OF_THE_RESULT, *FILES)}
        parts = [__version__, job.command, json.dumps(options, sort_keys=True), *map(self._input_of, job.named())]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]

    def _input_of(self, name):
        return name if name.startswith("builtin:") else self._hash_of(name)

    def _hash_of(self, path):
        if path not in self._hashes:
            try:
                with open(path, "rb") as file:
                    data = file.read()
            except OSError:
                self._hashes[path] = f"missing {path}"  # the job will say so
                return self._hashes[path]
            whole = hashlib.sha256(data)
            self._hashes[path] = ""  # files may name each other
            for named in _named_in(path, data):
                whole.update(self._hash_of(named).encode())
            self._hashes[path] = f"{os.path.basename(path)} {whole.hexdigest()}"
        return self._hashes[path]


def _named_in(path, data):
    """Files that a scene, a pattern, a glTF file, an OBJ file or its materials name."""
    for name in _names_in(path, data):
        for named in _files_of(os.path.join(os.path.dirname(path), name)):
            if not os.path.samefile(named, path):
                yield named


def _names_in(path, data):
    """What may be names of files."""
    ending = os.path.splitext(path)[1].lower()
    if ending in (".obj", ".mtl"):
        line = rb"^[ \t]*mtllib[ \t]+(.+)$" if ending == ".obj" else rb"^[ \t]*map_\w+[ \t].*?(\S+)[ \t\r]*$"
        return [name.decode(errors="replace").strip() for name in re.findall(line, data, re.MULTILINE)]
    if ending not in (".json", ".gltf"):
        return []
    try:
        todo, names = [json.loads(data)], []
    except ValueError:
        return []
    while todo:
        value = todo.pop()
        if isinstance(value, (dict, list)):
            todo += value.values() if isinstance(value, dict) else value
        elif isinstance(value, str) and not value.startswith(("builtin:", "data:")):
            names.append(value)
    return names


def _files_of(name):
    """The file of a name, the file of FILE#CLIP, or the numbered files of a name with %d in it."""
    if len(name) > 4000 or "\0" in name:
        return []
    numbered = re.sub(r"%0?\d*d", "*", glob.escape(name))
    files = sorted(glob.glob(numbered)) if numbered != glob.escape(name) else [name, *(name[:mark.start()] for mark in re.finditer("#", name))]
    return [file for file in files if os.path.isfile(file)]


def _resolved(name, folder):
    return name if name.startswith("builtin:") else os.path.abspath(os.path.join(folder, name))


def _value(cell):
    """A cell of a CSV file: a number, true, false, or its text."""
    cell = cell.strip()
    if cell in ("true", "false"):
        return cell == "true"
    for kind in (int, float):
        try:
            return kind(cell)
        except ValueError:
            pass
    return cell


def _object(line, where):
    try:
        entry = json.loads(line)
    except ValueError as error:
        raise _wrong(where, f"no JSON: {error}") from error
    if not isinstance(entry, dict):
        raise _wrong(where, "no JSON object")
    return entry


def _limit(value, key, where):
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
        raise _wrong(where, f"{key} {value!r}", "a number above 0")
    return value


def _wrong(where, found, wanted="a job"):
    return InputError(f"{where}: {found}; {wanted} is wanted", where=where, found=found, wanted=f"{wanted} is wanted")
