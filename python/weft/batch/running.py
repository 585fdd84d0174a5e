"""One job on a worker: the program as a process of its own, ended where it takes too long or too much memory."""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

import psutil

LOOK = 0.05  # seconds between two looks at what the program takes


class TryAgain(Exception):
    """A run that ended for no reason of its job's own; another worker may do better."""


def find_program():
    """The program: of WEFT_PROGRAM, beside this package as built or installed, or on PATH. None where there is none."""
    here = pathlib.Path(__file__)
    package = here.parent.parent if here.is_symlink() else here.resolve().parent.parent
    beside = [package.parents[1] / "bin/weft", package.parents[3] / "bin/weft"]
    for name in (os.environ.get("WEFT_PROGRAM"), *beside, shutil.which("weft")):
        if name and os.access(name, os.X_OK) and os.path.isfile(name):
            return str(name)
    return None


def execute(job, folder, work, limits):
    """Runs a job in the folder `work` and moves what it made to DIR/jobs/ID, or what tells of its failure to DIR/failed/ID.

    limits: {"timeout": seconds, "memory": MB, "threads"}, where the job has none of its own.
    Returns the row of results.jsonl. Raises TryAgain.
    """
    place, attempt = _own_place(work, job.id)
    began = time.time()
    _write(place, "job.json", {"id": job.id, "job": job.line(), "arguments": job.arguments(".")})
    made = os.path.join(place, "made")
    os.mkdir(made)
    program = find_program()
    if program is None:
        raise TryAgain(f"no program weft on {socket.gethostname()}")
    arguments = job.arguments(made)
    if "--threads" not in arguments:
        arguments += ["--threads", str(limits["threads"])]
    code, error, peak = _run([program, *arguments], place, job.timeout or limits["timeout"], job.memory or limits["memory"])
    row = {"id": job.id, "command": job.command, "inputs": job.words, "options": job.options, "attempt": attempt,
           "host": socket.gethostname(), "seconds": round(time.time() - began, 3), "peak_memory_mb": round(peak, 1)}
    if code == 0:
        row |= {"status": "done", **_figures(job, place, made)}
        _move(place, os.path.join(folder, "jobs", job.id), row)
        return row
    if error is None and code in (1, *range(-64, 0)):
        raise TryAgain(f"the program ended with {_cause(code)}: {_last_line(place)}")
    row |= {"status": "failed", "exit": code, "error": error or _last_line(place)}
    _move(place, os.path.join(folder, "failed", job.id), row)
    return row


def _own_place(work, name):
    """A folder of this attempt alone, and its number."""
    for attempt in range(1, 10000):
        place = os.path.join(work, f"{name}.{attempt}")
        try:
            os.mkdir(place)
            return place, attempt
        except FileExistsError:
            continue
    raise TryAgain(f"too many attempts in {work}")


def _write(place, name, value):
    with open(os.path.join(place, name), "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1)


def _run(command, place, timeout, memory):
    """(exit code, why it was ended or None, peak memory in MB). The program dies with this process."""
    with open(os.path.join(place, "report.json"), "w", encoding="utf-8") as out, \
            open(os.path.join(place, "messages.txt"), "w", encoding="utf-8") as messages:
        process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *command], stdin=subprocess.DEVNULL, stdout=out, stderr=messages)
    end, peak, told = time.monotonic() + timeout if timeout else None, 0.0, psutil.Process(process.pid)
    try:
        while process.poll() is None:
            try:
                peak = max(peak, told.memory_info().rss / 1e6)
            except psutil.NoSuchProcess:
                pass
            if memory and peak > memory:
                return _end(process), f"ended with {peak:.0f} MB; {memory:g} MB at most were wanted", peak
            if end and time.monotonic() > end:
                return _end(process), f"ended after {timeout:g} s; less was wanted", peak
            try:
                process.wait(LOOK)
            except subprocess.TimeoutExpired:
                pass
    finally:
        if process.poll() is None:
            _end(process)
    return process.returncode, None, peak


def _end(process):
    process.kill()
    return process.wait()


def _cause(code):
    return f"exit code {code}" if code > 0 else f"signal {signal.Signals(-code).name}"


def _last_line(place):
    with open(os.path.join(place, "messages.txt"), encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    return lines[-1] if lines else "nothing was said"


def _figures(job, place, made):
    """What a row tells of a report: quality of images, strain and intersections of cloth, and the hash of the result."""
    with open(os.path.join(place, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    if job.command == "convert":
        with open(os.path.join(made, "image.exr"), "rb") as file:
            name = hashlib.sha256(file.read()).hexdigest()[:16]
        image = report["image"]
        return {"hash": name, "size": image["size"], "psnr_db": image["psnr_db"], "hausdorff_percent": image["hausdorff_percent"],
                "charts": len(report["charts"])}
    sewn = {key: report[key] for key in ("seams", "fell_off") if key in report}
    return {"hash": report["state_hash"], "frames": report["frames"], "strain": report["strain"], "intersections": report["intersections"], **sewn}


def _move(place, there, row):
    """Puts an attempt's folder in place, with its row in it: whole, or not at all."""
    _write(place, "row.json", row)
    os.makedirs(os.path.dirname(there), exist_ok=True)
    old = None
    if os.path.exists(there):
        old = f"{place}.old"
        os.rename(there, old)
    os.rename(place, there)
    if old:
        shutil.rmtree(old, ignore_errors=True)
