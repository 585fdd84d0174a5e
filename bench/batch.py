#!/usr/bin/env python3
"""Runs some 300 jobs as batches of every kind, with what kills them, and tells whether each was done once, as alone; and what a job costs.

The jobs: every mesh of a folder and built-in shapes converted at many sizes, drapes, two that fail, one that exceeds its memory and one its
time. What the program refuses alone, as a size that is too small for a mesh, has to fail, too.

Usage: bench/batch.py [--meshes FOLDER] [--sizes N] [--cost] [--write]
"""
import argparse
import contextlib
import hashlib
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

import program
import psutil

PYTHON = program.ROOT / "build/release/python"
BATCH = ["/usr/bin/python3", "-m", "weft.batch"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(PYTHON)}
BODIES = ("sphere", "torus", "knot", "double_torus", "cylinder", "cone", "box")
SHAPES = (*BODIES, "disk", "skirt", "rod")
BAD = [{"command": "convert", "mesh": "builtin:shoe", "size": 17},
       {"command": "drape", "cloth": "builtin:sheet", "body": "builtin:shoe", "size": 17, "frames": 5},
       {"command": "convert", "mesh": "builtin:mannequin", "size": 1025, "memory": 30},
       {"command": "drape", "cloth": "builtin:sheet", "body": "builtin:mannequin", "size": 65, "frames": 100000, "timeout": 2}]
COLUMNS = ("run", "jobs done once", "failures named", "hashes of single runs", "attempts, most", "seconds", "jobs a second")


def jobs_of(meshes, sizes):
    paths = program.meshes_in(meshes, ())
    converted = [{"command": "convert", "mesh": str(path), "size": 33 + 32 * k} for path in paths for k in range(sizes)]
    converted += [{"command": "convert", "mesh": f"builtin:{shape}", "size": 17 + 2 * k} for shape in SHAPES for k in range(20)]
    draped = [{"command": "drape", "cloth": "builtin:sheet", "body": f"builtin:{body}", "size": size, "frames": 5}
              for body in BODIES for size in (17, 25, 33)]
    return converted + draped + BAD if paths else []


def name_of(job):
    """The same for a job and its row."""
    words = [job[key] for key in ("mesh", "cloth", "body") if key in job] or job["inputs"]
    options = job.get("options", job)
    return job["command"], *words, options["size"], options.get("seed")


def single_hash(job, folder):
    """Of the program run alone; None where it refuses."""
    words = [job[key] for key in ("mesh", "cloth", "body") if key in job]
    out = folder / ("alone.exr" if job["command"] == "convert" else "alone")
    options = [word for key in ("size", "frames", "seed") if key in job for word in (f"--{key}", job[key])]
    report, error = program.run(job["command"], *words, "-o", out, "--threads", 1, *options)
    if error:
        return None
    return report.get("state_hash") or hashlib.sha256(out.read_bytes()).hexdigest()[:16]


class Run:
    """A batch of a file of jobs in a folder of its own."""

    def __init__(self, folder, *words):
        self.folder = folder
        self._command = [*BATCH, folder.parent / "jobs.jsonl", "-o", folder, "--quiet", *words]

    def begin(self):
        return subprocess.Popen(self._command, env=ENVIRONMENT, stderr=subprocess.DEVNULL)

    def rows(self):
        path = self.folder / "results.jsonl"
        return [json.loads(line) for line in path.read_text().splitlines(True) if line.endswith("\n")] if path.exists() else []

    def wait_for_rows(self, count, process):
        while len(self.rows()) < count and process.poll() is None:
            time.sleep(0.02)


def workers_at_work(parents):
    """Processes below some whose child is the program, a job in their hands."""
    found = []
    for parent in parents:
        with contextlib.suppress(psutil.NoSuchProcess):
            found += [child.parent() for child in parent.children(recursive=True) if child.name() == "weft"]
    return [worker for worker in found if worker is not None]


def kill_a_worker(parents, process):
    while process.poll() is None:
        if victims := workers_at_work(parents):
            with contextlib.suppress(psutil.NoSuchProcess):
                victims[0].kill()
                return
        time.sleep(0.01)


def plain(run):
    run.begin().wait()


def interrupted(run, jobs, parents=None):
    """A worker is killed after a quarter of the jobs, the command after a half; then it is run again."""
    process = run.begin()
    run.wait_for_rows(jobs // 4, process)
    kill_a_worker(parents or [psutil.Process(process.pid)], process)
    run.wait_for_rows(jobs // 2, process)
    process.send_signal(signal.SIGKILL)
    process.wait()
    plain(run)


@contextlib.contextmanager
def scheduler(folder, workers):
    """(its address, its workers' processes)."""
    told, started = folder / "scheduler.json", []

    def start(*words):
        started.append(subprocess.Popen(["/usr/bin/python3", "-m", *words], env=ENVIRONMENT, cwd=folder, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL))
    try:
        start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(told))
        while not told.exists():
            time.sleep(0.1)
        time.sleep(0.5)
        address = json.loads(told.read_text())["address"]
        for _ in range(workers):
            start("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard", "--local-directory", str(folder))
        time.sleep(8)  # until they have joined
        yield address, [psutil.Process(process.pid) for process in started[1:]]
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait()


def row_of(kind, run, alone, action):
    """alone: of the name of each job the hash of its result, or None where it has to fail."""
    began = time.monotonic()
    action()
    seconds = time.monotonic() - began
    rows = run.rows()
    done = [row for row in rows if row["status"] == "done"]
    once = {name_of(row): row for row in done}
    named = {name_of(row) for row in rows if row["status"] == "failed"}
    bad = {name for name, found in alone.items() if found is None}
    good = len(alone) - len(bad)
    equal = sum(alone[name] == row["hash"] for name, row in once.items())
    rate = "" if "killed" in kind else f"{len(alone) / seconds:.2f}"
    others = "" if named <= bad else f", {len(named - bad)} OTHERS"
    twice = "" if len(done) == len(once) else f", {len(done) - len(once)} TWICE"
    print(f"{kind}: {seconds:.0f} s", file=sys.stderr)
    attempts = max(row.get("attempt", 1) for row in rows)
    return [kind, f"{len(once)} of {good}{twice}", f"{len(named & bad)} of {len(bad)}{others}", f"{equal} of {good}", attempts,
            f"{seconds:.0f}", rate]


def table_of(folder, jobs):
    (folder / "jobs.jsonl").write_text("".join(json.dumps(job) + "\n" for job in jobs))
    alone = {name_of(job): None if job in BAD else single_hash(job, folder) for job in jobs}
    rows = []
    for workers in (1, 2):
        run = Run(folder / f"local-{workers}", "--workers", str(workers))
        rows.append(row_of(f"{workers} worker{'s' * (workers > 1)}", run, alone, lambda: plain(run)))
    run = Run(folder / "killed", "--workers", "2")
    rows.append(row_of("2 workers, one killed, then the command", run, alone, lambda: interrupted(run, len(jobs))))
    with scheduler(folder, 2) as (address, workers):
        run = Run(folder / "scheduler", "--scheduler", address)
        rows.append(row_of("a scheduler's 2 workers, one killed, then the command", run, alone, lambda: interrupted(run, len(jobs), workers)))
    return program.table(COLUMNS, rows)


def cost_of_a_job(folder, count=100):
    """What a batch of one worker takes more than the program alone, in processor seconds: other programs change those least."""
    jobs = [{"command": "convert", "mesh": "builtin:sphere", "size": 17, "seed": k} for k in range(count + 1)]

    def seconds(action):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        action()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    alone = seconds(lambda: [single_hash(job, folder) for job in jobs[1:]]) / count
    taken = []
    for name, some in (("one", jobs[:1]), ("many", jobs)):
        (folder / name).mkdir()
        (folder / name / "jobs.jsonl").write_text("".join(json.dumps(job) + "\n" for job in some))
        taken.append(seconds(lambda: plain(Run(folder / name / "out", "--workers", "1"))))
    each = (taken[1] - taken[0]) / count
    return (f"{count} conversions of {1000 * alone:.0f} ms of processor time each took {1000 * (each - alone):.0f} ms more each as jobs of one worker; "
            f"a batch of one job took {taken[0]:.1f} s of it.\n")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--meshes", type=pathlib.Path, default=program.ROOT.parent / "shared/meshes")
    words.add_argument("--sizes", type=int, default=3, help="of each mesh")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    words.add_argument("--cost", action="store_true", help="measure what a job costs, and nothing else")
    options = words.parse_args()
    jobs = jobs_of(options.meshes, options.sizes)
    if not jobs:
        print(f"bench: error: no meshes in {options.meshes}", file=sys.stderr)
        return 3
    with tempfile.TemporaryDirectory() as name:
        text = cost_of_a_job(pathlib.Path(name)) if options.cost else table_of(pathlib.Path(name), jobs)
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "batch_cost" if options.cost else "batch", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
