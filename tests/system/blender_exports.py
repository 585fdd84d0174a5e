"""Opens what Weft exports in Blender, headless, and compares every vertex position with ours.

By hand, after a build:    /usr/bin/python3 tests/system/blender_exports.py [--install] [--program build/release/bin/weft]
--install fetches Blender by apt. Without Blender the check says so and ends with exit code 77.
Blender runs this same file: then `bpy` is there, and the words behind `--` are a folder and where to put what was found.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

SKIPPED = 77
LARGEST_ERROR = 1e-6  # of positions, relative to the size of the surface
FRAMES = 8


# --- What Weft is given -------------------------------------------------------------------------------------------------

def quad_tube(path, scale=1.0, z_up=False, around=24, along=16):
    """An open tube of quads, with a seam in its texture and a waist, so that no two places are alike."""
    lines = []
    for j in range(along + 1):
        for i in range(around):
            angle = 2 * math.pi * i / around
            radius = 0.16 + 0.05 * math.cos(2 * math.pi * j / along) + 0.004 * math.sin(7 * angle + j)
            x, y, z = radius * math.cos(angle), 0.5 * j / along, -radius * math.sin(angle)
            if z_up:
                x, y, z = x, -z, y
            lines.append(f"v {x * scale:.6g} {y * scale:.6g} {z * scale:.6g}")
    for j in range(along + 1):
        for i in range(around + 1):
            lines.append(f"vt {i / around:.6g} {j / along:.6g}")
    for j in range(along):
        for i in range(around):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            face = [f"{b * around + a % around + 1}/{b * (around + 1) + a + 1}" for a, b in corners]
            lines.append("f " + " ".join(face))
    path.write_text("\n".join(lines) + "\n")


def scene(surface, **changes):
    cloth = {"name": "cloth", "surface": surface, "size": 33, "translate": [0, 0.4, 0], "rotate": [0, 0, 20]}
    body = {"name": "ring", "surface": "builtin:torus", "size": 17, "scale": 0.6, "translate": [0, 0.1, 0],
            "motion": [{"time": 0}, {"time": 0.2, "rotate": [0, 20, 0], "translate": [0, 0.03, 0]}]}
    return {"version": 1, "frames": FRAMES, "cloths": [cloth], "bodies": [body], **changes}


def garment_scene(path):
    """A band of two panels, sewn round the waist of a figure."""
    def panel(z, corners):
        return {"vertices": corners, "translation": [-23, 95, z],
                "edges": [{"endpoints": [k, (k + 1) % 4]} for k in range(4)]}
    panels = {"front": panel(25, [[0, 0], [46, 0], [46, 25], [0, 25]]),
              "back": panel(-25, [[0, 0], [0, 25], [46, 25], [46, 0]])}
    stitches = [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}],
                [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 0}]]
    path.write_text(json.dumps({"pattern": {"panels": panels, "stitches": stitches}, "properties": {"units_in_meter": 100}}))
    return {"version": 1, "frames": 90, "cloths": [{"name": "band", "surface": str(path), "sew": {"spacing": 0.03}}],
            "bodies": [{"name": "figure", "surface": "builtin:mannequin", "size": 65}]}


def cases(folder, shared):
    """Name: (scene, words, user's mesh or None)."""
    tube, inches = folder / "tube.obj", folder / "inches.obj"
    quad_tube(tube)
    quad_tube(inches, 1 / 0.0254, z_up=True)
    found = {"image": (scene("builtin:torus"), [], None),
             "unwelded": (scene("builtin:torus"), ["--unwelded"], None),
             "input": (scene(str(tube)), [], tube),
             "inches": (scene(str(inches), unit="in", up="z"), [], inches),
             "garment": (garment_scene(folder / "band.json"), [], None)}
    shirt = shared / "meshes/dc_tshirt1000-tri.obj"
    if shirt.exists():
        found["shirt"] = (scene(str(shirt)), ["--on", "input"], shirt)
    else:
        print(f"skipped: {shirt} is not there")
    return found


# --- What the files say, read without Weft and without Blender ----------------------------------------------------------

def read_pc2(path):
    data = path.read_bytes()
    assert data[:12] == b"POINTCACHE2\0", path
    points, frames = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    values = struct.unpack_from(f"<{3 * points * frames}f", data, 32)
    flat = [values[3 * i:3 * i + 3] for i in range(points * frames)]
    return [flat[k * points:(k + 1) * points] for k in range(frames)]


def read_obj(path):
    """Positions, faces as vertices, and of each face corner its texture coordinates."""
    positions, texture, faces, coordinates = [], [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            positions.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["vt"]:
            texture.append(tuple(map(float, words[1:3])))
        elif words[:1] == ["f"]:
            corners = [word.split("/") for word in words[1:]]
            faces.append([int(corner[0]) - 1 for corner in corners])
            coordinates.append([texture[int(corner[1]) - 1] if len(corner) > 1 and corner[1] else None for corner in corners])
    return positions, faces, coordinates


def largest_difference(found, wanted):
    """Relative to the largest side of what is wanted."""
    if len(found) != len(wanted):
        return math.inf
    side = max(max(p[k] for p in wanted) - min(p[k] for p in wanted) for k in range(3))
    return max(abs(a[k] - b[k]) for a, b in zip(found, wanted) for k in range(3)) / side


# --- In Blender ---------------------------------------------------------------------------------------------------------

def in_blender(folder, report):
    import bpy

    def empty():
        bpy.ops.wm.read_factory_settings(use_empty=True)

    def imported():
        return [thing for thing in bpy.context.scene.objects if thing.type == "MESH"][0]

    def positions(thing, frame, world=False):
        bpy.context.scene.frame_set(frame)
        shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        mesh = shown.to_mesh()
        matrix = shown.matrix_world
        found = [tuple(matrix @ v.co) if world else tuple(v.co) for v in mesh.vertices]
        shown.to_mesh_clear()
        return found

    def faces_and_uv(thing):
        mesh = thing.data
        layer = mesh.uv_layers.active
        faces, texture = [], []
        for polygon in mesh.polygons:
            faces.append(list(polygon.vertices))
            texture.append([tuple(layer.data[k].uv) for k in polygon.loop_indices] if layer else None)
        return faces, texture

    def same_uv(found, wanted):
        return all(a is not None and all(abs(x[0] - y[0]) + abs(x[1] - y[1]) < 1e-6 for x, y in zip(a, b))
                   for a, b in zip(found, wanted))

    def check(name, found, wanted):
        report.append({"check": name, "error": largest_difference(found, wanted)})

    def fact(name, holds):
        report.append({"check": name, "error": 0 if holds else math.inf})

    def load_obj(path):
        empty()
        bpy.ops.wm.obj_import(filepath=str(path))
        return imported()

    def check_obj(what, path, users):
        thing = load_obj(path)
        check(f"{what}: OBJ frame 0", positions(thing, 0), read_obj(path)[0])
        if users is None:
            return
        wanted = read_obj(users)
        faces, texture = faces_and_uv(thing)
        fact(f"{what}: faces are the user's", faces == wanted[1])
        fact(f"{what}: texture coordinates are the user's", same_uv(texture, wanted[2]))

    def check_garment(what, path, last):
        thing = load_obj(path)
        check(f"{what}: draped OBJ is the last frame", positions(thing, 0), last)
        wanted = read_obj(path)
        faces, texture = faces_and_uv(thing)
        fact(f"{what}: faces beside lines of seams", faces == wanted[1])
        fact(f"{what}: texture coordinates in centimetres", same_uv(texture, wanted[2]))
        sides = {tuple(sorted(edge)) for face in faces for edge in zip(face, face[1:] + face[:1])}
        fact(f"{what}: seams are edges of faces", {tuple(sorted(edge.vertices)) for edge in thing.data.edges} == sides)

    def check_cache(what, obj, cache, frames):
        thing = load_obj(obj)
        modifier = thing.modifiers.new("cache", "MESH_CACHE")
        modifier.cache_format = cache.suffix[1:].upper()
        modifier.filepath = str(cache)
        modifier.frame_start = 0
        bpy.context.scene.render.fps = 60
        for k in (0, 1, len(frames) // 2, len(frames) - 1):
            check(f"{what}: OBJ + {cache.suffix[1:].upper()} frame {k}", positions(thing, k), frames[k])

    def check_turned_cache(what, obj, cache, frames):
        """On a mesh that was modelled with z up and exported with y up, as Blender does by default."""
        empty()
        bpy.ops.wm.obj_import(filepath=str(obj))
        thing = imported()
        for vertex in thing.data.vertices:
            x, y, z = vertex.co
            vertex.co = (x, -z, y)
        modifier = thing.modifiers.new("cache", "MESH_CACHE")
        modifier.cache_format, modifier.filepath, modifier.frame_start = "PC2", str(cache), 0
        modifier.forward_axis, modifier.up_axis = "POS_Z", "NEG_Y"
        k = len(frames) - 1
        check(f"{what}: PC2 on a mesh with z up, frame {k}", positions(thing, k), [(x, -z, y) for x, y, z in frames[k]])

    def check_glb(what, path, frames, manifest):
        empty()
        bpy.context.scene.render.fps = 60
        bpy.ops.import_scene.gltf(filepath=str(path), import_shading="SMOOTH")
        thing = imported()
        size = manifest["metres_per_unit"]

        def metres_z_up(p):  # Blender's own axes
            x, y, z = (size * c for c in p)
            return (x, y, z) if manifest["up"] == "z" else (x, -z, y)

        for k in (0, 1, len(frames) // 2, len(frames) - 1):
            wanted = [metres_z_up(p) for p in frames[k]]
            check(f"{what}: GLB frame {k}", positions(thing, k, world=True)[:len(wanted)], wanted)
        fact(f"{what}: GLB is shaded smoothly", all(polygon.use_smooth for polygon in thing.data.polygons))
        fact(f"{what}: GLB has texture coordinates", len(thing.data.uv_layers) == 1)

    def check_ply(what, folder, name, frames):
        for k in (0, len(frames) - 1):
            empty()
            bpy.ops.import_mesh.ply(filepath=str(folder / f"{name}_ply/{name}_{k:04}.ply"))
            check(f"{what}: PLY frame {k}", positions(imported(), 0), frames[k])

    for case in json.loads((folder / "cases.json").read_text()):
        run = folder / case["name"]
        manifest = json.loads((run / "caches.json").read_text())
        for surface in manifest["surfaces"]:
            what, name = f"{case['name']}/{surface['name']}", surface["name"]
            users = pathlib.Path(case["mesh"]) if case["mesh"] and surface["kind"] == "cloth" else None
            if not surface["moves"]:
                check_obj(what, run / f"{name}.obj", None)
                continue
            frames = read_pc2(run / f"{name}.pc2")
            check_obj(what, run / f"{name}.obj", users)
            draped = run / f"{name}.draped.obj"
            if draped.exists():
                check_garment(what, draped, frames[-1])
            for ending in (".pc2", ".mdd"):
                check_cache(what, run / f"{name}.obj", run / f"{name}{ending}", frames)
            if manifest["up"] == "y":
                check_turned_cache(what, run / f"{name}.obj", run / f"{name}.pc2", frames)
            check_glb(what, run / f"{name}.glb", frames, manifest)
            if not (run / f"{name}.image.pc2").exists():
                check_ply(what, run, name, frames)
            else:
                check_ply(what, run, name, read_pc2(run / f"{name}.image.pc2") if case["ply_on_image"] else frames)


# --- From outside -------------------------------------------------------------------------------------------------------

def has_blender():
    return shutil.which("blender") is not None


def install():
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    subprocess.run([*as_root, "apt-get", "update", "-qq"], check=True)
    subprocess.run([*as_root, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", "-qq",
                    "--no-install-recommends", "blender", "python3-numpy"], check=True)


def rest_is_the_users(program, folder, mesh, run):
    """Frame 0 of a scene that places its cloth nowhere else is the user's mesh to the last bit of a float."""
    plain = {"version": 1, "frames": 1, "cloths": [{"surface": str(mesh), "size": 33}]}
    (folder / "plain.json").write_text(json.dumps(plain))
    subprocess.run([program, "simulate", folder / "plain.json", "-o", run, "--quiet"], check=True)
    as_float = [tuple(struct.unpack("3f", struct.pack("3f", *p))) for p in read_obj(mesh)[0]]
    return read_pc2(run / "cloth.pc2")[0] == as_float


def make_runs(program, folder, shared):
    listed = []
    for name, (made, words, mesh) in cases(folder, shared).items():
        (folder / f"{name}.json").write_text(json.dumps(made))
        subprocess.run([program, "simulate", folder / f"{name}.json", "-o", folder / name, "--quiet",
                        "--export", "obj,pc2,mdd,glb,ply", *words], check=True)
        listed.append({"name": name, "mesh": str(mesh) if mesh else None, "ply_on_image": words != ["--on", "input"]})
    (folder / "cases.json").write_text(json.dumps(listed))
    return listed


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--install", action="store_true", help="fetch Blender by apt first")
    words.add_argument("--program", default=os.environ.get("WEFT_PROGRAM", "build/release/bin/weft"))
    words.add_argument("--shared", default=os.environ.get("WEFT_SHARED_DIR", "../shared"), type=pathlib.Path)
    asked = words.parse_args()
    if asked.install and not has_blender():
        install()
    if not has_blender():
        print("skipped: Blender is not there (--install fetches it)")
        return SKIPPED
    program = pathlib.Path(asked.program).resolve()
    with tempfile.TemporaryDirectory(prefix="weft-blender-") as name:
        folder = pathlib.Path(name)
        report = []
        for case in make_runs(program, folder, asked.shared.resolve()):
            if case["mesh"] and case["name"] != "inches":
                same = rest_is_the_users(program, folder, pathlib.Path(case["mesh"]), folder / "plain")
                report.append({"check": f"{case['name']}: frame 0 is the user's mesh, bit for bit", "error": 0 if same else math.inf})
        done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                               "--", str(folder)], capture_output=True, text=True)
        found = folder / "found.json"
        if done.returncode != 0 or not found.exists():
            print(done.stdout[-4000:], done.stderr[-4000:])
            return 1
        report += json.loads(found.read_text())
    bad = [line for line in report if not line["error"] <= LARGEST_ERROR]
    for line in report:
        print(f"{'FAILED' if line in bad else 'ok    '} {line['check']}: {line['error']:.2g}")
    print(f"{len(report)} checks, {len(bad)} failed, largest error {max(line['error'] for line in report):.2g} of the size")
    return 1 if bad else 0


if __name__ == "__main__":
    if "bpy" in sys.modules or "--background" in sys.argv:
        place = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
        results = []
        in_blender(place, results)
        (place / "found.json").write_text(json.dumps(results))
    else:
        sys.exit(main())
