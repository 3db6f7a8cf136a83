#!/usr/bin/env python3
"""Say by rational arithmetic whether pixels of a packed scene are lit: a check of `gnomon truth` that shares no code.

    tests/report/truth_pixel.py SCENE.gno X Y [X Y ...]

Every triangle is tried, with Python's fractions and nothing else. For each pixel a line: x, y, mask value, and what is
in the way: how many triangles, and how far from the point the nearest of them is, in millionths of the scene's diagonal.
"""
import struct
import sys
from fractions import Fraction


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class Scene:
    def __init__(self, path):
        data = open(path, "rb").read()
        if data[:4] != b"GNOM" or struct.unpack_from("<I", data, 4)[0] != 4:
            sys.exit(path + ": expected a .gno file of version 4")
        self.width, self.height = struct.unpack_from("<HH", data, 16)
        camera = struct.unpack_from("<B3x12iIiii", data, 56)
        self.orthographic = camera[0] == 1
        self.eye, self.right, self.up, self.forward = (list(camera[1 + 3 * i:4 + 3 * i]) for i in range(4))
        self.tangent, self.half_height, self.near, self.far = camera[13:17]
        light = struct.unpack_from("<B3x9i6i3iIii", data, 124)
        self.spot = light[0] == 1
        self.light_right, self.light_up, self.light_forward = (list(light[1 + 3 * i:4 + 3 * i]) for i in range(3))
        self.position = list(light[16:19])
        self.light_tangent, self.light_near, self.light_far = light[19:22]
        self.read_triangles(data)

    def read_triangles(self, data):
        meshes, objects = struct.unpack_from("<II", data, 212)
        at, parts = 220, []
        for _ in range(meshes):
            vertices, triangles, size, edges = struct.unpack_from("<IIB3xI", data, at)
            at += 16
            numbers = struct.unpack_from("<%di" % (3 * vertices), data, at)
            at += 12 * vertices
            indices = struct.unpack_from("<%d%s" % (3 * triangles, "H" if size == 2 else "I"), data, at)
            at += (3 * triangles * size + 3) // 4 * 4 + 8 * edges
            points = [list(numbers[3 * i:3 * i + 3]) for i in range(vertices)]
            parts.append([[points[i] for i in indices[3 * t:3 * t + 3]] for t in range(triangles)])
        self.triangles = []
        for _ in range(objects):
            self.triangles += parts[struct.unpack_from("<I", data, at)[0]]
            at += 8
        self.normals = [cross(sub(t[1], t[0]), sub(t[2], t[0])) for t in self.triangles]
        corners = [v for t in self.triangles for v in t]
        self.diagonal = sum((max(v[k] for v in corners) - min(v[k] for v in corners)) ** 2 for k in range(3)) ** 0.5

    def eye_line(self, i, j):
        """Origin and direction, as integers over a common divisor."""
        x, y, height = 2 * i + 1 - self.width, self.height - 2 * j - 1, self.height
        if self.orthographic:
            origin = [height * (1 << 30) * e + self.half_height * (x * r + y * u)
                      for e, r, u in zip(self.eye, self.right, self.up)]
            return origin, height << 30, self.forward
        return self.eye, 1, [(height << 24) * f + self.tangent * (x * r + y * u)
                             for f, r, u in zip(self.forward, self.right, self.up)]

    def hits(self, origin, divisor, direction):
        """(number, s) of all triangles that the line (origin + s direction) / divisor meets, edges included."""
        for number, (t, normal) in enumerate(zip(self.triangles, self.normals)):
            slope = dot(normal, direction)
            if slope == 0:
                continue
            a = [[divisor * c - o for c, o in zip(v, origin)] for v in t]
            first = dot(direction, cross(a[0], sub(t[1], t[0])))
            second = dot(direction, cross(a[1], sub(t[2], t[1])))
            if (first < 0 < second) or (second < 0 < first):
                continue
            third = dot(direction, cross(a[2], sub(t[0], t[2])))
            if min(first, second, third) >= 0 or max(first, second, third) <= 0:
                yield number, Fraction(dot(normal, a[0]), slope)

    def answer(self, i, j):
        origin, divisor, direction = self.eye_line(i, j)
        seen = None
        for number, s in self.hits(origin, divisor, direction):
            point = [(o + s * d) / divisor for o, d in zip(origin, direction)]
            w = dot(self.forward, sub(point, self.eye)) / (1 << 30)
            if self.near <= w <= self.far and (seen is None or s < seen[1]):
                seen = number, s, point
        if seen is None:
            return 255, []
        number, _, point = seen
        corner, normal = self.triangles[number][0], self.normals[number]
        to_camera = [-f for f in self.forward] if self.orthographic else sub(self.eye, corner)
        to_light = sub(self.position, corner) if self.spot else [-f for f in self.light_forward]
        if dot(normal, to_camera) * dot(normal, to_light) <= 0:
            return 0, []
        if self.spot:
            v = sub(point, self.position)
            w = dot(self.light_forward, v)
            across = max(abs(dot(self.light_right, v)), abs(dot(self.light_up, v)))
            if not self.light_near << 30 <= w <= self.light_far << 30 or across * (1 << 24) > self.light_tangent * w:
                return 0, []
        return self.passage(number, point)

    def passage(self, number, point):
        divisor = point[0].denominator * point[1].denominator * point[2].denominator
        origin = [int(p * divisor) for p in point]
        way = [-f for f in self.light_forward]
        if self.spot:
            way = [divisor * p - o for p, o in zip(self.position, origin)]
        length = dot(way, way) ** 0.5 / divisor
        blocked = []
        for other, s in self.hits(origin, divisor, way):
            if other == number or s <= 0:
                continue
            if self.spot:
                place = [(o + s * d) / divisor for o, d in zip(origin, way)]
                if dot(self.light_forward, sub(place, self.position)) < self.light_near << 30:
                    continue
                if s >= 1:
                    continue
            blocked.append(float(s) * length / self.diagonal * 1e6)
        return (0 if blocked else 254), blocked


def main():
    if len(sys.argv) < 4 or len(sys.argv) % 2:
        sys.exit(__doc__)
    scene = Scene(sys.argv[1])
    numbers = [int(n) for n in sys.argv[2:]]
    for i, j in zip(numbers[::2], numbers[1::2]):
        mask, blocked = scene.answer(i, j)
        print(i, j, mask, len(blocked), "%.3f" % min(blocked) if blocked else "-", flush=True)


main()
