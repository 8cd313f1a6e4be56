#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""usage: normal_kinds.py FOLDER

Writes the meshes of the pictures in docs/concepts/normals.md into FOLDER, as OBJ without normals: grid (surface nets of a
noisy field), scan (noisy points of a part with sharp edges), bevel (a box with narrow bevels), cad (a disc with a fillet whose
flat sides are fans around one vertex), decimated (an eighth of the triangles of a smooth grid) and turned (a torus with
some triangles of the wrong winding).
"""
import heapq
import os
import sys


class Random:
    """Random numbers that are equal on every machine."""

    def __init__(self):
        self.state = 1

    def unit(self):
        self.state = (self.state * 1664525 + 1013904223) % 2**32
        return self.state / 2**32

    def normal(self):
        return sum(self.unit() for _ in range(12)) - 6


def length(p):
    return sum(x * x for x in p) ** 0.5


def box(p, half):
    q = [abs(x) - h for x, h in zip(p, half)]
    return length([max(x, 0) for x in q]) + min(max(q), 0)


def blend(a, b, width):
    h = max(width - abs(a - b), 0) / width
    return min(a, b) - h * h * width / 4


def blob(p):
    a = length([p[0] - 0.3, p[1] - 0.15, p[2]]) - 0.45
    b = length([p[0] + 0.35, p[1] - 0.2, p[2] - 0.1]) - 0.36
    c = length([p[0], p[1] + 0.4, p[2] + 0.2]) - 0.4
    return blend(blend(a, b, 0.25), c, 0.3)


def part(p):
    hole = 0.28 - (p[0] * p[0] + p[1] * p[1]) ** 0.5
    return max(box(p, [0.6, 0.45, 0.3]), hole, -box([p[0] - 0.6, p[1], p[2] - 0.3], [0.25, 0.6, 0.15]))


def nets(distance, cells, noise):
    """Returns surface nets of a field in the cube from -1 to 1, with noise on the field, in cells."""
    random, step = Random(), 2 / cells
    side = cells + 1
    values = {}
    for z in range(side):
        for y in range(side):
            for x in range(side):
                at = distance([-1 + step * x, -1 + step * y, -1 + step * z])
                values[x, y, z] = at + (noise * step * random.normal() if noise and abs(at) < 4 * step else 0)
    points, numbers, faces = [], {}, []
    corners = [(i & 1, i >> 1 & 1, i >> 2) for i in range(8)]
    edges = [(a, b) for a in corners for b in corners if a < b and sum(x != y for x, y in zip(a, b)) == 1]
    for z in range(cells):
        for y in range(cells):
            for x in range(cells):
                crossings = []
                for a, b in edges:
                    at_a, at_b = (values[x + c[0], y + c[1], z + c[2]] for c in (a, b))
                    if (at_a < 0) != (at_b < 0):
                        t = at_a / (at_a - at_b)
                        crossings.append([p + t * (q - p) for p, q in zip(a, b)])
                if crossings:
                    mean = [sum(c[k] for c in crossings) / len(crossings) for k in range(3)]
                    numbers[x, y, z] = len(points)
                    points.append([-1 + step * (o + m) for o, m in zip((x, y, z), mean)])
    for (x, y, z), at in values.items():
        for axis in range(3):
            end = tuple(v + (k == axis) for k, v in enumerate((x, y, z)))
            if end not in values or (at < 0) == (values[end] < 0):
                continue
            u, v = ([int(k == (axis + i) % 3) for k in range(3)] for i in (1, 2))
            around = [tuple(o - i * a - j * b for o, a, b in zip((x, y, z), u, v)) for i, j in ((1, 1), (0, 1), (0, 0), (1, 0))]
            quad = [numbers[cell] for cell in around]
            faces.append(quad if at < 0 else quad[::-1])
    return points, faces


def scan(distance, cells, noise):
    """Returns surface nets whose points are projected onto the surface and then moved randomly; noise in cells."""
    random, step = Random(), 2 / cells
    points, faces = nets(distance, cells, 0)
    for p in points:
        for _ in range(2):
            small = 1e-4
            slope = [(distance([x + small * (k == axis) for k, x in enumerate(p)]) - distance(p)) / small for axis in range(3)]
            at, size = distance(p), max(length(slope), 0.1)
            p[:] = [x - at * s / size / size for x, s in zip(p, slope)]
        p[:] = [x + noise * step * random.normal() for x in p]
    return points, faces


def bevelled_box():
    """Returns the faces of a box with one row of quads along each edge, and triangles at the corners."""
    half, width = (0.8, 0.5, 0.6), 0.06
    points, numbers, faces = [], {}, []
    signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for s in signs:
        for axis in range(3):
            numbers[s, axis] = len(points)
            points.append([s[k] * (half[k] - (0 if k == axis else width)) for k in range(3)])

    def add(face):
        a, b, c = (points[i] for i in face[:3])
        e, f = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        across = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]]
        middle = [sum(points[i][k] for i in face) for k in range(3)]
        faces.append(face if sum(x * y for x, y in zip(across, middle)) > 0 else face[::-1])

    for s in signs:
        add([numbers[s, axis] for axis in range(3)])
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            if s[u] < 0 and s[v] < 0:
                ring = [tuple({axis: s[axis], u: a, v: b}[k] for k in range(3)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                add([numbers[corner, axis] for corner in ring])
            if s[axis] < 0:
                end = tuple(-x if k == axis else x for k, x in enumerate(s))
                add([numbers[s, u], numbers[end, u], numbers[end, v], numbers[s, v]])
    return points, faces


def circle(i, count):
    """Returns a point of the unit circle from the tangent of the half angle in each quadrant: sines differ between machines."""
    quarter, t = divmod(4 * i, count)
    t = t / count * (1 + 0.05 * (1 - t / count))
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    return [(c, s), (-s, c), (-c, -s), (s, -c)][quarter]


def filleted_disc():
    """Returns a disc as CAD kernels write it: flat sides are fans around one vertex of the rim."""
    sides, segments, fillet, half = 32, 2, 0.1, 0.25
    profile = []
    for side in (-1, 1):
        for i in range(segments + 1):
            c, s = circle(segments - i if side < 0 else i, 4 * segments)
            profile.append((0.9 - fillet + fillet * c, side * (half - fillet + fillet * s)))
    points = [[r * circle(i, sides)[0], z, -r * circle(i, sides)[1]] for r, z in profile for i in range(sides)]
    faces = []
    for ring in range(len(profile) - 1):
        for i in range(sides):
            a, b, above = ring * sides + i, ring * sides + (i + 1) % sides, sides
            faces += [[a, b, b + above], [a, b + above, a + above]]
    top = (len(profile) - 1) * sides
    for i in range(1, sides - 1):
        faces += [[0, i + 1, i], [top, top + i, top + i + 1]]
    return points, faces


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


class Simplifier:
    """Collapses edges to one of their ends, least error first (Garland and Heckbert 1997)."""

    def __init__(self, points, quads):
        self.points = points
        self.faces = [face for q in quads for face in ([q[0], q[1], q[2]], [q[0], q[2], q[3]])]
        self.around = [set() for _ in points]
        self.errors = [[0] * 10 for _ in points]
        for number, face in enumerate(self.faces):
            a = self.area(face)
            size = length(a) or 1
            plane = [x / size for x in a]
            plane.append(-sum(x * y for x, y in zip(plane, points[face[0]])))
            products = [size * plane[i] * plane[j] for i in range(4) for j in range(i, 4)]
            for v in face:
                self.around[v].add(number)
                self.errors[v] = [x + y for x, y in zip(self.errors[v], products)]

    def area(self, face):
        a, b, c = (self.points[v] for v in face)
        return cross(minus(b, a), minus(c, a))

    def cost(self, a, b):
        """Returns the error of moving vertex a to b."""
        p = [*self.points[b], 1]
        products = [p[i] * p[j] * (1 if i == j else 2) for i in range(4) for j in range(i, 4)]
        return sum((x + y) * z for x, y, z in zip(self.errors[a], self.errors[b], products))

    def may_move(self, a, b):
        shared = {v for f in self.around[a] for v in self.faces[f]} & {v for f in self.around[b] for v in self.faces[f]}
        if len(shared) != 4:
            return False
        for number in self.around[a] - self.around[b]:
            before, after = self.area(self.faces[number]), self.area([b if v == a else v for v in self.faces[number]])
            if sum(x * y for x, y in zip(before, after)) <= 0.2 * length(before) * length(after):
                return False
        return True

    def run(self, wanted):
        left = len(self.faces)
        heap = [(self.cost(a, b), a, b) for f in self.faces for a, b in zip(f, f[1:] + f[:1])]
        heap += [(self.cost(b, a), b, a) for _, a, b in heap]
        heapq.heapify(heap)
        while left > wanted and heap:
            cost, a, b = heapq.heappop(heap)
            if not self.around[a] & self.around[b] or cost != self.cost(a, b) or not self.may_move(a, b):
                continue
            for number in self.around[a]:
                if number in self.around[b]:
                    left -= 1
                    for v in self.faces[number]:
                        if v != a:
                            self.around[v].discard(number)
                    self.faces[number] = []
                else:
                    self.faces[number] = [b if v == a else v for v in self.faces[number]]
                    self.around[b].add(number)
            self.around[a] = set()
            self.errors[b] = [x + y for x, y in zip(self.errors[a], self.errors[b])]
            for v in sorted({v for f in self.around[b] for v in self.faces[f]} - {b}):
                heapq.heappush(heap, (self.cost(v, b), v, b))
                heapq.heappush(heap, (self.cost(b, v), b, v))
        return self.points, [face for face in self.faces if face]


def decimated(points, quads, share):
    return Simplifier(points, quads).run(2 * share * len(quads))


def turned_torus():
    """Returns a torus in which the triangles of some spots have the wrong winding."""
    columns, rows = 64, 28
    points, faces = [], []
    for i in range(columns):
        for j in range(rows):
            (c, s), (d, e) = circle(i, columns), circle(j, rows)
            points.append([(0.65 + 0.3 * d) * c, 0.3 * e, -(0.65 + 0.3 * d) * s])
    for i in range(columns):
        for j in range(rows):
            a, b = i * rows + j, i * rows + (j + 1) % rows
            c, d = (i + 1) % columns * rows + j, (i + 1) % columns * rows + (j + 1) % rows
            for face in ([a, c, d], [a, d, b]):
                middle = [sum(points[k][axis] for k in face) / 3 for axis in range(3)]
                spots = ((0.2, 0.25, 0.65), (-0.6, 0.25, -0.1), (0.75, 0.2, -0.2), (0.6, 0.2, 0.5))
                is_wrong = any(length([x - y for x, y in zip(middle, spot)]) < 0.22 for spot in spots)
                faces.append(face[::-1] if is_wrong else face)
    return points, faces


def write(path, mesh):
    points, faces = mesh
    with open(path, "w", encoding="utf-8") as file:
        file.writelines("v " + " ".join(f"{x:.5f}" for x in point) + "\n" for point in points)
        file.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def main():
    folder = sys.argv[1]
    write(os.path.join(folder, "grid.obj"), nets(blob, 40, 0.2))
    write(os.path.join(folder, "scan.obj"), scan(part, 48, 0.1))
    write(os.path.join(folder, "bevel.obj"), bevelled_box())
    write(os.path.join(folder, "cad.obj"), filleted_disc())
    write(os.path.join(folder, "decimated.obj"), decimated(*nets(blob, 36, 0), 0.125))
    write(os.path.join(folder, "turned.obj"), turned_torus())


main()
