#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets: small files of every format, each with a feature of its own.

Usage: make_corpus.py [FOLDER]   (default: corpus beside this script; found-* files there are kept)
"""
import base64
import io
import json
import pathlib
import struct
import sys
import zipfile
import zlib

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def obj_files():
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in POINTS)
    faces = "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in FACES)
    yield "plain", vertices + faces
    yield "texture", vertices + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 3/3/1 2/2/1\nf 1//1 2//1 4//1\nf 1/1 4/2 3/3\n"
    yield "relative", vertices + "f -4 -2 -3\nf -4 -3 -1\n"
    yield "forward", faces + vertices
    yield "continued", vertices + "f 1 \\\n 3 \\\n 2\n" + "v 1 1 \\\r\n 0 1.0\r\nf 1 2 5 3\r\n"
    yield "words", "# a comment\nmtllib a.mtl\no thing\ng part\nusemtl red\ns off\n" + vertices + faces + "l 1 2\np 1\n"
    for order in ("le", "be"):
        yield f"utf16_{order}", ("\ufeff# \u00e4\n" + vertices + faces).encode(f"utf-16-{order}")
    yield "numbers", "v 1e-3 +2 .5\nv -1.5E2 0x1 3\nv nan inf -inf\nv 1e400 1e-400 0\nf 1 2 3\n"


def off_files():
    vertices = "".join(f"{x} {y} {z}\n" for x, y, z in POINTS)
    faces = "".join("3 " + " ".join(map(str, face)) + "\n" for face in FACES)
    yield "plain", f"OFF\n4 4 6\n{vertices}{faces}"
    yield "one_line", f"OFF 4 4 0\n{vertices}{faces}"
    yield "colours", "COFF # comment\n3 1\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n\n3 0 1 2 0.5 0.5 0.5\n"
    yield "broken_lines", "COFF\n3\n1\n0\n0 0\n0 255\n1\n0\n0\n0 1 0\n3 0 # more\n1\n2 255 0 0\n"
    yield "polygon", "OFF\n5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n"
    yield "false_count", "OFF\n4000000000 4000000000 0\n0 0 0\n"


def ply_header(form, vertices, faces, extra=""):
    return (f"ply\nformat {form} 1.0\ncomment ours\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
            f"property float z\n{extra}element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode()


def strips_header(form):
    return ply_header(form, 4, 1).replace(b"face", b"tristrips").replace(b"uchar", b"int")


def ply_files():
    text = "".join(f"{x} {y} {z}\n" for x, y, z in POINTS) + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
    yield "text", ply_header("ascii", 4, 4) + text.encode()
    for name, mark in (("little", "<"), ("big", ">")):
        body = b"".join(struct.pack(mark + "3f", *p) for p in POINTS)
        body += b"".join(struct.pack(mark + "B3i", 3, *f) for f in FACES)
        yield name, ply_header(f"binary_{name}_endian", 4, 4) + body
    extra = "property uchar red\nproperty list uint short weights\nelement other 2\nproperty double q\n"
    body = b"".join(struct.pack("<3fBI2h", *p, 7, 2, 1, 2) for p in POINTS) + struct.pack("<2d", 1, 2)
    yield "extra", ply_header("binary_little_endian", 4, 1, extra) + body + struct.pack("<B4i", 4, 0, 1, 2, 3)
    yield "strips_text", strips_header("ascii") + (text.split("3 0", 1)[0] + "10 0 1 2 3 -1 3 2 2 1 -1\n").encode()
    for name, mark in (("little", "<"), ("big", ">")):
        body = b"".join(struct.pack(mark + "3f", *p) for p in POINTS)
        body += struct.pack(mark + "11i", 10, 0, 1, 2, 3, -1, 3, 2, 2, 1, -1)
        yield f"strips_{name}", strips_header(f"binary_{name}_endian") + body
    stray = ply_header("ascii", 4, 4, "\nrevision 3 \r\n").replace(b"format", b"comment\nformat")
    yield "stray_lines", b"\xef\xbb\xbf" + stray + text.encode()
    yield "false_count", ply_header("binary_little_endian", 4000000000, 4) + b"\0" * 12


def stl_files():
    facet = "facet normal 0 0 1\n outer loop\n  vertex {}\n  vertex {}\n  vertex {}\n endloop\nendfacet\n"
    corners = ["{} {} {}".format(*p) for p in POINTS]
    yield "text", "solid ours\n" + "".join(facet.format(*(corners[i] for i in f)) for f in FACES) + "endsolid ours\n"
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *(x for i in f for x in POINTS[i]), 0) for f in FACES)
    yield "binary", b"solid".ljust(80) + struct.pack("<I", len(FACES)) + body
    yield "false_count", b"\0" * 80 + struct.pack("<I", 4000000000) + body


def glb(content, binary):
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def with_parts(content, binary, *parts):
    """A file with further accessors, of (bytes, component type, count, type, more keys)."""
    content = json.loads(json.dumps(content))
    for data, component, count, kind, more in parts:
        binary += b"\0" * (-len(binary) % 4)
        content["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        content["accessors"].append({"bufferView": len(content["bufferViews"]) - 1, "componentType": component, "count": count,
                                     "type": kind, **more})
        binary += data
    return {**content, "buffers": [{"byteLength": len(binary)}]}, binary


def skinned(content, binary):
    turn = struct.pack("<8f", 0, 0, 0, 1, 0, 0, 0.6, 0.8)
    content, binary = with_parts(
        content, binary, (bytes([0, 1, 0, 0] * 4), 5121, 4, "VEC4", {}), (bytes([200, 55, 0, 0] * 4), 5121, 4, "VEC4", {"normalized": True}),
        (struct.pack("<32f", *[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2), 5126, 2, "MAT4", {}),
        (struct.pack("<2f", 0, 1), 5126, 2, "SCALAR", {}), (turn, 5126, 2, "VEC4", {}), (struct.pack("<18f", *range(18)), 5126, 6, "VEC3", {}))
    return glb({**content, "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"translation": [0, 1, 0]}], "scenes": [{"nodes": [0, 1]}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 1}]}],
                "skins": [{"joints": [1, 2], "inverseBindMatrices": 4}],
                "animations": [{"name": "a", "samplers": [{"input": 5, "output": 6}, {"input": 5, "output": 7, "interpolation": "CUBICSPLINE"}],
                                "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}},
                                             {"sampler": 1, "target": {"node": 1, "path": "translation"}}]}]}, binary)


def morphed(content, binary):
    content, binary = with_parts(content, binary, (struct.pack("<2H", 1, 3), 5123, 2, "SCALAR", {}), (struct.pack("<6f", *range(6)), 5126, 2, "VEC3", {}),
                                 (struct.pack("<2f", 0, 1), 5126, 2, "SCALAR", {}), (struct.pack("<2f", 0, 1), 5126, 2, "SCALAR", {}))
    content["accessors"].append({"componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
        "count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}}})
    content["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": len(content["accessors"]) - 1}]
    return glb({**content, "animations": [{"samplers": [{"input": 4, "output": 5, "interpolation": "STEP"}],
                                           "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}]}, binary)


def glb_files():
    binary = b"".join(struct.pack("<3f", *p) for p in POINTS) + b"".join(struct.pack("<3H", *f) for f in FACES)
    content = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": 72}]}
    yield "plain", glb(content, binary)
    nodes = [{"children": [1, 2], "scale": [1, 2, -1]}, {"mesh": 0, "rotation": [0, 0, 0.6, 0.8]},
             {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]}]
    yield "nodes", glb({**content, "nodes": nodes}, binary)
    primitives = [{"attributes": {"POSITION": 0}, "mode": 5}, {"attributes": {"POSITION": 0}, "indices": 1, "mode": 6},
                  {"attributes": {"POSITION": 0}, "mode": 1}]
    yield "strips", glb({**content, "meshes": [{"primitives": primitives}]}, binary)
    quantized = {**content, "extensionsRequired": ["KHR_mesh_quantization"],
                 "accessors": [{"bufferView": 0, "componentType": 5122, "normalized": True, "count": 3, "type": "VEC3"},
                               {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
                 "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 8},
                                 {"buffer": 0, "byteOffset": 24, "byteLength": 3}]}
    textured = {**content, "accessors": content["accessors"] + [
        {"bufferView": 0, "componentType": 5123, "normalized": True, "count": 4, "type": "VEC2"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1}]}]}
    yield "texture", glb(textured, binary)
    short = struct.pack("<12h", 0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0) + bytes([0, 1, 2])
    yield "quantized", glb({**quantized, "buffers": [{"byteLength": 27}]}, short)
    yield from (("skinned", skinned(content, binary)), ("morphed", morphed(content, binary)))
    uri = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    yield "text", json.dumps({**content, "buffers": [{"byteLength": 72, "uri": uri}]}, indent=1).encode()


def metadata(size, mates):
    return json.dumps({"version": 1, "size": size, "mates": mates, "lower": [-1, 0, 0.5], "scale": 2.5,
                       "source": "ours.obj", "source_hash": "0123456789abcdef"}, separators=(",", ":")).encode()


def sample(row, col, size):
    """x, y, z in eighths, the same on opposite sides."""
    row, col = row % (size - 1), col % (size - 1)
    return [(3 * row + col) % 9 / 8, (row + 2 * col) % 9 / 8, row * col % 9 / 8]


def exr(size, text, zipped):
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value
    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, size - 1, size - 1)
    head = struct.pack("<II", 20000630, 2)
    head += attribute("channels", "chlist", channels) + attribute("compression", "compression", bytes([3 * zipped]))
    head += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + attribute("weft", "string", text) + b"\0"
    lines = [b"".join(struct.pack("<f", sample(row, col, size)[k]) for k in (2, 1, 0) for col in range(size))
             for row in range(size)]
    blocks = [(row, b"".join(lines[row:row + 16])) for row in range(0, size, 16)] if zipped else list(enumerate(lines))
    if zipped:
        blocks = [(row, squeezed(block)) for row, block in blocks]
    offsets, body = b"", b""
    start = len(head) + 8 * len(blocks)
    for row, block in blocks:
        offsets += struct.pack("<Q", start + len(body))
        body += struct.pack("<ii", row, len(block)) + block
    return head + offsets + body


def squeezed(block):
    """OpenEXR's ZIP: even bytes before odd ones, differences, deflate."""
    ordered = block[0::2] + block[1::2]
    steps = bytes([ordered[0]] + [(b - a + 128) & 255 for a, b in zip(ordered, ordered[1:])])
    return zlib.compress(steps)


def png(size, text, zipped):
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    rows = b"".join(b"\0" + b"".join(struct.pack(">H", round(x * 65535)) for col in range(size)
                                     for x in sample(row, col, size)) for row in range(size))
    words = b"weft\0" + bytes([zipped, 0]) + b"\0\0" + (zlib.compress(text) if zipped else text)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 16, 2, 0, 0, 0))
            + chunk(b"iTXt", words) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def image_files():
    torus = [[0, 12, 4], [4, 16, 4]]
    for zipped in (False, True):
        yield f"torus{'_zip' * zipped}.exr", exr(5, metadata(5, torus), zipped)
        yield f"torus{'_zip' * zipped}.png", png(5, metadata(5, torus), zipped)
    yield "sheet.exr", exr(9, metadata(9, []), False)
    yield "sheet.png", png(6, metadata(6, []), False)


def cache_files():
    def pc2(points, samples, count):
        return (b"POINTCACHE2\0" + struct.pack("<iiffi", 1, points, 0, 1, samples)
                + struct.pack(f"<{count}f", *(i / 8 for i in range(count))))

    def mdd(points, times, count):
        return struct.pack(f">ii{len(times)}f{count}f", len(times), points, *times, *(i / 8 for i in range(count)))

    yield "two.pc2", pc2(2, 3, 18)
    yield "cut.pc2", pc2(2, 3, 17)
    yield "false_count.pc2", pc2(2**31 - 1, 2**31 - 1, 3)
    yield "one.mdd", mdd(1, [0, 0.04, 0.08], 9)
    yield "backward.mdd", mdd(1, [1, 0], 6)


def npy(descr, shape, body, fortran_order=False):
    header = f"{{'descr': '{descr}', 'fortran_order': {fortran_order}, 'shape': {shape}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(header)) + header.encode() + body


def npz_files():
    def archive(method, **arrays):
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as files:
            for name, array in arrays.items():
                member = zipfile.ZipInfo(f"{name}.npy")  # of a fixed date
                member.compress_type = method
                files.writestr(member, array)
        return packed.getvalue()

    singles = npy("<f4", "(2, 2, 3)", struct.pack("<12f", *(i / 8 for i in range(12))))
    doubles = npy("<f8", "(1, 2, 3)", struct.pack("<6d", *range(6)), True)
    yield "stored", archive(zipfile.ZIP_STORED, vertices=singles, fps=npy("<i4", "()", struct.pack("<i", 25)))
    yield "deflated", archive(zipfile.ZIP_DEFLATED, faces=singles, vertices=doubles)
    yield "objects", archive(zipfile.ZIP_STORED, vertices=npy("|O", "(1, 1, 3)", b"cos\nsystem\n"))
    yield "array", singles
    yield "false_count", npy("<f4", "(99999999999, 99999999999, 3)", b"")


def scene_files():
    yield "least", {"cloths": [{}]}
    yield "pins", {"cloths": [{"size": 65, "pins": [{"image": [0, 0]}, {"nearest": [1, 0, 1]},
                                                   {"region": [[0, 0], [1, 0.5]]}]}]}
    yield "methods", {"version": 1, "integrator": {"type": "two_level", "local_size": 5, "global_size": 9,
                                                   "as_printed": True, "filter_stiffness": 2.5, "limiter_passes": 3},
                      "collider": {"type": "polar_map", "size": 64, "walk": False}, "cloths": [{}]}
    yield "whole", {
        "version": 1, "gravity": [0, -9.81, 0], "frame_rate": 60, "substeps": 4, "frames": 120, "ground": None,
        "wind": {"velocity": [0, 0, 0]}, "integrator": {"type": "implicit", "max_iterations": 50, "tolerance": 1e-3},
        "cloths": [{"name": "sheet", "surface": "a/../b.exr", "scale": [1, 2, 3], "rotate": [0, 90, 0],
                    "translate": [0, 1, 0], "material": {"density": 0.2, "stretch": 500, "shear": 50, "bending": 0,
                                                         "bend_springs": 1, "damping": 1, "strain_limit": 0.05,
                                                         "thickness": 0.002},
                    "self_collision": False, "friction": 0.4, "velocity": [0, 0, 1]},
                   {"name": "second", "material": "cotton", "surface": "builtin:torus"}],
        "bodies": [{"name": "figure", "surface": "builtin:mannequin", "friction": 0.4, "scale": 0.5}]}
    yield "moving", {"cloths": [{"attach": [{"body": "b", "region": [[0, 0], [1, 0]]}]}],
                     "bodies": [{"name": "b", "surface": "builtin:rod", "lead_in": 0.5,
                                 "motion": [{"time": 0}, {"time": 1, "rotate": [0, 9, 0], "translate": [0, 1, 0]}]},
                                {"name": "c", "surface": "c.obj", "animation": "c.pc2"}]}
    yield "explicit", {"integrator": {"type": "explicit"}, "ground": -1, "cloths": [{"name": "a"}, {"name": "a"}]}


def pattern_files():
    def panel(vertices, curvature=None, **more):
        count = len(vertices)
        edges = [{"endpoints": [k, (k + 1) % count]} for k in range(count)]
        if curvature:
            edges[0]["curvature"] = curvature
        return {"vertices": vertices, "edges": edges, **more}

    square = [[0, 0], [40, 0], [40, 60], [0, 60]]
    sides = [[{"panel": "front", "edge": k}, {"panel": "back", "edge": k}] for k in (1, 3)]
    yield "two", {"pattern": {"panels": {"front": panel(square, translation=[0, 90, 25], rotation=[0, 0, 0]),
                                         "back": panel(square, translation=[0, 90, -25], rotation=[0, 180, 0])},
                              "stitches": [sides[0], [*sides[1], "right_wrong"]]},
                  "properties": {"units_in_meter": 100}}
    curves = [[0.5, 0.2], {"type": "quadratic", "params": [[0.5, -0.2]]}, {"type": "cubic", "params": [[0.3, 0.2], [0.6, -0.1]]},
              {"type": "circle", "params": [25, 0, 1]}, {"type": "circle", "params": [19, 1, 0]}]
    yield "curves", {"pattern": {"panels": {f"p{k}": panel(square, curve) for k, curve in enumerate(curves)}, "stitches": []}}
    short = [[0, 0], [40, 0], [40, 0.001], [40, 60], [0, 60]]
    yield "short_edge", {"pattern": {"panels": {"a": panel(short), "b": panel(square)},
                                     "stitches": [[{"panel": "a", "edge": 3}, {"panel": "b", "edge": 3}]]}}
    yield "crossed", {"pattern": {"panels": {"a": panel([[0, 0], [40, 60], [40, 0], [0, 60]])}}}


def checkpoint_files():
    def text(words):
        return struct.pack("<Q", len(words)) + words

    def checkpoint(identity, frames, sizes):
        body = text(b"0.1.0") + text(identity) + struct.pack("<3di4q", 0, 1, 2, 1, 3, 4, 5, 6) + struct.pack("<Q", frames)
        for k in range(frames):
            body += struct.pack("<5di6di4d", 9, 1, 2, 3, 4, 5, 1e-3, 0, 0.1, 0.2, 3, 4, k, 0.5, 0, 1, 0)
        body += struct.pack("<I", len(sizes))
        for n in sizes:
            body += struct.pack("<i", n) + struct.pack(f"<{6 * n * n}f", *(float(i) for i in range(6 * n * n)))
        value = 0xcbf29ce484222325
        for byte in body:
            value = (value ^ byte) * 0x100000001b3 % 2 ** 64
        return b"WEFTCKPT" + struct.pack("<IQQ", 2, len(body), value) + body

    yield "least", checkpoint(b"{}", 0, [5])
    yield "two_cloths", checkpoint(b'{"substeps":4}', 3, [5, 6])
    yield "false_count", checkpoint(b"{}", 1, []).replace(struct.pack("<I", 0), struct.pack("<I", 2 ** 31))


def query_files():
    def query(rows, truth=1):
        return "".join(",".join(map(str, [*row, truth])) + "\n" for row in rows)

    face = [(-1, 1, 0, 1, -1, 1), (1, 1, 0, 1, -1, 1), (0, 1, 0, 1, 2, 3)]
    falls = [(0, 1, 1, 1, 0, 1), *face, (0, 1, -1, 1, 0, 1), *face]
    huge = [(10 ** 29, 1, -3 * 10 ** 33, 10 ** 9, 1, 10 ** 40)] * 3 + [(0, 1, 0, 7, -0, 1)] * 5
    yield "falls", query(falls)
    yield "two", query(falls) + query(huge, 0)
    yield "cut", query(falls)[:-9]


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "corpus"
    kinds = {"obj": obj_files, "off": off_files, "ply": ply_files, "stl": stl_files, "glb": glb_files,
             "image": image_files, "cache": cache_files, "npz": npz_files, "scene": scene_files, "pattern": pattern_files,
             "checkpoint": checkpoint_files, "queries": query_files}
    for kind, files in kinds.items():
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for name, content in files():
            if isinstance(content, dict):
                content = json.dumps(content)
            (folder / kind / name).write_bytes(content.encode() if isinstance(content, str) else content)


if __name__ == "__main__":
    main()
