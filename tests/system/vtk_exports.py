"""Opens exported VTP files with VTK, which ParaView reads by, and compares positions, normals and polygons with ours.

By hand, after a build:    /usr/bin/python3 tests/system/vtk_exports.py [--install] [--program build/release/bin/weft]
--install fetches VTK's Python module by apt. Without it the check says so and ends with exit code 77.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

from blender_exports import SKIPPED, largest_difference, quad_tube, read_obj, read_pc2


def install():
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    subprocess.run([*as_root, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", "-qq",
                    "--no-install-recommends", "python3-vtk9"], check=True)


def read_vtp(path):
    """Positions, normals, polygons and the time."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    normals = data.GetPointData().GetNormals()
    count = data.GetNumberOfPoints()
    polygons = [[data.GetCell(k).GetPointId(i) for i in range(data.GetCell(k).GetNumberOfPoints())]
                for k in range(data.GetNumberOfCells())]
    time = data.GetFieldData().GetArray("TimeValue").GetValue(0)
    return ([data.GetPoint(k) for k in range(count)], [normals.GetTuple3(k) for k in range(count)], polygons, time)


def check(program, folder):
    quad_tube(folder / "tube.obj")
    scene = {"version": 1, "frames": 5, "cloths": [{"surface": "tube.obj", "size": 33, "translate": [0, 0.4, 0], "rotate": [0, 0, 20]}]}
    (folder / "scene.json").write_text(json.dumps(scene))
    subprocess.run([program, "simulate", folder / "scene.json", "-o", folder / "run", "--quiet", "--on", "input",
                    "--export", "obj,pc2,vtp"], check=True)
    frames = read_pc2(folder / "run/cloth.pc2")
    faces = read_obj(folder / "tube.obj")[1]
    listed = xml.parse(folder / "run/cloth.pvd").getroot().findall("./Collection/DataSet")
    facts = [("the PVD lists every frame", len(listed) == len(frames))]
    for k, entry in enumerate(listed):
        positions, normals, polygons, time = read_vtp(folder / "run" / entry.get("file"))
        facts += [(f"frame {k}: positions", largest_difference(positions, frames[k]) == 0),
                  (f"frame {k}: polygons are the user's", polygons == faces),
                  (f"frame {k}: normals are unit", all(abs(math.hypot(*n) - 1) < 1e-6 for n in normals)),
                  (f"frame {k}: time", abs(time - k / 60) < 1e-12 and abs(float(entry.get("timestep")) - time) < 1e-12)]
    return facts


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--install", action="store_true", help="fetch VTK by apt first")
    words.add_argument("--program", default=os.environ.get("WEFT_PROGRAM", "build/release/bin/weft"))
    asked = words.parse_args()
    if asked.install:
        install()
    try:
        import vtkmodules  # noqa: F401
    except ImportError:
        print("skipped: VTK is not there (--install fetches it)")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="weft-vtk-") as name:
        facts = check(pathlib.Path(asked.program).resolve(), pathlib.Path(name))
    for what, holds in facts:
        print(f"{'ok    ' if holds else 'FAILED'} {what}")
    print(f"{len(facts)} checks, {sum(not holds for _, holds in facts)} failed")
    return 0 if all(holds for _, holds in facts) else 1


if __name__ == "__main__":
    sys.exit(main())
