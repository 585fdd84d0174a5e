"""The sample of docs/python.md as it stands there, the notebook of examples/python, and results against the program's."""
import json
import re
import subprocess
import sys
import unittest

import numpy as np

import weft
from module import ModuleTest, small_torus
from program import SOURCE

BLOCK = re.compile(r"^```python\n(.*?)^```", re.S | re.M)
SHAPES = {"cone": {}, "tshirt": {"charts": 4}, "double_torus": {"fit": True}, "sphere": {"parameterizer": "floater"}}
OPTIONS = {"charts": "--charts", "parameterizer": "--parameterizer", "fit": "--fit"}


class Samples(ModuleTest):
    def small_body(self, frames=5):
        """A mesh of our own making and its motion, under the names that the documents give them."""
        Vb, Fb = small_torus()
        return {"Vb": Vb, "Fb": Fb, "Vt": np.stack([Vb + [0.002 * k, 0, 0] for k in range(frames)])}

    def test_blocks_of_the_document_run_as_they_stand(self):
        weft.write_mesh("bunny.obj", *small_torus(20, 28))
        names = self.small_body()
        blocks = BLOCK.findall((SOURCE / "docs/python.md").read_text())
        self.assertGreater(len(blocks), 3)
        for block in blocks:
            # As many frames as in the document take minutes.
            exec(compile(block.replace("run(240)", "run(6)"), "docs/python.md", "exec"), names)
        learning = BLOCK.findall((SOURCE / "docs/machine-learning.md").read_text())
        self.assertGreater(len(learning), 2)
        of_learning = {}
        for block in learning:
            exec(compile(block, "docs/machine-learning.md", "exec"), of_learning)
        self.assertEqual(of_learning["array"].shape, (64, 64, 12))
        self.assertEqual(of_learning["points"].shape[1], 3)
        with np.load("sequence.npz") as sequence:
            self.assertEqual(sequence["vertices_seq"].shape, (5, 33 * 33, 3))
        self.assertEqual(names["P"].shape, (257, 257, 3))
        self.assertTrue((names["P"] == weft.load("bunny.exr").positions).all())
        positions, times = weft.read_pc2("shirt.pc2")
        self.assertEqual(positions.shape[0], 7)
        self.assertEqual(positions.shape[1:], names["frame"].positions(names["cloth"]).shape)
        np.testing.assert_array_equal(positions[-1], names["frame"].positions(names["cloth"]))
        np.testing.assert_allclose(times, np.arange(7) / 60)

    def test_notebook_runs_and_agrees_with_the_program(self):
        done = subprocess.run([sys.executable, SOURCE / "examples/python/notebook.py", "builtin:knot", ".", "33"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        contacts, crossed = re.search(r"(\d+) contacts, (\d+) intersections", done.stdout).groups()
        self.assertGreater(int(contacts), 0)
        self.assertEqual(int(crossed), 0)
        for picture in ("image.png", "strain.png"):
            self.assertEqual((self.folder / picture).read_bytes()[:4], b"\x89PNG")
        self.run_weft("convert", "builtin:knot", "-o", "program.exr", "--size", 33)
        self.assertEqual((self.folder / "image.exr").read_bytes(), (self.folder / "program.exr").read_bytes())
        positions, _ = weft.read_pc2("sheet.pc2")
        self.assertEqual(positions.shape, (25, 33 * 33, 3))


class SameBits(ModuleTest):
    def test_images_are_the_program_s_for_any_number_of_threads(self):
        for turn, (shape, options) in enumerate(SHAPES.items()):
            flags = [word for key, value in options.items()
                     for word in ([OPTIONS[key]] if value is True else [OPTIONS[key], str(value)])]
            name = f"builtin:{shape}"
            self.run_weft("convert", name, "-o", "program.exr", "--size", 33, *flags)
            wanted = (self.folder / "program.exr").read_bytes()
            V, F = weft.read_mesh(name)
            threads = 1 if turn % 2 else 3
            image = weft.geometry_image(V, F, size=33, name=name, threads=threads, **options)
            image.save("module.exr")
            self.assertEqual((self.folder / "module.exr").read_bytes(), wanted, f"{shape}, {threads} threads")

    def test_types_and_orders_of_arrays_do_not_matter(self):
        V, F = small_torus()
        V = V.astype(np.float32).astype(float)
        wanted = weft.geometry_image(V, F, size=17).positions
        for vertices in (V.astype(np.float32), np.asfortranarray(V), V[::-1][::-1], V.tolist()):
            for faces in (F.astype(np.int64), F.astype(float), np.asfortranarray(F.astype(np.uint16)), F.tolist()):
                found = weft.geometry_image(vertices, faces, size=17).positions
                np.testing.assert_array_equal(found, wanted)

    def test_meshes_are_rebuilt_as_the_program_does(self):
        image = weft.builtin("tshirt", size=33)
        image.save("image.exr")
        for level in range(image.coarsest_level + 1):
            self.run_weft("rebuild", "image.exr", "-o", "program.ply", "--level", level)
            weft.write_mesh("module.ply", *image.to_mesh(level))
            self.assertEqual((self.folder / "module.ply").read_bytes(), (self.folder / "program.ply").read_bytes())
        V, _ = image.to_mesh()
        inner = image.positions[1:-1, 1:-1]
        np.testing.assert_array_equal(V[image.vertex_of][1:-1, 1:-1], inner)
        np.testing.assert_array_equal(image.positions.reshape(-1, 3)[image.sample_of], V)

    def scene_of(self, **more):
        return {"version": 1, "frames": 10, "cloths": [{"surface": "shirt.exr", "material": "denim"}],
                "bodies": [{"surface": "builtin:torus", "size": 65, "translate": [0, 1.1, 0], "friction": 0.3}], **more}

    def simulated(self):
        (self.folder / "scene.json").write_text(json.dumps(self.scene_of()))
        return self.run_json("simulate", "scene.json", "-o", "run", "--on", "image")

    def test_simulations_are_the_program_s(self):
        shirt = weft.builtin("tshirt", size=33)
        shirt.save("shirt.exr")
        report = self.simulated()
        by_file = weft.Simulation.from_scene("scene.json", threads=3)
        by_calls = weft.Simulation(threads=1)
        by_calls.add_body(weft.Body("builtin:torus", size=65), translate=(0, 1.1, 0), friction=0.3)
        by_calls.add_cloth(shirt, fabric="denim")
        for simulation in (by_file, by_calls):
            *_, last = simulation.run(10)
            self.assertEqual(simulation.state_hash, report["state_hash"])
            self.assertEqual(last.intersections, report["intersections"])
            self.assertEqual(last.strain._asdict(), report["strain"])
            weft.write_pc2("module.pc2", simulation.cache(simulation.cloths[0]))
            self.assertEqual((self.folder / "module.pc2").read_bytes(), next(self.folder.glob("run/*.pc2")).read_bytes())

    def test_vertices_of_a_mesh_follow_as_the_program_writes_them(self):
        weft.write_mesh("shirt.obj", *weft.read_mesh("builtin:tshirt"))
        V, F = weft.read_mesh("shirt.obj")
        scene = {"version": 1, "frames": 4, "cloths": [{"surface": "shirt.obj", "size": 33, "translate": [0, 0.2, 0]}]}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        report = self.run_json("simulate", "scene.json", "-o", "run", "--export", "pc2")
        simulation = weft.Simulation()
        cloth = simulation.add_cloth((V, F), size=33, translate=(0, 0.2, 0), fabric={})
        *_, last = simulation.run(4)
        self.assertEqual(simulation.state_hash, report["state_hash"])
        wanted, _ = weft.read_pc2("run/cloth.pc2")
        np.testing.assert_array_equal(simulation.cache(cloth, on="input"), wanted)
        np.testing.assert_array_equal(last.positions(cloth, on="input"), wanted[-1])
        self.assertEqual(wanted.shape[1:], V.shape)
        np.testing.assert_array_equal(simulation.cache(cloth, on="samples")[-1].reshape(-1, 3)[cloth.image.sample_of],
                                      last.positions(cloth))

    def test_saved_states_give_the_same_frames_again(self):
        simulation = weft.Simulation(threads=1)
        simulation.add_body("builtin:sphere", scale=0.5, translate=(0, 0.3, 0))
        cloth = simulation.add_cloth("builtin:sheet", size=33, translate=(0, 0.56, 0))
        list(simulation.run(4))
        state = simulation.save()
        frames = [frame.positions(cloth) for frame in simulation.run(4)]
        wanted = simulation.state_hash
        simulation.restore(state)
        self.assertEqual((simulation.frame, len(simulation.cache(cloth))), (4, 5))
        again = [frame.positions(cloth) for frame in simulation.run(4)]
        self.assertEqual(simulation.state_hash, wanted)
        np.testing.assert_array_equal(again, frames)


if __name__ == "__main__":
    unittest.main()
