"""Jobs on the workers of Dask: sent, waited for, tried again; a row for each that ended."""
import asyncio
import os
import sys
import time

import dask
import distributed
import psutil

from .. import __version__
from ..errors import InputError
from . import running

LOCAL = "local"


def probe():
    """What a worker has."""
    return {"version": __version__, "program": running.find_program() is not None}


def _local_cluster(workers, retries, dashboard, work):
    dask.config.set({"distributed.scheduler.allowed-failures": retries, "distributed.worker.memory.terminate": False,
                     "distributed.worker.memory.pause": False, "distributed.worker.memory.spill": False,
                     "distributed.worker.memory.target": False})
    return distributed.LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, memory_limit=0,
                                    dashboard_address=f"127.0.0.1:{dashboard}", host="127.0.0.1", silence_logs="CRITICAL",
                                    local_directory=work)  # not /tmp, where what others left is told of


def connect(scheduler, workers, retries, dashboard, work):
    """(client, what to close after it); work: a folder for workers of this command.

    Raises InputError where no scheduler answers, or a worker lacks Weft."""
    if scheduler == LOCAL:
        cluster = _local_cluster(workers, retries, dashboard, work)
        return distributed.Client(cluster, set_as_default=False), cluster
    try:
        client = distributed.Client(scheduler, timeout=10, set_as_default=False)
    except (OSError, ValueError, asyncio.TimeoutError) as error:
        raise InputError(f"{scheduler}: no scheduler answers: {error}", where=scheduler) from error
    try:
        found = client.run(probe)
    except Exception as error:  # whatever a worker's import raises
        client.close()
        raise InputError(f"{scheduler}: a worker cannot import weft.batch: {error}; the package on the PYTHONPATH of all workers is "
                         "wanted", where=scheduler) from error
    for worker, has in found.items():
        if has["version"] != __version__ or not has["program"]:
            client.close()
            raise InputError(f"{worker}: Weft {has['version']}{'' if has['program'] else ' without its program'}; "
                             f"{__version__} with its program is wanted", where=worker)
    return client, None


def pages(client):
    """Where Dask's table of its workers is, which leads to its other pages; None for a scheduler that was started without any."""
    try:
        return client.dashboard_link.removesuffix("status") + "info/main/workers.html"
    except KeyError:
        return None


def memory_share(workers, environment):
    """MB that each of some workers of this machine may take. A task of Slurm has as much of it as it has been given, or as of its processors."""
    free = psutil.virtual_memory().available / 1e6
    processors, node, each = (int(environment.get(f"SLURM_{name}", 0)) for name in ("CPUS_ON_NODE", "MEM_PER_NODE", "MEM_PER_CPU"))
    given = 1.048576 * (node or each * processors)
    if given:
        free = min(free, given)
    elif processors:
        free *= min(1, processors / psutil.cpu_count())
    return 0.9 * free / workers


class Progress:
    """Done, failed, left, rate and time to go: one line that is renewed on a terminal, one now and then elsewhere."""

    def __init__(self, left, quiet):
        self.left, self.done, self.failed = left, 0, 0
        self._began, self._last, self._quiet = time.monotonic(), 0.0, quiet
        self._terminal = sys.stderr.isatty()

    def add(self, row):
        self.left -= 1
        if row["status"] == "done":
            self.done += 1
        else:
            self.failed += 1
        now = time.monotonic()
        if not self._quiet and (now - self._last > (0.2 if self._terminal else 10) or self.left == 0):
            self._last = now
            self._tell(now - self._began)

    def _tell(self, seconds):
        rate = (self.done + self.failed) / max(seconds, 1e-9)
        line = f"done {self.done}, failed {self.failed}, left {self.left}; {rate:.2f} a second, {self.left / max(rate, 1e-9):.0f} s to go"
        end = "\r" if self._terminal and self.left else "\n"
        print(f"{line:<78}", end=end, file=sys.stderr, flush=True)


def failed_row(job, error):
    """The row of a job whose attempts all ended otherwise than by its own failure."""
    kind = type(error).__name__
    text = str(error).splitlines()[0] if str(error) else ""
    if isinstance(error, distributed.KilledWorker):
        text = "every worker that tried it died"
    return {"id": job.id, "command": job.command, "inputs": job.words, "options": job.options, "status": "failed", "error": text or kind}


def run(client, jobs, folder, work, limits, retries, quiet, take):
    """Runs jobs and hands each row to `take`. Failures of workers cost their job an attempt; `retries` more are given.

    work: a folder beside the results that nothing else uses."""
    progress = Progress(len(jobs), quiet)
    known = {f"weft-{job.id}": job for job in jobs}
    futures = [client.submit(running.execute, job, folder, work, limits, key=key, retries=retries, pure=False) for key, job in known.items()]
    waiting = distributed.as_completed(futures, loop=client.loop)
    try:
        for future in waiting:
            job = known[future.key]
            error = future.exception() if future.status == "error" else None
            row = future.result() if future.status == "finished" else failed_row(job, error or RuntimeError("cancelled"))
            take(row)
            progress.add(row)
            future.release()
    finally:
        client.cancel([future for future in futures if not future.done()], force=True)
    return progress
