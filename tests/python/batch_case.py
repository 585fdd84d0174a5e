"""What tests of batches share."""
import hashlib
import json
import subprocess
import sys
import time

from module import ModuleTest

try:
    import distributed  # noqa: F401
    import h5py  # noqa: F401
    import psutil  # noqa: F401
    import zarr  # noqa: F401
except ImportError as missing:
    print(f"batches: skipped: {missing}; python3-distributed, python3-h5py, python3-psutil and python3-zarr are wanted")
    sys.exit(77)

BATCH = [sys.executable, "-m", "weft.batch"]
PATIENCE = 240  # seconds for what is waited for on a crowded machine


class BatchTest(ModuleTest):
    """Runs batches in a folder of its own."""

    def write_jobs(self, *jobs, name="jobs.jsonl"):
        (self.folder / name).write_text("".join(json.dumps(job) + "\n" for job in jobs))
        return name

    def batch(self, *words, code=0):
        done = subprocess.run([*BATCH, *map(str, words)], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, code, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def begin(self, *words):
        process = subprocess.Popen([*BATCH, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, what, process):
        """What is asked for, as soon as it is there."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = what()
            if found:
                return found
            if process.poll() is not None:
                self.fail(f"ended too early with {process.returncode}: {process.stdout.read()}")
            time.sleep(0.02)
        self.fail("waited for too long")

    def rows(self, folder="out"):
        return [json.loads(line) for line in (self.folder / folder / "results.jsonl").read_text().splitlines()]

    def single_hash(self, job):
        """Of the same command, run alone."""
        if job["command"] == "convert":
            self.run_weft("convert", job["mesh"], "-o", "alone.exr", "--size", job["size"], "--quiet")
            return hashlib.sha256((self.folder / "alone.exr").read_bytes()).hexdigest()[:16]
        report = self.run_json("drape", job["cloth"], job["body"], "-o", "alone", "--size", job["size"], "--frames", job["frames"])
        return report["state_hash"]

    def assert_each_done_once(self, jobs, folder="out"):
        done = [row for row in self.rows(folder) if row["status"] == "done"]
        self.assertEqual(len(done), len({row["id"] for row in done}), "no job is done twice")
        self.assertEqual(len(done), len(jobs))
        by_job = {json.dumps([row["inputs"], row["options"]], sort_keys=True): row for row in done}
        self.assertEqual(len(by_job), len(jobs))
        return done


def conversion(shape, size=17, **more):
    return {"command": "convert", "mesh": f"builtin:{shape}", "size": size, **more}


def drape(body="sphere", frames=4, size=17, **more):
    return {"command": "drape", "cloth": "builtin:sheet", "body": f"builtin:{body}", "size": size, "frames": frames, **more}
