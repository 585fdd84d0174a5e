"""Batches: every job once; failures named; the same hashes as single runs; stores, tables, arrays of tasks."""
import csv
import json
import os
import subprocess
import unittest

import numpy as np

import weft
import weft.batch.jobs
from batch_case import BATCH, PATIENCE, BatchTest, conversion, drape
from module import small_torus
from program import PROGRAM

import h5py
import psutil
import weft.batch.schedule
import zarr


class Batch(BatchTest):
    def test_results_are_those_of_single_runs_and_failures_are_named(self):
        good = [conversion("torus"), conversion("cone", 33), drape()]
        bad = [conversion("shoe"), conversion("cone", 1025, memory=30), drape("torus", 100000, 65, timeout=1)]
        jobs = self.write_jobs(*good, *bad, good[0])
        done = self.batch(jobs, "-o", "out", "--workers", 2, code=4)
        rows = {json.dumps([row["inputs"], row["options"].get("size")]): row for row in self.rows()}
        self.assertEqual(len(rows), 6)
        for job in good:
            words = [job[word] for word in weft.batch.jobs.WORDS[job["command"]]]
            row = rows[json.dumps([words, job["size"]])]
            self.assertEqual((row["status"], row["hash"], row["attempt"]), ("done", self.single_hash(job), 1))
            self.assertTrue((self.folder / "out" / row["place"] / "made").is_dir())
        errors = {row["id"]: row["error"] for row in rows.values() if row["status"] == "failed"}
        for word in ("no such shape", "30 MB at most", "ended after 1 s"):
            self.assertEqual(sum(word in text for text in errors.values()), 1, errors)
            self.assertIn(word, done.stdout)
        for name in errors:  # what is kept of a failure tells how to run it again
            told = json.loads((self.folder / "out/failed" / name / "job.json").read_text())
            self.assertEqual(told["id"], name)
        with open("out/index.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(sorted(line["place"] for line in csv.DictReader(file)),
                             sorted(row["place"] for row in rows.values() if row["status"] == "done"))
        self.assertFalse((self.folder / "out/work").exists())
        again = self.batch(jobs, "-o", "out", "--workers", 1, code=4)
        self.assertIn("3 of 6 jobs are done already", again.stderr)
        self.assert_each_done_once(good)

    def test_garments_are_jobs_that_tell_of_their_seams(self):
        def panel(z, corners):
            return {"vertices": corners, "translation": [-15, 100, z], "edges": [{"endpoints": [k, (k + 1) % 4]} for k in range(4)]}
        panels = {"front": panel(12, [[0, 0], [30, 0], [30, 20], [0, 20]]), "back": panel(-12, [[0, 0], [0, 20], [30, 20], [30, 0]])}
        stitches = [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}]]
        (self.folder / "p.json").write_text(json.dumps({"pattern": {"panels": panels, "stitches": stitches}, "properties": {"units_in_meter": 100}}))
        jobs = self.write_jobs({"command": "garment", "pattern": "*.json", "body": "builtin:sphere", "spacing": 40, "frames": 2})
        self.batch(jobs, "-o", "out", "--workers", 1)
        row, = self.rows()
        self.assertEqual((row["status"], row["seams"]["count"], row["fell_off"]), ("done", 1, []))
        self.assertTrue((self.folder / "out/jobs" / row["id"] / "made/garment.panels.npz").exists())

    def test_a_changed_input_is_another_job(self):
        V, F = small_torus()
        weft.write_mesh("a.obj", V, F)
        jobs = self.write_jobs({"mesh": "*.obj", "size": 17})
        self.batch(jobs, "-o", "out", "--quiet")
        self.batch(jobs, "-o", "out", "--quiet")
        self.assertEqual(len(self.rows()), 1)
        weft.write_mesh("a.obj", 2 * V, F)
        weft.write_mesh("b.obj", 3 * V, F)
        self.batch(jobs, "-o", "out", "--quiet")
        self.assertEqual(len({row["id"] for row in self.rows()}), 3)
        self.batch(".", "-o", "folder", "--quiet", code=0)  # a folder of meshes, at the program's own size
        self.assertEqual([row["size"] for row in self.rows("folder")], [257, 257])

    def test_scenes_depend_on_the_files_that_they_name(self):
        weft.builtin("sheet", size=9).save("sheet.exr")
        scene = {"version": 1, "frames": 2, "cloths": [{"surface": "sheet.exr"}]}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        reader = weft.batch.jobs.Reader(PROGRAM)
        (job,) = reader.read(self.write_jobs({"command": "simulate", "scene": "scene.json"}))
        weft.builtin("sheet", size=17).save("sheet.exr")
        (other,) = weft.batch.jobs.Reader(PROGRAM).read("jobs.jsonl")
        self.assertNotEqual(job.id, other.id)
        self.batch("jobs.jsonl", "-o", "out", "--quiet")
        self.assertEqual(self.rows()[0]["frames"], 2)

    def test_what_names_files_depends_on_them_all(self):
        def identity(job):
            return weft.batch.jobs.Reader(PROGRAM).read(self.write_jobs(job))[0].id
        weft.write_mesh("plain.obj", *weft.read_mesh("builtin:torus"))
        (self.folder / "mesh.obj").write_text("mtllib colours.mtl\n" + (self.folder / "plain.obj").read_text())
        (self.folder / "colours.mtl").write_text("newmtl a\nmap_Kd -o 1 1 picture.png\n")
        body = {"surface": "mesh.obj", "animation": "walk#1.glb#Walk"}
        (self.folder / "clip.json").write_text(json.dumps({"version": 1, "bodies": [body]}))
        (self.folder / "frames.json").write_text(json.dumps({"version": 1, "bodies": [body | {"animation": "step%03d.obj"}]}))
        (self.folder / "self.json").write_text(json.dumps({"of": "other.json"}))
        (self.folder / "other.json").write_text(json.dumps({"of": "self.json"}))
        mesh, clip = {"mesh": "mesh.obj"}, {"command": "simulate", "scene": "clip.json"}
        frames, loop = {"command": "simulate", "scene": "frames.json"}, {"command": "simulate", "scene": "self.json"}
        for job, name in ((mesh, "picture.png"), (clip, "walk#1.glb"), (clip, "colours.mtl"), (frames, "step007.obj"), (loop, "other.json")):
            before = identity(job)
            self.assertEqual(identity(job), before)
            with (self.folder / name).open("a") as file:
                file.write("\n")
            self.assertNotEqual(identity(job), before, name)

    def test_every_input_is_part_of_a_job_s_name_in_its_place(self):
        weft.write_mesh("ring.obj", *small_torus())
        (self.folder / "p.json").write_text("{}")
        drapes = [{"command": "drape", "cloth": cloth, "body": body} for cloth, body in (
            ("ring.obj", "builtin:sphere"), ("builtin:sphere", "ring.obj"),
            ("builtin:sphere", "builtin:torus"), ("builtin:torus", "builtin:sphere"))]
        sewn = [{"command": "garment", "pattern": "p.json", "body": body}
                for body in ("builtin:sphere", "builtin:mannequin", "ring.obj")]
        read = weft.batch.jobs.Reader(PROGRAM).read(self.write_jobs(*drapes, *sewn))
        self.assertEqual(len({job.id for job in read}), 7)

    def test_tables_and_lines_say_the_same(self):
        (self.folder / "jobs.csv").write_text("mesh,size,fit,parameterizer,timeout\nbuiltin:torus,17,true,,\nbuiltin:knot,33,,floater,9.5\n")
        lines = self.write_jobs({"mesh": "builtin:torus", "size": 17, "fit": True},
                                {"mesh": "builtin:knot", "size": 33, "parameterizer": "floater", "timeout": 9.5})
        tables = weft.batch.jobs.Reader(PROGRAM).read("jobs.csv")
        objects = weft.batch.jobs.Reader(PROGRAM).read(lines)
        self.assertEqual([job.line() for job in tables], [job.line() for job in objects])
        self.assertEqual([job.id for job in tables], [job.id for job in objects])
        threads = weft.batch.jobs.Reader(PROGRAM).read(self.write_jobs({"mesh": "builtin:torus", "size": 17, "fit": True, "threads": 2}))
        self.assertEqual(threads[0].id, tables[0].id)

    def test_jobs_that_are_none_are_refused_before_anything_runs(self):
        wrong = {'{"mesh": "builtin:torus", "sise": 17}': "sise", '{"command": "fold", "mesh": "a.obj"}': "fold", "{": "no JSON", "[1]": "object",
                 '{"command": "drape", "cloth": "builtin:sheet"}': "no 'body'", '{"mesh": "none*.obj"}': "none*.obj",
                 '{"mesh": "builtin:torus", "timeout": -1}': "timeout", '{"mesh": "builtin:torus", "output": "x.exr"}': "output",
                 '{"mesh": "builtin:torus", "size": null}': "size",
                 '{"mesh": "builtin:torus", "component": "all"}':
                     "the option 'component' with 'all'; one piece a job, its number or largest, is wanted"}
        for line, word in wrong.items():
            (self.folder / "jobs.jsonl").write_text('{"mesh": "builtin:torus"}\n' + line + "\n")
            said = self.batch("jobs.jsonl", "-o", "out", code=3).stderr
            self.assertTrue(said.startswith("weft.batch: error: jobs.jsonl:2: "), said)
            self.assertIn(word, said)
            self.assertEqual(len(said.splitlines()), 1)
        for words in (["none.csv", "-o", "out"], [self.write_jobs(name="empty.jsonl"), "-o", "out"]):
            self.assertEqual(len(self.batch(*words, code=3).stderr.splitlines()), 1)
        self.batch("jobs.jsonl", code=2)
        self.batch("jobs.jsonl", "-o", "out", "--workers", 0, code=2)
        self.assertFalse((self.folder / "out").exists())

    def check_arrays(self, row, group):
        """Of a store: as what the program wrote in a folder."""
        made = self.folder / "folders/jobs" / row["id"] / "made"
        self.assertEqual(json.loads(group.attrs["row"])["hash"], row["hash"])
        self.assertTrue(json.loads(group.attrs["report"])["outputs"])
        if row["command"] == "convert":
            np.testing.assert_array_equal(group["positions"], weft.load(made / "image.exr").positions)
            np.testing.assert_array_equal(group["classes"], weft.load(made / "image.exr").classes)
            return
        caches = list(made.glob("*.pc2"))
        self.assertTrue(caches)
        for cache in caches:
            np.testing.assert_array_equal(group[cache.stem], weft.read_pc2(cache)[0])

    def test_stores_hold_what_the_folders_do(self):
        jobs = self.write_jobs(conversion("torus"), drape(export="pc2"), conversion("shoe"))
        self.batch(jobs, "-o", "folders", "--quiet", code=4)
        folders = {row["id"]: row for row in self.rows("folders")}
        for store in ("hdf5", "zarr"):
            self.batch(jobs, "-o", store, "--store", store, "--quiet", code=4)
            self.assertFalse(any((self.folder / store / "jobs").glob("*")))
            for row in self.rows(store):
                self.assertEqual(row.get("hash"), folders[row["id"]].get("hash"))
                if row["status"] == "done" and store == "zarr":
                    self.check_arrays(row, zarr.open(f"zarr/{row['place']}", "r"))
                elif row["status"] == "done":
                    shard, name = row["place"].split(":")
                    with h5py.File(f"hdf5/{shard}", "r") as file:
                        self.check_arrays(row, file[name])
            before = len(self.rows(store))
            self.batch(jobs, "-o", store, "--store", store, "--quiet", code=4)
            self.assertEqual(len(self.rows(store)), before + 1)  # the failure

    def test_a_group_of_zarr_that_is_not_whole_is_written_again(self):
        jobs = self.write_jobs(conversion("torus"))
        self.batch(jobs, "-o", "out", "--store", "zarr", "--quiet")
        group = self.folder / "out" / self.rows()[0]["place"]
        whole = sorted((path, path.is_file() and path.read_bytes()) for path in group.rglob("positions/*"))
        (group / ".zattrs").unlink()  # as if it was killed in mid-write
        (group / "positions/0.0.0").write_bytes(b"torn")
        self.batch(jobs, "-o", "out", "--store", "zarr", "--quiet")
        self.assertEqual([row["status"] for row in self.rows()], ["done"] * 2)
        self.assertEqual(sorted((path, path.is_file() and path.read_bytes()) for path in group.rglob("positions/*")), whole)

    def test_a_store_whose_package_is_missing_says_so(self):
        jobs = self.write_jobs(conversion("torus"))
        for store, package in (("hdf5", "h5py"), ("zarr", "zarr")):
            (self.folder / f"{package}.py").write_text("raise ImportError('as if it were not there')\n")
            said = self.batch(jobs, "-o", "out", "--store", store, code=3).stderr
            self.assertEqual(said, f"weft.batch: error: python3-{package} is not installed, which this store wants: as if it were not there\n")
        self.assertFalse((self.folder / "out").exists())

    def test_tasks_of_an_array_and_what_gathers_them(self):
        weft.write_mesh("a [1].obj", *small_torus())
        jobs = self.write_jobs({"mesh": "a*.obj", "size": 17}, conversion("cone"), conversion("sphere"))
        folder = self.folder / "50 % of it"
        self.batch(jobs, "-o", folder, "--slurm", 2)
        script = (folder / "slurm.sh").read_text()
        self.assertIn("#SBATCH --array=0-1\n", script)
        self.assertIn(f"#SBATCH --output='{self.folder}/50 %% of it/slurm-%a.log'\n", script)
        self.assertEqual(subprocess.run(["bash", "-n", folder / "slurm.sh"]).returncode, 0)
        for task in range(2):  # as Slurm would
            done = subprocess.run(["bash", folder / "slurm.sh"], env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)}, capture_output=True,
                                  text=True, timeout=PATIENCE)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([len((folder / f"results-{task}.jsonl").read_text().splitlines()) for task in range(2)], [2, 1])
        self.batch(folder / "jobs.jsonl", "-o", folder)
        self.assertEqual(len(self.assert_each_done_once(range(3), folder)), 3)
        self.assertEqual(list(folder.glob("results-*")), [])
        with open(folder / "index.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 3)

    def test_rows_are_gathered_once_though_what_gathered_them_was_killed(self):
        jobs = self.write_jobs(conversion("torus"), conversion("cone"))
        for task in range(2):
            self.batch(jobs, "-o", "out", "--part", f"{task}/2", "--quiet")
        again = (self.folder / "out/results-1.jsonl").read_text()
        self.batch(jobs, "-o", "out", "--quiet")
        (self.folder / "out/results-1.jsonl").write_text(again + '{"id": "torn')  # as if it was killed before it removed them
        self.batch(jobs, "-o", "out", "--quiet")
        self.assert_each_done_once(range(2))

    def test_a_task_of_slurm_takes_its_share_of_memory(self):
        free = weft.batch.schedule.memory_share(1, {})
        self.assertAlmostEqual(weft.batch.schedule.memory_share(4, {}) * 4 / free, 1, delta=0.2)
        for given, wanted in (({"SLURM_MEM_PER_NODE": "100"}, 94.37184), ({"SLURM_MEM_PER_CPU": "20", "SLURM_CPUS_ON_NODE": "3"}, 56.623104)):
            self.assertAlmostEqual(weft.batch.schedule.memory_share(1, given), wanted, msg=given)
        part = weft.batch.schedule.memory_share(1, {"SLURM_CPUS_ON_NODE": "1"})
        self.assertAlmostEqual(part / free, 1 / psutil.cpu_count(), delta=0.2)


if __name__ == "__main__":
    unittest.main()
