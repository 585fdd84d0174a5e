"""Simulations built in memory: what they are told of, copies, states, and threads that outlive the interpreter."""
import os
import pickle
import subprocess
import sys
import unittest

import numpy as np

import weft
from module import ModuleTest, small_torus, sphere_on_floor

# The process ends while a thread of it is amid a long call.
ENDS = """
import threading, time, weft
V, F = weft.read_mesh("builtin:mannequin")
def work():
    if {simulates}:
        simulation = weft.Simulation(threads=1)
        simulation.add_cloth("builtin:sheet", size=33)
        list(simulation.run(100000))
    weft.geometry_image(V, F, size=1025, threads=1)
threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
"""


def sheet(**given):
    simulation = weft.Simulation(threads=1, ground=None)
    return simulation, simulation.add_cloth("builtin:sheet", **{"size": 9, **given})


def textured_square(turned):
    """A square of four, whose texture is turned by a quarter or not. V, F, uv"""
    V = np.array([[x, 0.0, z] for z in (0, 0.5, 1) for x in (0, 0.5, 1)])
    F = np.array([t for r in (0, 3) for c in (0, 1) for t in ((r + c, r + c + 3, r + c + 1), (r + c + 1, r + c + 3, r + c + 4))])
    uv = V[:, [2, 0]] if turned else V[:, [0, 2]]
    return V, F, uv[F]


def moved(surface=None, path=(0, 0, 1), fps=30, **pauses):
    """A textured square beside a ball that goes along a path."""
    V, F = weft.read_mesh("builtin:sphere")
    motion = np.linspace(V, V + path, 3)
    simulation = weft.Simulation(threads=1, ground=None)
    simulation.add_body(weft.Body(V, F, motion=motion, fps=fps, size=9), translate=(5, 0, 0), **pauses)
    simulation.add_cloth(surface or textured_square(False), size=9)
    return simulation


class Simulations(ModuleTest):
    def test_daemon_threads_amid_a_call_do_not_keep_the_process_from_ending(self):
        for simulates in (False, True):
            with self.subTest(simulates=simulates):
                done = subprocess.run([sys.executable, "-c", ENDS.format(simulates=simulates)], capture_output=True, text=True,
                                      timeout=60)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_notes_are_those_of_the_program(self):
        simulation = weft.Simulation(threads=1, ground=0.5)
        simulation.add_body("builtin:sphere", scale=0.5, translate=(0, 3, 0))
        simulation.add_cloth("builtin:sheet", size=9, translate=(0, 3, 0))
        simulation.add_cloth("builtin:sheet", size=9, translate=(5, 0.2, 0))
        simulation.add_cloth("builtin:sheet", size=9, translate=(5, 0.2, 0), rotate=(0, 0, 40))
        notes = "\n".join(simulation.notes)
        for words in ("inside of body 'body'", "are below the ground", "of cloth cross"):
            self.assertIn(words, notes)

    def test_arrays_and_lists_are_copied(self):
        V, F = (np.ascontiguousarray(array) for array in small_torus())
        F = F.astype(np.int32)
        motion, pins = np.stack([V, V + 1]).astype(np.float32), [{"image": [0, 0]}]
        simulation = weft.Simulation(threads=1, ground=None)
        simulation.add_body(weft.Body(V, F, motion=motion, size=17))
        cloth = simulation.add_cloth((V, F), size=17, translate=(0, 5, 0), pins=pins)
        V[:], F[:], motion[:] = np.nan, -1, np.nan
        pins[0]["image"] = [7, 7]
        list(simulation.run(2))
        self.assertTrue(np.isfinite(simulation.cache(cloth)).all())
        self.assertTrue(np.isfinite(simulation.body_positions(0)).all())

    def test_dictionaries_are_copied(self):
        speed, fabric, integrator, collider = [0, 0, 0], {"stretch": [900, 900]}, {"type": "newton"}, {"type": "pyramid"}
        simulation = weft.Simulation(threads=1, ground=None, gravity=(0, 0, 0), wind={"velocity": speed}, integrator=integrator,
                                     collider=collider)
        cloth = simulation.add_cloth("builtin:sheet", size=9, fabric=fabric)
        speed[1], fabric["stretch"][0] = 5, -1
        integrator["type"] = collider["type"] = "none"
        list(simulation.run(2))
        self.assertLess(np.abs(simulation.velocity_at_samples(cloth)).max(), 1e-3)

    def test_texture_of_arrays_is_the_grain(self):
        places = []
        for turned in (False, True):
            simulation = weft.Simulation(threads=1, ground=None)
            cloth = simulation.add_cloth(textured_square(turned), size=17, pins=[{"image": [0, 0]}, {"image": [0, 1]}],
                                         fabric={"stretch": [2000, 100]})
            list(simulation.run(20))
            places.append(simulation.cache(cloth)[-1])
        self.assertGreater(np.abs(places[0] - places[1]).max(), 0.001)
        flat = weft.Simulation(threads=1)
        flat.add_cloth(textured_square(False), size=17, rest="uv").image

    def test_states_fit_simulations_made_alike_alone(self):
        first, cloth = sheet()
        list(first.run(3))
        state, wanted = first.save(), first.state_hash
        alike, _ = sheet()
        alike.restore(state)
        self.assertEqual((alike.frame, alike.state_hash), (3, wanted))
        for other in (sheet(translate=(0, 1, 0)), sheet(fabric="denim"), sheet(pins=[{"image": [0, 0]}])):
            with self.assertRaisesRegex(ValueError, "state"):
                other[0].restore(state)

    def test_states_fit_the_same_motions_and_textures_alone(self):
        V, F, uv = textured_square(False)
        state = moved().save()
        moved().restore(state)
        for other in (moved(path=(0, 0, -1)), moved(fps=20), moved(wait=0.5), moved(lead_in=0.5), moved((V, F, 2 * uv)),
                      moved((V, F))):
            with self.assertRaisesRegex(ValueError, "state"):
                other.restore(state)

    def test_states_fit_in_other_processes(self):
        (self.folder / "state.pickle").write_bytes(pickle.dumps(moved().save()))
        code = "import pickle, simulation_test; simulation_test.moved().restore(pickle.load(open('state.pickle', 'rb')))"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_pickled_states_go_on_with_the_same_bits(self):
        first, _ = sphere_on_floor()
        list(first.run(12))
        kept = pickle.dumps(first.save())
        list(first.run(4))
        wanted = first.state_hash
        alike, _ = sphere_on_floor()
        alike.restore(pickle.loads(kept))
        self.assertEqual(alike.frame, 12)
        list(alike.run(4))
        self.assertEqual(alike.state_hash, wanted)
        for damaged in (kept[:-200], kept.replace(b"WEFTSTAT", b"WEFTSTAB"), kept[:400] + b"?" + kept[401:]):
            with self.assertRaises((weft.InputError, pickle.UnpicklingError, EOFError)):
                pickle.loads(damaged)

    def test_velocities_are_those_of_the_fall(self):
        simulation, cloth = sheet()
        list(simulation.run(6))
        velocity = simulation.velocity_at_samples(cloth)
        self.assertEqual((velocity.shape, velocity.dtype), ((9, 9, 3), np.float32))
        np.testing.assert_allclose(velocity[..., 1], -9.81 * 6 / 60, rtol=1e-5)

    def test_level_0_needs_no_coarser_ones(self):
        simulation, cloth = sphere_on_floor()
        self.assertIs(cloth.image.coarsest_level, cloth.image.coarsest_level)
        V, F = cloth.image.to_mesh()
        self.assertEqual((len(V), len(F)), (33 * 33, 2 * 32 * 32))


if __name__ == "__main__":
    unittest.main()
