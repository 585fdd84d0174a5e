"""Meshes of several pieces of which some are long: strips, a robot of boxes and tubes, a belt with texture coordinates. As
(points, triangles), or with texture coordinates of the corners as a third."""
import math

import hard_shapes


def joined(parts):
    points, triangles = [], []
    for own, faces in parts:
        triangles += [tuple(len(points) + v for v in face) for face in faces]
        points += own
    return points, triangles


def moved(shape, by):
    points, triangles = shape
    return [tuple(p + d for p, d in zip(point, by)) for point in points], triangles


def grid(rows, cols, place):
    """The surface place(v, u), v and u in 0 .. 1, of rows x cols quads."""
    points = [place(i / rows, j / cols) for i in range(rows + 1) for j in range(cols + 1)]
    triangles = []
    for i in range(rows):
        for j in range(cols):
            a = i * (cols + 1) + j
            triangles += [(a, a + 1, a + cols + 2), (a, a + cols + 2, a + cols + 1)]
    return points, triangles


def ball(radius=1.0, rows=24, cols=48):
    rings = [(-radius * math.cos(math.pi * i / rows), radius * math.sin(math.pi * i / rows)) for i in range(1, rows)]
    return hard_shapes.swept_tube([(0, y, 0) for y, _ in rings], [((0, 0, 1), (1, 0, 0))] * len(rings), [r for _, r in rings],
                                  cols)


def strip(length=4.0, slimness=70, waves=12, height=0.05):
    """A ribbon that waves along its length."""
    return grid(2, 20 * waves, lambda v, u: (length * (u - 0.5), height * math.sin(2 * math.pi * waves * u),
                                             (0.5 - v) * length / slimness))


def box(size, cuts=4):
    """Six sides of cuts x cuts quads each, closed."""
    number, points, triangles = {}, [], []

    def vertex(place):
        if place not in number:
            number[place] = len(points)
            points.append(tuple(s * (c / cuts - 0.5) for s, c in zip(size, place)))
        return number[place]

    for axis in range(3):
        for side in (0, cuts):
            for i in range(cuts):
                for j in range(cuts):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        place = [0, 0, 0]
                        place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, a, b
                        corners.append(vertex(tuple(place)))
                    if side == 0:
                        corners.reverse()
                    triangles += [tuple(corners[:3]), (corners[0], corners[2], corners[3])]
    return points, triangles


def rod(length, radius, around=16, rings=24):
    """A round bar along x, closed."""
    centres = [(length * (i / rings - 0.5), 0, 0) for i in range(rings + 1)]
    return hard_shapes.swept_tube(centres, [((0, 1, 0), (0, 0, 1))] * len(centres), [radius] * len(centres), around)


def strips():
    """A ball and three ribbons."""
    return joined([ball()] + [moved(strip(), (0, 1.5 + 0.4 * k, 0)) for k in range(3)])


def robot():
    """Thirty pieces: plates, rods and balls."""
    parts = [box((0.6, 0.8, 0.4))]
    for k in range(9):
        at = (1.2 * math.cos(k), 0.5 * k, 1.2 * math.sin(k))
        parts += [moved(rod(0.9 + 0.1 * k, 0.03 + 0.003 * k), at), moved(ball(0.12, 10, 20), (at[0], at[1] + 0.2, at[2]))]
    for k in range(11):
        parts.append(moved(box((0.08 + 0.2 * (k % 3), 0.05, 1.2 + 0.1 * k)), (-2 - 0.5 * k, 0, 0)))
    return joined(parts)


def belt(length=10.0, width=0.2, thickness=0.05, around=240):
    """A closed band about the y axis, of four sides: each is an island of the texture, opened where the band begins."""
    inner = length / (2 * math.pi)
    outer, low, high = inner + thickness, 0, width
    section = [(outer, low), (outer, high), (inner, high), (inner, low)]
    points, triangles, corners = [], [], []
    for side, (radius, y) in enumerate(section):
        angles = [2 * math.pi * j / around for j in range(around)]
        points += [(radius * math.cos(a), y, -radius * math.sin(a)) for a in angles]
        after = (side + 1) % 4
        across = math.dist(section[side], section[after]) / length

        def uv(j, v):
            return j / around, 0.1 * side + v * across

        for j in range(around):
            a, b = side * around + j, side * around + (j + 1) % around
            c, d = after * around + (j + 1) % around, after * around + j
            triangles += [(a, b, c), (a, c, d)]
            corners += [[uv(j, 0), uv(j + 1, 0), uv(j + 1, 1)], [uv(j, 0), uv(j + 1, 1), uv(j, 1)]]
    return points, triangles, corners
