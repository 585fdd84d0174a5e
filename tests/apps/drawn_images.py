"""Geometry images of any positions whatever, their borders joined in ways that no mesh asks for; and their EXR files."""
import itertools
import json
import random
import struct


def border_samples(chart, n):
    """Positions go along the first row, the last column, the last row, the first column."""
    top, left = chart["row"], chart["col"]
    bottom, right = top + chart["rows"] - 1, left + chart["cols"] - 1
    return ([top * n + c for c in range(left, right)] + [r * n + right for r in range(top, bottom)]
            + [bottom * n + c for c in range(right, left, -1)] + [r * n + left for r in range(bottom, top, -1)])


def cells_of(chart):
    return {(r, c) for r in range(chart["row"], chart["row"] + chart["rows"])
            for c in range(chart["col"], chart["col"] + chart["cols"])}


def draw_charts(draw, n):
    """Rectangles that do not overlap; at times two touch."""
    charts, taken = [], set()
    for _ in range(8):
        rows, cols = draw.randrange(5, 10), draw.randrange(5, 10)
        chart = {"name": "", "row": draw.randrange(n - rows + 1), "col": draw.randrange(n - cols + 1),
                 "rows": rows, "cols": cols}
        if taken.isdisjoint(cells_of(chart)):
            taken |= cells_of(chart)
            charts.append(chart)
    return charts


def draw_mates(draw, places, several):
    """Runs, which overlap and turn in images of several charts. `places`: of each position its border and place there."""
    mates, taken, total = [], set(), 0
    for _ in range(draw.randrange(9)):
        first = draw.randrange(len(places))
        mate = first if draw.random() < 0.3 else draw.randrange(len(places))  # the same: a cut with its tip here
        (a, i), (b, j) = places[first], places[mate]
        longest = min(len(a), len(b)) // (1 if several else 2)
        count = draw.randrange(1, 1 + draw.choice([min(3, longest), longest]))
        turned = several and draw.random() < 0.3
        edges = [a[(i + k) % len(a)] for k in range(count)] + [b[(j - k - 1) % len(b)] for k in range(count)]
        overlaps = len(set(edges)) < len(edges) or not taken.isdisjoint(edges)
        if total + count > len(places) or (overlaps and not several):
            continue
        taken |= set(edges)
        total += count
        mates.append([first, mate, count] + [1] * turned)
    return mates


def join(samples, mates, places):
    """Gives samples that are one point the same position."""
    classes = {border[at]: {border[at]} for border, at in places}
    for first, mate, count, *turned in mates:
        (a, i), (b, j) = places[first], places[mate]
        for k in range(count + 1):
            joined = classes[a[(i + k) % len(a)]] | classes[b[(j + (k if turned else -k)) % len(b)]]
            classes.update(dict.fromkeys(joined, joined))
    for members in classes.values():
        for sample in members:
            samples[sample] = samples[min(members)]


def draw_image(seed, several):
    """Metadata and samples."""
    draw = random.Random(seed)
    n = draw.randrange(11, 20) if several else draw.randrange(5, 10)
    charts = draw_charts(draw, n) if several else [{"row": 0, "col": 0, "rows": n, "cols": n}]
    values = [draw.random() for _ in range(3 if draw.random() < 0.3 else 1000)]  # few: diagonals of equal length
    inside = set().union(*map(cells_of, charts))
    samples = [struct.unpack("<3f", struct.pack("<3f", *draw.choices(values, k=3)))
               if cell in inside else (0, 0, 0) for cell in itertools.product(range(n), repeat=2)]
    places = [(border, at) for border in (border_samples(chart, n) for chart in charts) for at in range(len(border))]
    mates = draw_mates(draw, places, several)
    join(samples, mates, places)
    weft = {"version": 2 if several else 1, "size": n, "mates": mates, "scale": draw.uniform(0.1, 9),
            "lower": [draw.uniform(-9, 9) for _ in range(3)], "source": "drawn", "source_hash": ""}
    return (dict(weft, charts=charts) if several else weft), samples


def exr_header(weft):
    window = struct.pack("<4i", 0, 0, weft["size"] - 1, weft["size"] - 1)
    channels = b"".join(struct.pack("<2s4i", name, 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    attributes = (("channels", "chlist", channels), ("compression", "compression", b"\3"),
                  ("dataWindow", "box2i", window), ("displayWindow", "box2i", window),
                  ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)),
                  ("screenWindowCenter", "v2f", bytes(8)), ("screenWindowWidth", "float", struct.pack("<f", 1)),
                  ("weft", "string", json.dumps(weft).encode()))
    return struct.pack("<2I", 20000630, 2) + b"".join(
        f"{name}\0{kind}\0".encode() + struct.pack("<I", len(value)) + value for name, kind, value in attributes) + b"\0"


def exr_bytes(weft, samples):
    """The file as another program may write it: without a checksum, blocks as they are."""
    n, header, blocks = weft["size"], exr_header(weft), []
    for row in range(0, n, 16):
        lines = [samples[r * n:r * n + n] for r in range(row, min(row + 16, n))]
        block = b"".join(struct.pack(f"<{n}f", *(p[axis] for p in line)) for line in lines for axis in (2, 1, 0))
        blocks.append(struct.pack("<2i", row, len(block)) + block)
    begins = itertools.accumulate(map(len, blocks[:-1]), initial=len(header) + 8 * len(blocks))
    return header + struct.pack(f"<{len(blocks)}Q", *begins) + b"".join(blocks)
