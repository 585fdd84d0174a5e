"""Long calls: other threads of Python run on, Ctrl-C ends them, progress is told, and memory stays flat."""
import gc
import os
import pathlib
import resource
import signal
import subprocess
import sys
import threading
import unittest

import weft
from module import ModuleTest, small_torus, sphere_on_floor

ROUNDS = int(os.environ.get("WEFT_LEAK_ROUNDS", 20))  # by hand: 1000
PAGE = os.sysconf("SC_PAGE_SIZE")

# Converts what takes long, or simulates, until the signal comes; says what it was stopped by.
LONG = """
import sys, time, numpy as np, weft
V, F = weft.read_mesh("builtin:mannequin")
first = True
def told(stage, fraction):
    global first
    if first and stage in (sys.argv[2:] or [stage]):
        print("begun", flush=True)
        first = False
try:
    if sys.argv[1] == "convert":
        weft.geometry_image(V, F, size=4097, progress=told, threads=1)
    else:
        simulation = weft.Simulation()
        simulation.add_body(weft.Body(V, F, size=257))
        cloth = simulation.add_cloth(weft.builtin("tshirt", size=257))
        simulation.start()
        for frame in simulation.run(10000, progress=told):
            pass
    print("done")
except KeyboardInterrupt:
    print("interrupted")
    if sys.argv[1] == "simulate":
        frame = simulation.frame
        *_, last = simulation.run(1)  # goes on
        print("went on", last.number - frame)
"""


def processor_seconds_of_children():
    """Of those that have ended: no matter how crowded the machine is."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Calls(ModuleTest):
    def test_other_threads_run_while_a_conversion_does(self):
        V, F = weft.read_mesh("builtin:mannequin")
        counted, stop = 0, threading.Event()

        def count():
            nonlocal counted
            while not stop.wait(0.001):
                counted += 1
        counter = threading.Thread(target=count)
        counter.start()
        before = counted
        weft.geometry_image(V, F, size=129, threads=1)
        during = counted - before
        stop.set()
        counter.join()
        self.assertGreater(during, 20)

    def test_conversions_of_several_threads_agree(self):
        V, F = weft.read_mesh("builtin:knot")
        wanted = weft.geometry_image(V, F, size=33).positions
        found = [None] * 4

        def convert(k):
            found[k] = weft.geometry_image(V, F, size=33, threads=1 + k % 2).positions
        threads = [threading.Thread(target=convert, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for positions in found:
            self.assertTrue((positions == wanted).all())

    def test_a_simulation_is_stepped_by_one_thread_at_a_time(self):
        simulation, _ = sphere_on_floor()
        simulation.start()
        refused = []

        def step():
            try:
                list(simulation.run(30))
            except RuntimeError as error:
                refused.append(str(error))
        threads = [threading.Thread(target=step) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all("at work" in text for text in refused), refused)
        self.assertGreaterEqual(simulation.frame, 30)

    def test_children_of_forks_step_on_with_the_same_bits(self):
        simulations = []
        for _ in range(2):
            simulations.append(weft.Simulation(threads=2))
            simulations[-1].add_cloth("builtin:sheet", size=17, translate=(0, 0.6, 0), rotate=(20, 0, 0))
            next(simulations[-1].run(1))
        told, tell = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                signal.alarm(60)
                simulations.pop()  # ends without a wait, though it was never stepped here
                list(simulations[0].run(3))
                os.write(tell, simulations.pop().state_hash.encode())
                os._exit(7)
            finally:
                os._exit(1)
        os.close(tell)
        with open(told, encoding="utf-8") as file:
            stepped = file.read()
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 7)
        list(simulations[0].run(3))
        self.assertEqual(stepped, simulations[0].state_hash)

    def interrupted(self, *words):
        """What is said after Ctrl-C, and processor seconds from there to the end."""
        before = processor_seconds_of_children()
        process = subprocess.Popen([sys.executable, "-c", LONG, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "begun\n")
        stat = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        used = (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")
        process.send_signal(signal.SIGINT)
        said, complaints = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, complaints)
        return said, processor_seconds_of_children() - before - used

    def test_ctrl_c_ends_a_conversion_within_a_second(self):
        for stage in ("cut", "map"):
            said, seconds = self.interrupted("convert", stage)
            self.assertEqual(said, "interrupted\n")
            if not os.environ.get("WEFT_SANITIZE"):
                self.assertLess(seconds, 1, stage)

    def test_ctrl_c_ends_a_simulation_which_can_go_on(self):
        self.assertEqual(self.interrupted("simulate")[0], "interrupted\nwent on 1\n")

    def test_progress_is_told_in_order_and_to_bars(self):
        V, F = weft.read_mesh("builtin:mannequin")
        told = []
        weft.geometry_image(V, F, size=129, progress=lambda stage, fraction: told.append((stage, fraction)))
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in told))
        self.assertLessEqual({stage for stage, _ in told}, {"repair", "cut", "map", "sample", "measure"})
        self.assertGreater(len(told), 2)

        class Bar:
            n, total = 0, 100
            def update(self, more):
                self.n += more
        bar = Bar()
        simulation, _ = sphere_on_floor()
        list(simulation.run(3, progress=bar))
        self.assertAlmostEqual(bar.n, 100)

    def test_memory_stays_flat(self):
        V, F = small_torus()

        def once():
            image = weft.geometry_image(V, F, size=17, threads=1, progress=lambda *_: None)
            image.charts[0].positions.sum()
            image.to_mesh()
            simulation = weft.Simulation(threads=1)
            cloth = simulation.add_cloth(image)
            simulation.add_body(weft.Body(V, F, size=17), translate=(0, -1, 0))
            for frame in simulation.run(1):
                frame.positions(cloth)
            try:
                weft.geometry_image(V, F + 9999, size=17)
            except weft.InputError:
                pass

        def resident():
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * PAGE
        for _ in range(10):
            once()
        before = resident()
        for _ in range(ROUNDS):
            once()
        grown = resident() - before
        print(f"{grown} bytes more after {ROUNDS} rounds", file=sys.stderr)
        # An array of an image of 17 x 17 that were kept by every round would come to three times that.
        self.assertLess(grown, 2_000_000 + ROUNDS * 2000)


if __name__ == "__main__":
    unittest.main()
