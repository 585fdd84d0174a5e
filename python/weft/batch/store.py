"""Where results are: a folder a job, HDF5 files of many jobs each, or a group of Zarr a job; and the rows that tell of them."""
import fcntl
import glob
import importlib
import json
import os
import shutil

import numpy as np

from .. import caches, images
from ..errors import OutputError, UsageError

SHARD_JOBS = 256  # in one HDF5 file


def _locked(folder, name, kind):
    """A file that is locked until it is closed."""
    file = open(os.path.join(folder, name), "a+")  # noqa: SIM115
    try:
        fcntl.flock(file, kind | fcntl.LOCK_NB)
    except OSError as error:
        file.close()
        raise OutputError(f"{folder}: another run is at work there", where=str(folder)) from error
    return file


class Ledger:
    """results.jsonl: one row a job that ended, written by one process.

    Parts of the jobs may be at work side by side, each with rows of its own in results-PART.jsonl; what runs all jobs is alone, and
    moves those rows to its own.
    """

    def __init__(self, folder, part=None):
        os.makedirs(folder, exist_ok=True)
        self.folder = folder
        self._locks = [_locked(folder, ".lock", fcntl.LOCK_EX if part is None else fcntl.LOCK_SH)]
        if part is not None:
            self._locks.append(_locked(folder, f".lock-{part}", fcntl.LOCK_EX))
        self.path = os.path.join(folder, "results.jsonl" if part is None else f"results-{part}.jsonl")
        self._drop_torn_line()
        if part is None:
            self._gather_parts()
        self._file = open(self.path, "a", encoding="utf-8")  # noqa: SIM115

    def _drop_torn_line(self):
        """What a killed run had begun to write."""
        if not os.path.exists(self.path):
            return
        with open(self.path, "rb+") as file:
            data = file.read()
            file.truncate(data.rfind(b"\n") + 1)

    def _gather_parts(self):
        """Killed between any two lines of it, the next one does the rest."""
        parts = sorted(glob.glob(os.path.join(glob.escape(self.folder), "results-*.jsonl")))
        if not parts:
            return
        lines = {}  # in order, each once
        for path in (self.path, *parts):
            if os.path.exists(path):
                with open(path, encoding="utf-8") as file:
                    lines |= {line: None for line in file if line.endswith("\n")}
        temporary = f"{self.path}.tmp"
        with open(temporary, "w", encoding="utf-8") as file:
            file.writelines(lines)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, self.path)
        for path in parts:
            os.unlink(path)

    def rows(self):
        """The last row of each job, of all parts: {id: row}."""
        found = {}
        for path in sorted(glob.glob(os.path.join(glob.escape(self.folder), "results*.jsonl"))):
            with open(path, encoding="utf-8") as file:
                for line in file:
                    if line.endswith("\n"):
                        row = json.loads(line)
                        if found.get(row["id"], {}).get("status") != "done":
                            found[row["id"]] = row
        return found

    def add(self, row):
        self._file.write(json.dumps(row) + "\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def close(self):
        self._file.close()
        for lock in self._locks:
            lock.close()


class Folders:
    """DIR/jobs/ID, as the worker left it."""

    def __init__(self, folder, part=None):
        self._folder = folder

    def holds(self, row):
        return os.path.isdir(os.path.join(self._folder, "jobs", row["id"]))

    def take(self, row):
        """Where a job's result is, beside DIR."""
        return os.path.join("jobs", row["id"])

    def close(self):
        """Nothing is open."""


class Hdf5:
    """DIR/shards/*.h5: a group a job, with the arrays of what it made; attributes tell of the job.

    Of an image: ``positions`` (n, n, 3) float64 [m], ``classes`` (n, n) int32. Of a run: each point cache under its name, (T, n, 3)
    float32 [m].
    """

    def __init__(self, folder, part=None):
        self._h5py, self._folder, self._file, self._count = _package("h5py"), folder, None, 0
        self._prefix = "" if part is None else f"{part}-"

    def holds(self, row):
        path = os.path.join(self._folder, row.get("place", "").split(":")[0])
        if not os.path.isfile(path):
            return False
        try:
            with self._h5py.File(path, "r") as file:
                return row["id"] in file and file[row["id"]].attrs.get("whole", False)
        except BlockingIOError:  # another task's, at work on it; rows are told after what they tell of was written
            return True
        except OSError:  # killed while it was written
            if os.path.basename(path).startswith(self._prefix):
                os.rename(path, f"{path}.damaged")
            return False

    def _open(self):
        if self._file is not None and self._count < SHARD_JOBS:
            return self._file
        self.close()
        os.makedirs(os.path.join(self._folder, "shards"), exist_ok=True)
        number = 0
        while os.path.exists(self._path(number)) or os.path.exists(self._path(number) + ".damaged"):
            number += 1
        self._file, self._count, self._number = self._h5py.File(self._path(number), "w"), 0, number
        return self._file

    def _path(self, number):
        return os.path.join(self._folder, "shards", f"{self._prefix}{number:05}.h5")

    def take(self, row):
        made = os.path.join(self._folder, "jobs", row["id"])
        file = self._open()
        group = file.create_group(row["id"])
        for name, array in arrays_of(os.path.join(made, "made")):
            group.create_dataset(name, data=array, compression="gzip", compression_opts=4, shuffle=True)
        group.attrs["row"] = json.dumps(row)
        text = _report(made)
        if len(text) < 60000:  # attributes of this format are small
            group.attrs["report"] = text
        group.attrs["whole"] = True
        self._count += 1
        file.flush()
        shutil.rmtree(made)
        return f"{os.path.relpath(self._path(self._number), self._folder)}:{row['id']}"

    def close(self):
        if self._file is not None:
            self._file.close()
            self._file = None


class Zarr:
    """DIR/arrays.zarr: a group a job, with the arrays and attributes of `Hdf5`; every array is a folder of compressed chunks."""

    def __init__(self, folder, part=None):
        self._zarr, self._folder, self._path = _package("zarr"), folder, os.path.join(folder, "arrays.zarr")

    def holds(self, row):
        return os.path.isfile(os.path.join(self._path, row["id"], ".zattrs"))

    def take(self, row):
        made = os.path.join(self._folder, "jobs", row["id"])
        group = self._zarr.open_group(self._path, mode="a").create_group(row["id"], overwrite=True)  # of one killed in mid-write
        for name, array in arrays_of(os.path.join(made, "made")):
            group.create_dataset(name, data=array)
        group.attrs.put({"row": json.dumps(row), "report": _report(made)})  # last: they say that all is there
        shutil.rmtree(made)
        return os.path.join("arrays.zarr", row["id"])

    def close(self):
        """Nothing is open."""


def _package(name):
    """A package of Python, imported only where it is asked for."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise UsageError(f"python3-{name} is not installed, which this store wants: {error}", found="no package " + name,
                         wanted="python3-" + name) from error


def _report(made):
    """What the program told of a job."""
    with open(os.path.join(made, "report.json"), encoding="utf-8") as file:
        return file.read()


def arrays_of(made):
    """(name, array) of what a job made."""
    for path in sorted(glob.glob(os.path.join(glob.escape(made), "*"))):
        name = os.path.basename(path)
        if name == "image.exr":
            image = images.load(path)
            yield "positions", np.asarray(image.positions)
            yield "classes", image.classes
        elif name.endswith(".pc2"):
            yield name[:-4], caches.read_pc2(path)[0]


STORES = {"folder": Folders, "hdf5": Hdf5, "zarr": Zarr}
