"""The module under test, beside the program; shared by the tests of this folder."""
import os

import numpy as np

import weft
from program import ProgramTest


class ModuleTest(ProgramTest):
    """A test that stands in a folder of its own, gone at its end."""

    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)


def small_torus(around=10, along=14):
    """A torus of few triangles. V, F"""
    i, j = np.meshgrid(np.arange(along), np.arange(around), indexing="ij")
    a, b = 2 * np.pi * i / along, 2 * np.pi * j / around
    V = np.stack([(1 + 0.4 * np.cos(b)) * np.cos(a), 0.4 * np.sin(b), -(1 + 0.4 * np.cos(b)) * np.sin(a)], -1).reshape(-1, 3)
    p, q = i * around + j, i * around + (j + 1) % around
    r, s = (i + 1) % along * around + j, (i + 1) % along * around + (j + 1) % around
    return V, np.concatenate([np.stack([p, r, s], -1).reshape(-1, 3), np.stack([p, s, q], -1).reshape(-1, 3)])


def sphere_on_floor():
    """A small ball and a sheet above it, which touch within a few frames."""
    simulation = weft.Simulation(threads=1)
    simulation.add_body(weft.Body("builtin:sphere", size=33), scale=0.5, translate=(0, 0.3, 0))
    cloth = simulation.add_cloth(weft.builtin("sheet", size=33), translate=(0, 0.56, 0))
    return simulation, cloth
