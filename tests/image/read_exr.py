"""Rebuilds the mesh of a geometry image as docs/formats.md tells: read_exr.py IMAGE.exr > MESH.obj"""
import itertools, json, pathlib, struct, sys, zlib

data, header, samples = pathlib.Path(sys.argv[1]).read_bytes(), {}, []
rest = data[8:]
while rest[0]:  # name, type, size and value of an attribute; an empty name ends the header
    name, _, rest = rest.split(b"\0", 2)
    size = int.from_bytes(rest[:4], "little")
    header[name], rest = rest[4:4 + size], rest[4 + size:]
n, behind = (weft := json.loads(header[b"weft"]))["size"], 6 * (b"colour.R" in header[b"channels"])
for offset in struct.unpack_from(f"<{(n + 15) // 16}Q", rest, 1):  # blocks of 16 rows
    row, size = struct.unpack_from("<2i", data, offset)
    block, whole = data[offset + 8:offset + 8 + size], (12 + behind) * n * min(16, n - row)
    if size < whole:
        parted = bytes(itertools.accumulate(zlib.decompress(block), lambda a, b: a + b - 128 & 255))
        block = bytes(itertools.chain(*zip(parted[:whole // 2], parted[whole // 2:])))
    for line in struct.iter_unpack(f"<{3 * n}f{behind * n}x", block):  # blue, green, red, colours
        samples += zip(line[2 * n:], line[n:], line)
def square(a, b):  # of the distance of two samples
    x, y, z = (p - q for p, q in zip(samples[a], samples[b]))
    return x * x + y * y + z * z
rising, places, triangles = {}, [], []  # diagonals of quads; of each border position its border and place
for chart in weft.get("charts", [{"row": 0, "col": 0, "rows": n, "cols": n}]):
    s, right, up = chart["row"] * n + chart["col"], chart["cols"] - 1, chart["rows"] - 1
    for q in (s + row * n + col for row in range(up) for col in range(right)):
        rising[q] = (square(q, q + n + 1), (q // n + q % n) % 2) <= (square(q + 1, q + n), 0)
    border = [(s := s + step) - step for step in [1] * right + [n] * up + [-1] * right + [-n] * up]
    places += [(border, at) for at in range(len(border))]
near = lambda t, k: places[t][0][(places[t][1] + k) % len(places[t][0])]
point = {border[at]: {border[at]} for border, at in places}  # the samples that are one with each
for first, mate, count, *turned in weft["mates"]:
    for k in range(count + 1):
        joined = point[near(first, k)] | point[near(mate, k if any(turned) else -k)]
        point.update(dict.fromkeys(joined, joined))
for t in range(len(places)):  # the quad inside the edge from t to t + 1: the first rule that holds
    s = {k: near(t, k) for k in range(-3, 4)}
    p = {k: min(point[s[k]]) for k in s}
    before, here, ahead, after = (s[k] - s[k - 1] != s[k + 1] - s[k] for k in (-1, 0, 1, 2))  # corners
    rules = [here and p[-1] != p[1], here, p[-1] == p[1], p[0] == p[2],
             before and p[1] in (p[-2], p[-3]), after and p[0] == p[3]]
    if any(rules) and not ahead:
        q = s[0] + {1: 0, n: -1, -1: -n - 1, -n: -n}[s[1] - s[0]]
        rising[q] = s[rules.index(True) % 2] in (q, q + n + 1)
for q in sorted(rising):
    a, b, c, d = (min(point.get(s, [s])) for s in (q, q + 1, q + n + 1, q + n))
    halves = [(a, b, c), (a, c, d)] if rising[q] else [(a, b, d), (b, c, d)]
    triangles += [t for t in halves if len(set(t)) == 3]
number = {s: k for k, s in enumerate(sorted(set(itertools.chain(*triangles))), 1)}
for s in number: print("v", *(low + weft["scale"] * x for low, x in zip(weft["lower"], samples[s])))
for t in triangles: print("f", *(number[s] for s in t))
