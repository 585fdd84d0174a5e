"""The contract of simulate, drape and render: fields, determinism, errors, files, interruption."""
import json
import os
import pathlib
import signal
import struct
import subprocess
import time
import unittest

from program import PROGRAM
from scenes import SceneTest, sheet_scene

RUN_FIELDS = ["frames", "particles", "integrator", "threads", "time_step", "substeps", "ms_per_frame", "strain",
              "strain_worst", "residual", "contacts_max", "self_contacts_max", "intersections", "centre_of_mass", "state_hash",
              "outputs"]


class Simulate(SceneTest):
    def test_report_has_every_field_and_free_fall_is_exact(self):
        report = self.run_json("simulate", self.write_scene(sheet_scene()), "-o", "run")
        for field in RUN_FIELDS:
            self.assertIn(field, report)
        self.assertEqual((report["frames"], report["particles"], report["substeps"]), (5, 289, 4))
        h = report["time_step"]
        for frame, (_, y, _) in enumerate(report["centre_of_mass"]):
            t = frame / 60
            self.assertAlmostEqual(y, 1 - 9.81 * t * (t + h) / 2, delta=2e-6)

    def test_energy_that_comes_from_nothing_is_warned_of(self):
        said = {}
        for integrator in ("newton", "two_level"):
            done = self.run_weft("drape", "builtin:sheet", "builtin:torus", "-o", integrator, "--size", "33", "--frames", "20",
                                 "--integrator", integrator, "--json")
            gain = json.loads(done.stdout)["energy_gained_mgl"]
            said[integrator] = (gain > 0.01, "energy gained that nothing put in" in done.stderr)
        self.assertEqual(said, {"newton": (False, False), "two_level": (True, True)})

    def test_the_worst_frame_for_strain_is_told(self):
        scene = sheet_scene(frames=12, cloths=[{"name": "sheet", "surface": "builtin:sheet", "size": 17,
                                                "translate": [0, 1, 0], "pins": [{"image": [0, 0]}, {"image": [1, 1]}]}])
        worst = self.run_json("simulate", self.write_scene(scene), "-o", "run")["strain_worst"]
        rows = self.table("run")
        row = max(rows, key=lambda line: float(line["strain_max"]))
        self.assertEqual(worst["frame"], int(row["frame"]))
        self.assertAlmostEqual(worst["max"], float(row["strain_max"]), delta=1e-5)
        self.assertAlmostEqual(worst["p99"], float(row["strain_p99"]), delta=1e-5)
        scene["frames"] = 0
        self.assertIsNone(self.run_json("simulate", self.write_scene(scene), "-o", "none")["strain_worst"])

    def test_verify_ends_with_4_and_tells_what_passes_through_what(self):
        # Nothing holds these apart: two sheets across each other and a plate through both, pinned where they stand.
        sheet = {"surface": "builtin:sheet", "size": 9, "pins": [{"region": [[0, 0], [1, 1]]}]}
        scene = sheet_scene(frames=2, ground=0.7, cloths=[
            {**sheet, "name": "sheet", "translate": [0, 1, 0]},
            {**sheet, "name": "wall", "translate": [0.01, 1.03, 0.02], "rotate": [80, 5, 0]},
            {**sheet, "name": "low", "translate": [5, 0.6, 0]}],
            bodies=[{"name": "plate", "surface": "builtin:sheet", "size": 9, "translate": [0.02, 1.03, 0.01],
                     "rotate": [0, 7, 75]}])
        name = self.write_scene(scene)
        done = self.run_weft("simulate", name, "-o", "run", "--verify", "--json", code=4)
        report = json.loads(done.stdout)
        found = report["intersections_found"]
        kinds = {kind: found[kind] for kind in ("self", "cloths", "bodies", "ground")}
        self.assertEqual(report["intersections"], sum(kinds.values()))
        self.assertEqual((found["frame"], kinds["self"]), (1, 0))
        self.assertGreaterEqual(kinds["ground"], 2 * 8 * 8)
        for kind in ("cloths", "bodies"):
            self.assertGreaterEqual(kinds[kind], 10, kind)
        *notes, error = done.stderr.strip().splitlines()
        self.assertIn(f"{report['intersections']} intersections in frame 1: 0 pairs", error)
        # Its collider knows nothing of cloth and cloth: both ends of the run say so.
        self.assertEqual([note.split(":")[1] for note in notes], [" note"] * 5)
        self.assertIn(f"at the start {kinds['bodies']} pairs of triangles of cloths and bodies cross", notes[0])
        self.assertIn(f"at the start {kinds['ground']} triangles of cloths are below the ground", notes[1])
        self.assertIn(f"at the start {kinds['cloths']} pairs of triangles of cloth cross, 0 of one cloth and {kinds['cloths']} of "
                      "two; this collider leaves them so", notes[2])
        self.assertIn("still tangled", notes[3])
        self.assertRegex(notes[4], "in the last frame [0-9]+ pairs of triangles of cloths and bodies cross still")
        self.assertIsNone(report["untangled_frame"])
        # Without the word, the last frame is reported and nothing fails.
        self.assertEqual(self.run_json("simulate", name, "-o", "run")["intersections"], report["intersections"])

    def test_what_crosses_a_body_still_is_told_at_the_end(self):
        scene = sheet_scene(frames=2, gravity=[0, 0, 0], cloths=[{"surface": "builtin:sheet", "size": 9}],
                            bodies=[{"surface": "builtin:rod", "size": 17, "rotate": [0, 0, 90]}])
        done = self.run_weft("simulate", self.write_scene(scene), "-o", "run", "--json")
        left = json.loads(done.stdout)["intersections"]
        self.assertGreater(left, 0)
        self.assertIn("pairs of triangles of cloths and bodies cross; closed bodies push out cloth that lies in them", done.stderr)
        self.assertIn(f"in the last frame {left} pairs of triangles of cloths and bodies cross still", done.stderr)

    def test_a_tangled_start_is_told_untangled_and_told_again(self):
        sheet = {"surface": "builtin:sheet", "size": 17}
        scene = sheet_scene(frames=60, ground=0, collider={"type": "pyramid"}, cloths=[
            {**sheet, "name": "sheet", "translate": [0, 1, 0]},
            {**sheet, "name": "wall", "translate": [0.01, 1.33, 0.02], "rotate": [80, 5, 0]}])
        done = self.run_weft("simulate", self.write_scene(scene), "-o", "run", "--json")
        report = json.loads(done.stdout)
        start, frame = report["start_intersections"], report["untangled_frame"]
        self.assertEqual((start["self"], start["bodies"], start["ground"]), (0, 0, 0))
        self.assertGreater(start["cloths"], 20)
        self.assertGreater(frame, 0)
        self.assertLess(frame, 60)
        self.assertEqual(report["intersections"], 0)
        first, last = done.stderr.strip().splitlines()
        self.assertIn(f"at the start {start['cloths']} pairs of triangles of cloth cross, 0 of one cloth and "
                      f"{start['cloths']} of two; the run takes them apart", first)
        self.assertIn(f"what crossed at the start is apart since frame {frame}", last)
        # A run that stops on the way and goes on tells the same.
        self.run_weft("simulate", self.folder / "scene.json", "-o", "parts", "--frames", str(frame // 2))
        again = self.run_json("simulate", self.folder / "scene.json", "-o", "parts", "--resume")
        for field in ("start_intersections", "untangled_frame", "state_hash"):
            self.assertEqual(again[field], report[field], field)

    def test_what_crosses_after_a_free_start_has_not_come_apart(self):
        scene = sheet_scene(frames=40, integrator={"type": "newton"}, collider={"type": "pyramid"}, ground=0,
                            bodies=[{"surface": "builtin:sphere", "size": 33, "translate": [0, 0.5, 0]}],
                            cloths=[{"surface": "builtin:sheet", "size": 17, "translate": [0, 1.05, 0], "self_collision": False}])
        name = self.write_scene(scene)
        plain = self.run_json("simulate", name, "-o", "plain")
        done = self.run_weft("simulate", name, "-o", "verified", "--verify", "--json", code=4)
        self.assertEqual((plain["untangled_frame"], json.loads(done.stdout)["untangled_frame"]), (0, 0))
        self.assertNotIn("is apart since", done.stderr)

    def test_unknown_instruction_sets_are_usage_errors(self):
        scene = self.write_scene(sheet_scene())
        self.assertIn("sse9", self.error_of("simulate", scene, "-o", "none", "--instructions", "sse9", code=2))

    def test_every_integrator_gives_the_same_hash_on_one_and_two_threads(self):
        hanging = sheet_scene(frames=10)
        hanging["cloths"][0]["pins"] = [{"image": [0, 0]}, {"image": [1, 0]}]
        hanging["cloths"][0]["material"] = {"stretch": 50, "shear": 10, "bend_springs": 0.1}
        self.run_weft("convert", "builtin:sphere", "-o", "ball.exr", "--size", 65)  # once for all
        hanging["bodies"] = [{"name": "ball", "surface": "ball.exr", "translate": [0, 0.4, 0]}]
        for integrator in ("newton", "implicit", "explicit", "desbrun", "two_level", "multigrid"):
            scene = self.write_scene(dict(hanging, integrator={"type": integrator}, substeps=8))
            hashes = {self.run_json("simulate", scene, "-o", f"run{threads}", "--threads", threads)["state_hash"]
                      for threads in (1, 2, 3)}
            self.assertEqual(len(hashes), 1, integrator)

    def test_collider_on_the_command_line_replaces_the_scenes(self):
        scene = sheet_scene(frames=20, collider={"type": "polar_map", "walk": False})
        # Pushes many times too deep store more in stiff springs than a run may gain.
        scene["cloths"][0].update(size=33, translate=[0.1, 1.03, 0], material={"stretch": 2000, "shear": 500})
        scene["bodies"] = [{"name": "ring", "surface": "builtin:torus", "size": 65, "translate": [0, 0.85, 0]}]
        printed = self.write_scene(scene, "printed.json")
        walking = self.write_scene(dict(scene, collider={"type": "polar_map"}), "walking.json")
        replaced = self.run_json("simulate", printed, "-o", "a", "--collider", "polar_map")["state_hash"]
        self.assertEqual(replaced, self.run_json("simulate", walking, "-o", "b")["state_hash"])
        self.assertNotEqual(replaced, self.run_json("simulate", printed, "-o", "c")["state_hash"])

    def test_substeps_and_material_on_the_command_line_replace_the_scenes(self):
        scene = sheet_scene(frames=3)
        told = self.write_scene(dict(scene, substeps=2, cloths=[dict(scene["cloths"][0], material="silk")]), "told.json")
        replaced = self.run_json("simulate", self.write_scene(scene), "-o", "a", "--substeps", "2", "--material", "silk")
        self.assertEqual(replaced["substeps"], 2)
        self.assertEqual(replaced["state_hash"], self.run_json("simulate", told, "-o", "b")["state_hash"])
        self.run_weft("simulate", told, "-o", "c", "--material", "tin", code=2)

    def test_what_is_odd_is_told_before_the_first_frame(self):
        for wrong, line in (({"scale": 0.001}, "is the unit of its file right?"), ({"translate": [0, -1, 0]}, "below the ground")):
            scene = {"version": 1, "frames": 1, "cloths": [{"size": 17, "translate": [0, 1, 0], **wrong}]}
            said = self.run_weft("simulate", self.write_scene(scene), "-o", "run").stderr
            self.assertEqual(said.count(line), 1, said)
        stiff = {"version": 1, "frames": 30, "integrator": {"type": "explicit"}, "substeps": 1,
                 "cloths": [{"size": 17, "translate": [0, 0.05, 0], "scale": 0.001, "pins": [{"image": [0, 0]}]}]}
        said = self.run_weft("simulate", self.write_scene(stiff), "-o", "run", code=3).stderr
        self.assertLess(said.index("is the unit of its file right?"), said.index("ran away"))

    def test_pc2_holds_the_frames_of_the_obj_vertices(self):
        self.run_weft("simulate", self.write_scene(sheet_scene()), "-o", "run")
        data = (self.folder / "run/sheet.pc2").read_bytes()
        magic, version, points, start, rate, frames = struct.unpack("<12siiffi", data[:32])
        self.assertEqual((magic, version, points, start, rate, frames), (b"POINTCACHE2\0", 1, 289, 0.0, 1.0, 6))
        self.assertEqual(len(data), 32 + 12 * points * frames)
        vertices = [line.split()[1:4] for line in (self.folder / "run/sheet.obj").read_text().splitlines()
                    if line.startswith("v ")]
        first = struct.unpack(f"<{3 * points}f", data[32 : 32 + 12 * points])
        self.assertEqual(len(vertices), points)
        for k, vertex in enumerate(vertices):
            for axis in range(3):
                self.assertAlmostEqual(float(vertex[axis]), first[3 * k + axis], places=6)

    def test_frames_csv_has_one_line_a_frame(self):
        self.run_weft("simulate", self.write_scene(sheet_scene()), "-o", "run")
        lines = (self.folder / "run/frames.csv").read_text().splitlines()
        self.assertGreaterEqual(len(lines), 6)
        self.assertEqual(len({len(line.split(",")) for line in lines}), 1)

    def test_frames_csv_tells_time_solver_strain_energy_and_contacts(self):
        fall = self.run_json("simulate", self.write_scene(sheet_scene()), "-o", "fall")
        rows = self.table("fall")
        self.assertEqual(list(rows[0]), ["frame", "ms", "forces_ms", "solve_ms", "collide_ms", "limit_ms", "iterations",
                                         "residual", "strain_mean", "strain_p99", "strain_max", "kinetic_energy",
                                         "potential_energy", "contacts", "stopped", "fell_back", "blocked_share", "lost_time", "work",
                                         "smallest_gap", "seam_gap",
                                         "com_x", "com_y", "com_z", "buried"])
        for frame, row in enumerate(rows, 1):
            stages = sum(float(row[stage]) for stage in ("forces_ms", "solve_ms", "collide_ms", "limit_ms"))
            self.assertLessEqual(stages, float(row["ms"]) + 0.01)
            self.assertEqual((int(row["frame"]), int(row["contacts"]), row["smallest_gap"]), (frame, 0, ""))
            self.assertEqual(float(row["com_y"]), float(f"{fall['centre_of_mass'][frame][1]:.9g}"))
        # What falls turns height into speed; implicit Euler's height is that of the formula.
        mass = float(rows[-1]["potential_energy"]) / (9.81 * float(rows[-1]["com_y"]))
        speed = 9.81 * 5 / 60
        self.assertAlmostEqual(float(rows[-1]["kinetic_energy"]), mass * speed ** 2 / 2, delta=1e-4 * mass)
        scene = sheet_scene(ground=0.99, frames=20)
        landed = self.run_json("simulate", self.write_scene(scene), "-o", "landed")
        rows = self.table("landed")
        self.assertEqual(max(int(row["contacts"]) for row in rows), landed["contacts_max"])
        self.assertAlmostEqual(float(rows[-1]["smallest_gap"]), float(rows[-1]["com_y"]) - 0.99, delta=1e-3)
        self.assertEqual(float(rows[-1]["strain_max"]), float(f"{landed['strain']['max']:.6g}"))
        self.assertEqual(max(float(row["residual"]) for row in rows), float(f"{landed['residual']['max']:.4g}"))

    def test_methods_that_do_not_iterate_have_no_residual(self):
        for integrator in ("explicit", "two_level"):
            scene = sheet_scene(integrator={"type": integrator}, substeps=16)
            scene["cloths"][0]["material"] = {"stretch": 50, "shear": 10}
            report = self.run_json("simulate", self.write_scene(scene), "-o", "run")
            self.assertEqual(report["residual"], {"median": 0, "max": 0})
            self.assertEqual({row["iterations"] for row in self.table("run")}, {"0"})

    def test_interrupted_run_keeps_whole_frames_and_exits_130(self):
        scene = sheet_scene(frames=100000)
        scene["cloths"][0]["size"] = 33
        process = subprocess.Popen([PROGRAM, "simulate", self.write_scene(scene), "-o", "run"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(3)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        data = (self.folder / "run/sheet.pc2").read_bytes()
        points, frames = struct.unpack("<12siiffi", data[:32])[2::3]
        self.assertGreater(frames, 1)
        self.assertEqual(len(data), 32 + 12 * points * frames)
        self.assertEqual([p for p in (self.folder / "run").iterdir() if ".part" in p.name], [])


class Memory(SceneTest):
    def test_estimate_is_within_a_quarter_of_what_a_run_takes(self):
        if os.environ.get("WEFT_SANITIZE"):
            self.skipTest("sanitizers take memory of their own")
        body = {"name": "ring", "surface": "builtin:torus", "size": 257, "translate": [0, 0.5, 0]}
        for size, integrator, bodies in ((257, "multigrid", [body]), (385, "multigrid", []), (257, "explicit", []),
                                         (257, "two_level", []), (257, "implicit", []), (385, "implicit", [body]),
                                         (257, "newton", [body])):
            with self.subTest(f"{integrator} {size}"):
                collider = "polar_map" if integrator == "implicit" else "pyramid"
                scene = sheet_scene(frames=1, substeps=1, integrator={"type": integrator}, bodies=bodies,
                                    collider={"type": collider})
                scene["cloths"][0]["size"] = size
                if integrator == "explicit":  # a step that is too large costs a search for the largest
                    scene["cloths"][0]["material"] = {"stretch": 1e-3, "shear": 1e-3, "bending": 0, "damping": 0}
                report = self.run_json("simulate", self.write_scene(scene), "-o", "run")
                ratio = report["estimated_memory_mb"] / report["peak_memory_mb"]
                self.assertGreater(ratio, 0.75)
                self.assertLess(ratio, 1.25)

    def test_large_runs_say_what_they_will_take_and_too_large_ones_do_not_start(self):
        scene = sheet_scene(cloths=[{"name": str(i), "surface": "builtin:sheet", "size": 8193} for i in range(99)])
        line = self.error_of("simulate", self.write_scene(scene), "-o", "run", code=3)
        self.assertRegex(line, r"scene.json: about [0-9.]+ GB of memory are needed, [0-9.]+ [GM]B are there")
        self.assertFalse((self.folder / "run").exists())


class Bits(SceneTest):
    """The same bits on every instruction set and any number of threads, where layers touch and where cloth meets a body."""
    SIZE = 97  # from here on steps are shared among threads

    def hashes_of(self, scene):
        flags = pathlib.Path("/proc/cpuinfo").read_text()
        sets = ["baseline"] + ["avx2"] * (" avx2 " in flags) + ["avx512"] * (" avx512bw " in flags)
        pairs = [(name, "3") for name in sets] + [(sets[-1], threads) for threads in ("1", "2", "7")]
        reports = [self.run_json("simulate", self.write_scene(scene), "-o", "run", "--instructions", name, "--threads", threads,
                                 "--checkpoint", "0")
                   for name, threads in pairs]
        return {report["state_hash"] for report in reports}, reports[0]

    def test_layers_that_fall_on_the_ground(self):
        scene = {"version": 1, "frames": 1, "ground": 0, "cloths": [
            {"name": "low", "surface": "builtin:sheet", "size": self.SIZE, "scale": 0.4, "translate": [0, 0.004, 0],
             "velocity": [0, -0.3, 0], "material": "silk"},
            {"name": "high", "surface": "builtin:sheet", "size": self.SIZE, "scale": 0.4, "translate": [0.01, 0.007, 0.02],
             "rotate": [0.3, 20, 0], "velocity": [0, -0.5, 0], "material": "cotton"}]}
        hashes, report = self.hashes_of(scene)
        self.assertEqual(len(hashes), 1)
        self.assertGreater(report["contacts_max"], 100)
        self.assertGreater(report["self_contacts_max"], 100)

    def test_a_sheet_that_falls_on_a_body(self):
        scene = {"version": 1, "frames": 2, "ground": None,
                 "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": self.SIZE, "translate": [0, 0.504, 0],
                             "velocity": [0, -1, 0], "material": "cotton"}],
                 "bodies": [{"name": "ball", "surface": "builtin:sphere", "size": 33}]}
        hashes, report = self.hashes_of(scene)
        self.assertEqual(len(hashes), 1)
        self.assertGreater(report["contacts_max"], 100)


if __name__ == "__main__":
    unittest.main()
