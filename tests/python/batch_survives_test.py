"""Batches of which workers, tasks or the command itself are killed: every job once all the same."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import unittest
import urllib.request

import weft.batch.jobs
from batch_case import BATCH, PATIENCE, BatchTest, conversion, drape
from module import small_torus

import distributed
import psutil


class BatchSurvives(BatchTest):
    # Some that are at work for a while, between others that are done at once.
    JOBS = [conversion("knot", 129), *({"command": "convert", "mesh": "small.obj", "size": size} for size in (17, 25, 33, 65)),
            drape("torus", 6, 33), conversion("torus")]

    def setUp(self):
        super().setUp()
        weft.write_mesh("small.obj", *small_torus())

    def workers_at_work(self, process):
        """Of a batch: processes whose child is the program."""
        try:
            return [child.parent() for child in psutil.Process(process.pid).children(recursive=True)
                    if child.is_running() and child.name() == "weft" and child.ppid() != process.pid]
        except psutil.NoSuchProcess:
            return []

    def test_a_killed_worker_costs_its_job_an_attempt_and_nothing_else(self):
        process = self.begin(self.write_jobs(*self.JOBS), "-o", "out", "--workers", 2)
        victim, *_ = self.wait_for(lambda: self.workers_at_work(process), process)
        os.kill(victim.pid, signal.SIGKILL)
        said = process.communicate(timeout=PATIENCE)[0]
        self.assertEqual(process.returncode, 0, said)
        done = self.assert_each_done_once(self.JOBS)
        self.assertGreaterEqual(max(row["attempt"] for row in done), 2)

    def test_a_killed_batch_goes_on(self):
        words = (self.write_jobs(*self.JOBS), "-o", "out", "--workers", 2)
        process = self.begin(*words)
        results = self.folder / "out/results.jsonl"
        self.wait_for(lambda: results.exists() and results.read_text().count("\n") >= 2, process)
        family = psutil.Process(process.pid).children(recursive=True)
        process.kill()
        process.wait()
        _, alive = psutil.wait_procs(family, timeout=PATIENCE)
        self.assertEqual(alive, [], "nothing of it stays")
        kept = len(self.rows())
        with open(results, "a", encoding="utf-8") as file:
            file.write('{"id": "torn')  # as if it was killed while writing
        self.batch(*words)
        done = self.assert_each_done_once(self.JOBS)
        self.assertLess(kept, len(done))
        for job in (self.JOBS[0], self.JOBS[5]):
            words = [job[word] for word in weft.batch.jobs.WORDS[job["command"]]]
            (row,) = (row for row in done if row["inputs"] == words and row["options"]["size"] == job["size"])
            self.assertEqual(row["hash"], self.single_hash(job))

    def test_tasks_side_by_side_leave_each_other_alone(self):
        slow, others = drape("torus", 6, 33), [conversion("torus"), conversion("sphere"), conversion("knot")]
        jobs = self.write_jobs(others[0], others[1], slow, others[2])
        store = ("-o", "out", "--store", "hdf5", "--workers", 1)
        task = self.begin(jobs, *store, "--part", "0/2")
        rows = self.folder / "out/results-0.jsonl"
        worker, *_ = self.wait_for(lambda: rows.exists() and rows.read_text() and self.workers_at_work(task), task)
        (program,) = worker.children()
        program.suspend()  # in mid-run while the others begin and end
        self.addCleanup(lambda: program.is_running() and program.resume())
        self.batch(jobs, *store, "--part", "1/2")
        self.batch(jobs, *store, "--part", "1/3")  # whose jobs are done: one of them in the file that is being written
        self.assertIn("another run is at work there", self.batch(jobs, *store, code=3).stderr)
        program.resume()
        said = task.communicate(timeout=PATIENCE)[0]
        self.assertEqual(task.returncode, 0, said)
        self.batch(jobs, *store)
        done = self.assert_each_done_once([slow, *others])
        self.assertEqual({row["attempt"] for row in done}, {1})
        self.assertEqual(sorted(path.name for path in (self.folder / "out/shards").iterdir()), ["0-00000.h5", "1-00000.h5"])

    def test_what_a_killed_task_left_is_done_and_removed(self):
        jobs = self.write_jobs(*self.JOBS)
        task = self.begin(jobs, "-o", "out", "--workers", 1, "--part", "1/2")
        self.wait_for(lambda: self.workers_at_work(task), task)
        family = psutil.Process(task.pid).children(recursive=True)
        task.kill()
        task.wait()
        psutil.wait_procs(family, timeout=PATIENCE)
        self.assertTrue(list(self.folder.glob("out/work-1/*")))
        self.batch(jobs, "-o", "out", "--workers", 2)
        self.assert_each_done_once(self.JOBS)
        self.assertEqual(list(self.folder.glob("out/work*")), [])

    def test_ctrl_c_keeps_what_was_finished(self):
        process = self.begin(self.write_jobs(*self.JOBS), "-o", "out", "--workers", 1)
        results = self.folder / "out/results.jsonl"
        self.wait_for(lambda: results.exists() and results.read_text(), process)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=PATIENCE)[0]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("interrupted; what was finished is kept", said)
        self.batch("jobs.jsonl", "-o", "out", "--workers", 2)
        self.assert_each_done_once(self.JOBS)

    def test_dask_serves_a_table_of_the_workers_while_they_are_at_work(self):
        process = self.begin(self.write_jobs(*self.JOBS), "-o", "out", "--workers", 2)
        said = process.stdout.readline()
        found = re.fullmatch(r"7 jobs; Dask tells of its workers at (http://127.0.0.1:\d+/info/main/workers.html)\n", said)
        self.assertTrue(found, said)
        with urllib.request.urlopen(found[1], timeout=PATIENCE) as answer:
            rows = re.findall(r"tcp://127.0.0.1:\d+</a>", answer.read().decode())
        self.assertEqual(len(rows), 2)

    def test_two_batches_do_not_share_a_folder(self):
        process = self.begin(self.write_jobs(*self.JOBS), "-o", "out", "--workers", 1)
        self.wait_for((self.folder / "out/results.jsonl").exists, process)
        self.assertIn("another run is at work there", self.batch("jobs.jsonl", "-o", "out", code=3).stderr)

    def test_a_running_scheduler_takes_the_jobs(self):
        def start(*words):
            process = subprocess.Popen([sys.executable, "-m", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(process.wait)
            self.addCleanup(process.terminate)
            return process
        start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", "scheduler.json")
        end = time.monotonic() + PATIENCE
        while not pathlib.Path("scheduler.json").exists() and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(0.2)
        address = json.loads(pathlib.Path("scheduler.json").read_text())["address"]
        for _ in range(2):
            start("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard", "--local-directory", str(self.folder))
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=PATIENCE)
            pids = list(client.run(os.getpid).values())
        process = self.begin(self.write_jobs(*self.JOBS), "-o", "out", "--scheduler", address)

        def at_work():
            return [pid for pid in pids if psutil.pid_exists(pid) and psutil.Process(pid).children()]
        victim, *_ = self.wait_for(at_work, process)
        os.kill(victim, signal.SIGKILL)
        said = process.communicate(timeout=PATIENCE)[0]
        self.assertEqual(process.returncode, 0, said)
        self.assert_each_done_once(self.JOBS)
        self.assertIn("no scheduler answers", self.batch("jobs.jsonl", "-o", "other", "--scheduler", "tcp://127.0.0.1:9", code=3).stderr)


if __name__ == "__main__":
    unittest.main()
