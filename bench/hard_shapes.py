"""Shapes that one square samples badly, as (points, triangles): a lattice of struts, a needle, a helix."""
import math


def swept_tube(centres, frames, radii, around):
    """A tube along a curve, closed by a point at each end. frames: of each centre, two directions across."""
    points, triangles = [], []
    for (x, y, z), (u, v), radius in zip(centres, frames, radii):
        for k in range(around):
            c, s = radius * math.cos(2 * math.pi * k / around), radius * math.sin(2 * math.pi * k / around)
            points.append((x + c * u[0] + s * v[0], y + c * u[1] + s * v[1], z + c * u[2] + s * v[2]))
    for ring in range(len(centres) - 1):
        for k in range(around):
            a, b = ring * around + k, ring * around + (k + 1) % around
            triangles += [(a, b, b + around), (a, b + around, a + around)]
    last = (len(centres) - 1) * around
    points += [centres[0], centres[-1]]
    for k in range(around):
        after = (k + 1) % around
        triangles += [(after, k, len(points) - 2), (last + k, last + after, len(points) - 1)]
    return points, triangles


def helix(turns=50, around=12, rings_a_turn=100, rise=0.1, radius=0.5, thickness=0.02):
    """A round wire that winds about the y axis."""
    rings = turns * rings_a_turn
    centres, frames = [], []
    for i in range(rings + 1):
        angle = 2 * math.pi * i / rings_a_turn
        c, s = math.cos(angle), math.sin(angle)
        length = math.hypot(2 * math.pi * radius, rise)
        along = 2 * math.pi * radius / length, rise / length  # around the axis, up it
        centres.append((radius * c, rise * i / rings_a_turn, radius * s))
        frames.append(((c, 0, s), (s * along[1], along[0], -c * along[1])))
    return swept_tube(centres, frames, [thickness] * len(centres), around)


def needle(length=1.0, slimness=1e5, around=8, rings=400):
    """A straight wire, so many times longer than wide."""
    centres = [(length * i / rings, 0, 0) for i in range(rings + 1)]
    frames = [((0, 1, 0), (0, 0, 1))] * len(centres)
    return swept_tube(centres, frames, [0.5 * length / slimness] * len(centres), around)


def lattice(nodes=6, cells=5):
    """Square struts, `cells` long and one wide, between nodes ** 3 nodes: 3 nodes^2 (nodes - 1) - nodes^3 + 1 handles,
    325 of 6 nodes a side. The surface of unit cubes."""
    period, width = cells + 1, (nodes - 1) * (cells + 1) + 1
    filled = {(x, y, z) for x in range(width) for y in range(width) for z in range(width)
              if sum(c % period != 0 for c in (x, y, z)) <= 1}
    number, points, triangles = {}, [], []

    def vertex(place):
        if place not in number:
            number[place] = len(points)
            points.append(tuple(c / width for c in place))
        return number[place]

    for cube in sorted(filled):
        for axis in range(3):
            for side in (0, 1):
                if tuple(c + (2 * side - 1) * (a == axis) for a, c in enumerate(cube)) in filled:
                    continue
                one, other = ((axis + 1) % 3, (axis + 2) % 3)[::2 * side - 1]
                corners = []
                for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    place = list(cube)
                    place[axis] += side
                    place[one] += i
                    place[other] += j
                    corners.append(vertex(tuple(place)))
                triangles += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
    return points, triangles
