"""The command: python3 -m weft.batch JOBS -o DIR."""
import argparse
import csv
import glob
import json
import os
import shutil
import sys

from .. import __version__
from ..errors import Error
from . import jobs as reading
from . import running, slurm
from .store import STORES, Ledger

DONE, INTERNAL, USAGE, INPUT, FAILED, INTERRUPTED = 0, 1, 2, 3, 4, 130


def _count(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text}: a number from 1 is wanted")
    return value


def _retries(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text}: a number from 0 is wanted")
    return value


def _amount(text):
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text}: a number above 0 is wanted")
    return value


def _part(text):
    index, _, count = text.partition("/")
    if not (index.isdigit() and count.isdigit() and int(index) < int(count)):
        raise argparse.ArgumentTypeError(f"{text}: I/N with I from 0 below N is wanted")
    return int(index), int(count)


def _arguments(given):
    parser = argparse.ArgumentParser(prog="weft.batch", description="Runs thousands of jobs of the program, each once.",
                                     epilog="Example: python3 -m weft.batch jobs.csv -o out --workers 8")
    parser.add_argument("jobs", metavar="JOBS", help="CSV or JSON-lines file, a job a line; or a folder of meshes to convert")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="where everything goes, and is found again")
    parser.add_argument("--scheduler", default="local", metavar="local|tcp://HOST:PORT", help="workers of this command, or a scheduler of Dask")
    parser.add_argument("--workers", type=_count, default=len(os.sched_getaffinity(0)), help="of this command (default: %(default)s)")
    parser.add_argument("--threads", type=_count, default=1, help="of each job (default: %(default)s)")
    parser.add_argument("--retries", type=_retries, default=2, help="more attempts where a worker or the program dies (default: %(default)s)")
    parser.add_argument("--timeout", type=_amount, metavar="S", help="seconds that a job may take; a job's own 'timeout' stands before it")
    parser.add_argument("--memory", type=_amount, metavar="MB",
                        help="memory that a job may take; a job's own 'memory' stands before it (default: its share of this machine's)")
    parser.add_argument("--store", choices=tuple(STORES), default="folder", help="a folder a job, HDF5 files, or groups of Zarr (default: %(default)s)")
    parser.add_argument("--slurm", type=_count, metavar="TASKS", help="write DIR/slurm.sh, an array of so many tasks, and run nothing")
    parser.add_argument("--part", type=_part, metavar="I/N", help="run every N-th job alone, from the I-th: a task of an array")
    parser.add_argument("--dashboard", type=int, default=0, metavar="PORT", help="of Dask's pages on 127.0.0.1 (default: any free one)")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--version", action="version", version=f"weft {__version__}")
    return parser.parse_args(given)


def _summary(jobs, rows):
    """Lines of a table: jobs by command, and each failure."""
    lines = [f"{'command':<10}{'jobs':>7}{'done':>7}{'failed':>8}{'seconds':>10}{'worst':>28}"]
    for command in dict.fromkeys(job.command for job in jobs):
        own = [rows[job.id] for job in jobs if job.command == command and job.id in rows]
        done = [row for row in own if row["status"] == "done"]
        if command == "convert":
            worst = f"{min((row['psnr_db'] for row in done), default=float('nan')):.1f} dB"
        else:
            worst = f"{100 * max((row['strain']['max'] for row in done), default=float('nan')):.1f} % strain, " \
                    f"{max((row['intersections'] for row in done), default=0)} crossed"
        seconds = sum(row.get("seconds", 0) for row in own)
        lines.append(f"{command:<10}{len(own):>7}{len(done):>7}{len(own) - len(done):>8}{seconds:>10.1f}{worst:>28}")
    for job in jobs:
        row = rows.get(job.id)
        if row and row["status"] != "done":
            lines.append(f"failed {row['id']} {row['command']} {' '.join(row['inputs'])}: {row['error']}")
    return lines


def _write_index(folder, jobs, rows):
    """DIR/index.csv: where the result of each job is."""
    temporary = os.path.join(folder, f"index.csv.{os.getpid()}.tmp")
    with open(temporary, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(["id", "command", "inputs", "options", "place"])
        for job in jobs:
            row = rows.get(job.id)
            if row and row["status"] == "done":
                table.writerow([job.id, job.command, " ".join(job.words), json.dumps(job.options, sort_keys=True), row["place"]])
    os.replace(temporary, os.path.join(folder, "index.csv"))


def _take_left(folder, rows, store, ledger, wanted):
    """Rows of jobs whose worker was done when this command was killed."""
    place = os.path.join(folder, "jobs")
    for name in sorted(os.listdir(place)) if os.path.isdir(place) else ():
        told = os.path.join(place, name, "row.json")
        if name in wanted and rows.get(name, {}).get("status") != "done" and os.path.exists(told):
            with open(told, encoding="utf-8") as file:
                row = json.load(file)
            row["place"] = store.take(row)
            ledger.add(row)
            rows[name] = row


def _clear_work(folder, part):
    """Removes what killed runs left in DIR/work, or in that of a part alone, as others are at work beside it; of all parts, where all are run."""
    work = os.path.join(folder, "work" if part is None else f"work-{part}")
    others = glob.glob(os.path.join(glob.escape(folder), "work-*")) if part is None else []
    for left in (work, *others):
        shutil.rmtree(left, ignore_errors=True)
    return work


def _run_left(options, jobs, work, take):
    """Runs what is not done yet, and hands each row to `take`."""
    from . import schedule  # Dask takes a second to load
    workers = min(options.workers, len(jobs))
    limits = {"timeout": options.timeout, "threads": options.threads,
              "memory": options.memory or schedule.memory_share(workers, os.environ)}
    os.makedirs(work)
    client, cluster = schedule.connect(options.scheduler, workers, options.retries, options.dashboard, work)
    try:
        if not options.quiet:
            link = schedule.pages(client)
            print(f"{len(jobs)} jobs" + (f"; Dask tells of its workers at {link}" if link else ""), file=sys.stderr, flush=True)
        schedule.run(client, jobs, os.path.abspath(options.output), work, limits, options.retries, options.quiet, take)
    finally:
        client.close()
        if cluster is not None:
            cluster.close()
    shutil.rmtree(work, ignore_errors=True)


def _run(options, jobs):
    part = None if options.part is None else options.part[0]
    folder, wanted = os.path.abspath(options.output), {job.id for job in jobs}
    store, ledger = STORES[options.store](folder, part), Ledger(options.output, part)
    rows = {key: row for key, row in ledger.rows().items() if key in wanted and (row["status"] != "done" or store.holds(row))}
    _take_left(folder, rows, store, ledger, wanted)
    left = [job for job in jobs if rows.get(job.id, {}).get("status") != "done"]
    work = _clear_work(folder, part)
    if not options.quiet and len(left) < len(jobs):
        print(f"{len(jobs) - len(left)} of {len(jobs)} jobs are done already", file=sys.stderr)

    def take(row):
        if row["status"] == "done":
            row["place"] = store.take(row)
        ledger.add(row)
        rows[row["id"]] = row
    try:
        if left:
            _run_left(options, left, work, take)
    finally:
        store.close()
        ledger.close()
    if part is None:
        _write_index(folder, jobs, rows)
    return rows


def main(given=None):
    """Runs the command; returns its exit code."""
    options = _arguments(given)
    try:
        program = running.find_program()
        if program is None:
            raise Error("no program weft; WEFT_PROGRAM, or weft on the PATH, is wanted")
        if not os.path.exists(options.jobs):
            raise Error(f"{options.jobs}: no such file; a file of jobs or a folder of meshes is wanted")
        jobs = reading.Reader(program).read(options.jobs)
        if options.slurm:
            path = slurm.write(jobs, options.output, program, vars(options))
            print(f"wrote {path}: {len(jobs)} jobs")
            return DONE
        if options.part is not None:
            jobs = jobs[options.part[0]::options.part[1]]
        rows = _run(options, jobs)
    except Error as error:
        print(f"weft.batch: error: {error}", file=sys.stderr)
        return INPUT
    except KeyboardInterrupt:
        print("weft.batch: error: interrupted; what was finished is kept", file=sys.stderr)
        return INTERRUPTED
    if not options.quiet:
        print("\n".join(_summary(jobs, rows)))
    return DONE if all(rows.get(job.id, {}).get("status") == "done" for job in jobs) else FAILED


if __name__ == "__main__":
    sys.exit(main())
