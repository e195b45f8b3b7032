# SPDX-License-Identifier: MIT
"""Order and positions of a region part's vertices: docs/FORMAT.md, sections 4.2, 4.3 and 4.6."""
import struct
from collections import deque

from coding import require
from connectivity import following, preceding

MAGNITUDE, EXCESS, SHAPE, TREND, TANGENT = 500, 788, 796, 797, 798


def f32(value):
    return struct.unpack('<f', struct.pack('<f', value))[0]


def float_bits(value):
    return struct.unpack('<I', struct.pack('<f', value))[0]


def log_bits(value):
    return float_bits(f32(value + 0.25)) - float_bits(0.25)


def from_log(bits):
    return f32(f32(bits) * 2.0 ** -20)


def int_log_of(x):
    o = x.bit_length() - 1
    return 8 * o + ((8 * x >> o) & 7)


def int_log(value):
    return int_log_of(4 * value + 1)


def add(u, v):
    return [f32(a + b) for a, b in zip(u, v)]


def sub(u, v):
    return [f32(a - b) for a, b in zip(u, v)]


def scale(u, s):
    return [f32(a * s) for a in u]


def cross(u, v):
    return [f32(f32(u[i - 2] * v[i - 1]) - f32(u[i - 1] * v[i - 2])) for i in range(3)]


def size_of(u):
    return f32(f32(abs(u[0]) + abs(u[2])) + abs(u[1]))


def rounded(value):
    return int(f32(value + (0.5 if value >= 0 else -0.5)))


class Walk:
    """Visits vertices in order; each visit gives its fan."""

    def __init__(self, table):
        self.table = table
        self.number = {}  # of vertices visited, by the table's own number
        self.offers = {}
        self.queues = deque(), deque()

    def __iter__(self):
        lowest = 0
        while True:
            corner = self.next_offered()
            if corner is None:
                while lowest < len(self.table.vertex) and self.table.vertex[lowest] in self.number:
                    lowest += 1
                if lowest == len(self.table.vertex):
                    return
                corner = lowest
            fan, is_open = self.fan_of(corner)
            yield self.table.vertex[corner], fan, is_open
            self.visit(self.table.vertex[corner], fan)

    def next_offered(self):
        for queue in self.queues:
            while queue:
                corner = queue.popleft()
                if self.table.vertex[corner] not in self.number:
                    return corner
        return None

    def fan_of(self, corner):
        first = corner
        while True:
            before = self.table.clockwise(first)
            if before is None or before == corner:
                break
            first = before
        is_open = before is None
        if not is_open:
            first = corner
        fan, corner = [first], self.table.counter_clockwise(first)
        while corner is not None and corner != first:
            fan.append(corner)
            corner = self.table.counter_clockwise(corner)
        return fan, is_open

    def visit(self, vertex, fan):
        self.number[vertex] = len(self.number)
        for corner in reversed(fan if len(fan) <= 62 else fan[:61]):
            ends = following(corner), preceding(corner)
            known = [self.table.vertex[end] in self.number for end in ends]
            if known[0] == known[1]:
                continue
            offered = ends[0] if known[1] else ends[1]
            other = self.table.vertex[offered]
            count = self.offers[other] = self.offers.get(other, 0) + 1
            if count <= 2:
                self.queues[2 - count].append(offered)


class Surroundings:
    """What is known around a vertex before its position."""

    def __init__(self, coder, vertex, fan, is_open):
        table, placed = coder.table, coder.placed
        triangles = fan if len(fan) <= 62 else fan[:61]
        ring = ([table.vertex[following(fan[0])]] if is_open or len(fan) > 62 else [])
        ring += [table.vertex[preceding(corner)] for corner in triangles]
        if not is_open and len(fan) <= 62:
            ring = [table.vertex[following(corner)] for corner in triangles]
        known = [placed[v] for v in reversed(ring) if v in placed]
        self.has_neighbours = bool(known)
        if not known:
            return
        inverse = f32(1 / len(known))
        sums = [sum(k.position[a] for k in known) for a in range(3)]
        mean_of_neighbours = scale([f32(s) for s in sums], inverse)
        trend = [0.0] * 3
        normal_error = 0.0
        for k in known:
            trend = add(trend, k.error)
            normal_error = f32(normal_error + k.normal)
        trend = scale(trend, inverse)
        tangent_error = f32(f32(sum(k.tangential for k in known)) * inverse)
        normal_error = f32(normal_error * inverse)
        tips, edges, normals = [], [], []
        for corner in reversed(triangles):
            a, b = table.vertex[following(corner)], table.vertex[preceding(corner)]
            across = table.opposite[corner]
            o = table.vertex[across] if across is not None else None
            if not (a in placed and b in placed and o in placed):
                continue
            pa, pb, po = (placed[v].position for v in (a, b, o))
            tips.append([pa[i] + pb[i] - po[i] for i in range(3)])
            edges.append([pa[i] + pb[i] for i in range(3)])
            normals.append(cross([float(pb[i] - pa[i]) for i in range(3)], [float(po[i] - pa[i]) for i in range(3)]))
        n = self.parallelograms = len(tips)
        spread = reach = 0.0
        self.beyond = self.ring = self.trend = [0.0] * 3
        self.mean, self.axis, self.slopes, self.shape = mean_of_neighbours, 2, (0.0, 0.0), 0
        if n:
            inverse = f32(1 / n)
            point = scale([f32(sum(t[i] for t in tips)) for i in range(3)], inverse)
            edge = scale([f32(sum(e[i] for e in edges)) for i in range(3)], f32(0.5 * inverse))
            self.mean, self.trend = point, trend
            self.beyond, self.ring = sub(point, edge), sub(mean_of_neighbours, edge)
            spread = size_of(sub([float(t) for t in tips[-1]], point))
            reach = size_of(self.beyond)
            normal = [0.0] * 3
            for one in normals:
                normal = add(normal, one)
            x, y, z = map(abs, normal)
            self.axis = 0 if x >= y and x > z else 1 if y >= z else 2
            d = self.axis
            r = f32(-1 / normal[d]) if normal[d] else 0.0
            self.slopes = f32(normal[(d + 1) % 3] * r), f32(normal[(d + 2) % 3] * r)
            self.shape = ((min(n, 4) - 1) * 8 + max(3, min(10, len(fan))) - 3) * 2 + is_open
        self.logs = [from_log(log_bits(x)) for x in (tangent_error, normal_error, spread, reach)]


class Placed:
    def __init__(self, position, tangential=0, normal=0.0, error=(0.0, 0.0, 0.0)):
        self.position, self.tangential, self.normal, self.error = position, tangential, normal, error


class PositionCoder:
    def __init__(self, source, table, box, tables):
        self.source, self.table, self.box, self.tables = source, table, box, tables
        self.placed = {}
        longest = max(high - low for low, high in box)
        triangles = len(table.vertex) // 3
        start = int_log_of((4 * longest >> triangles.bit_length() // 2) + 1) << 20
        self.recent = [start, start]

    def read(self):
        self.blends = [self.source.symbol(model) for model in (SHAPE, TREND, TANGENT)]
        require(max(self.blends) <= 7 and self.blends[2] <= 4, 'impossible blends')
        walk = Walk(self.table)
        for vertex, fan, is_open in walk:
            around = Surroundings(self, vertex, fan, is_open)
            if around.has_neighbours:
                self.placed[vertex] = self.position(around)
            else:
                self.placed[vertex] = Placed(read_offset(self.source, self.box))
        order = sorted(walk.number, key=walk.number.get)
        self.table.vertex = [walk.number[v] for v in self.table.vertex]
        return [self.placed[v].position for v in order]

    def expected(self, around, axis):
        w = self.tables.size[min(around.parallelograms, 3)][axis]
        total = f32(64 * w[6])
        for weight, recent in zip(w[4:6], self.recent):
            total = f32(total + f32(weight * from_log(recent)))
        parts = [f32(weight * value) for weight, value in zip(w, around.logs)]
        total = f32(total + f32(parts[0] + parts[1]))
        return int(f32(total + f32(parts[2] + parts[3]))), w

    def coarse(self, around, axis, first, second):
        """The symbol's magnitude, the low bits that it lacks, and its log."""
        expected, w = self.expected(around, axis)
        expected += (w[7] * first if axis > 0 else 0) + (w[8] * second if axis > 1 else 0)
        size = max(0, min(183, expected >> 8))
        low_bits = max(0, size // 8 - 4)
        model = MAGNITUDE + (axis * 2 + (around.parallelograms >= 2)) * 48 + size // 4
        symbol = self.source.symbol(model)
        magnitude = symbol + (self.source.number(EXCESS) if symbol == 15 else 0)
        return magnitude, low_bits, int_log(symbol) + 8 * low_bits

    def signed(self, coarse, low_bits):
        if coarse == 0 and low_bits == 0:
            return 0
        negative = self.source.bits(1)
        magnitude = coarse << low_bits | self.source.bits(low_bits)
        return -magnitude if negative else magnitude

    def position(self, around):
        first = self.coarse(around, 0, 0, 0)
        second = self.coarse(around, 1, first[2], 0)
        third = self.coarse(around, 2, first[2], second[2])
        u, w, v = (self.signed(*one[:2]) for one in (first, second, third))
        shape, trend, tangent = self.blends
        weights = [f32(weight * blend) * 2.0 ** -12
                   for weight, blend in zip(self.tables.shape[around.shape], (shape, shape, trend))]
        position = []
        for i in range(3):
            predicted = around.mean[i]
            for part, weight in zip((around.beyond, around.ring, around.trend), weights):
                predicted = f32(predicted + f32(part[i] * weight))
            position.append(rounded(predicted))
        d = around.axis
        lean = f32(f32(around.slopes[0] * f32(u)) + f32(around.slopes[1] * f32(w)))
        position[(d + 1) % 3] += u
        position[(d + 2) % 3] += w
        position[d] += v + int(f32(lean * f32(tangent / 4)))
        for value, (low, high) in zip(position, self.box):
            require(low <= value <= high, 'a position outside the box')
        sizes = float(min(abs(u) + abs(w), 1 << 24)), float(min(abs(v), 1 << 24))
        self.recent = [r + ((log_bits(size) - r) >> 4) for r, size in zip(self.recent, sizes)]
        error = [0.0] * 3
        if around.parallelograms:
            error = sub([float(p) for p in position], around.mean)
        return Placed(position, min(abs(u) + abs(w), 1 << 24), f32(min(abs(v), 1 << 24)), error)


def read_offset(source, box):
    position = []
    for low, high in box:
        position.append(low + source.bits((high - low).bit_length()))
        require(position[-1] <= high, 'a position outside the box')
    return position


def boundary_loops(table):
    """Lists of vertices, each from its lowest."""
    after = {}
    for corner, across in enumerate(table.opposite):
        if across is None:
            after[table.vertex[following(corner)]] = table.vertex[preceding(corner)]
    loops = []
    while after:
        vertex = start = min(after)
        loop = []
        while True:
            loop.append(vertex)
            vertex = after.pop(vertex)
            if vertex == start:
                break
        loops.append(loop)
    return loops
