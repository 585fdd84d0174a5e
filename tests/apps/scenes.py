"""Small scenes, for tests that simulate."""
import csv
import json

from program import ProgramTest


def sheet_scene(**changes):
    """A small sheet in the air above the ground."""
    scene = {"version": 1, "frames": 5, "ground": None,
             "integrator": {"type": "implicit"}, "collider": {"type": "polar_map"},
             "cloths": [{"name": "sheet", "surface": "builtin:sheet", "size": 17, "translate": [0, 1, 0]}]}
    scene.update(changes)
    return scene


class SceneTest(ProgramTest):
    def write_scene(self, scene, name="scene.json"):
        (self.folder / name).write_text(scene if isinstance(scene, str) else json.dumps(scene))
        return name

    def table(self, folder):
        with open(self.folder / folder / "frames.csv", newline="") as lines:
            return list(csv.DictReader(lines))
