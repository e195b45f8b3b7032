# SPDX-License-Identifier: MIT
"""Positions as places in lists of values: docs/FORMAT.md, section 4.8."""
import bisect
import math
import struct

from coding import require
from connectivity import following, preceding
from geometry import Walk

DIGITS, PLACES = 805, 806
LIST_COUNT, LIST_GAP, LIST_FLOAT_GAP, LIST_SIGNS, LIST_PICK, LIST_STEP = 820, 821, 822, 823, 847, 863
MIX, ALL = 0x9E3779B97F4A7C15, (1 << 64) - 1


def read_ascending(source, gap_model):
    numbers, lowest = [], 0
    for _ in range(source.number(LIST_COUNT)):
        numbers.append(lowest + source.number(gap_model))
        require(numbers[-1] < 1 << 31, 'too large a number')
        lowest = numbers[-1] + 1
    return numbers


def read_float_magnitudes(source, decimal_value):
    digits, magnitudes = source.symbol(DIGITS), []
    require(digits <= 9, 'too many digits')
    if digits:
        places = source.symbol(PLACES)
        magnitudes = [decimal_value(rank, digits, places) for rank in read_ascending(source, LIST_GAP)]
    for bits in read_ascending(source, LIST_FLOAT_GAP):
        magnitudes.append(struct.unpack('<f', struct.pack('<I', bits))[0])
    require(all(math.isfinite(x) for x in magnitudes), 'no finite float')
    return sorted(magnitudes)


def read_lists(source, magnitudes):
    negative, positive, before = ([], [], []), ([], [], []), 0
    for magnitude in magnitudes:
        x = source.symbol(LIST_SIGNS + before)
        y = source.symbol(LIST_SIGNS + 4 + 4 * x + before)
        z = source.symbol(LIST_SIGNS + 20 + 2 * (x > 0) + (y > 0))
        before = 1 if x else 2 if y else 3
        for axis, signs in enumerate((x, y, z)):
            require(signs <= 3, 'unknown signs')
            if signs & 2:
                negative[axis].append(-magnitude)
            if signs & 1:
                positive[axis].append(magnitude)
    return [below[::-1] + above for below, above in zip(negative, positive)]


class PlaceReader:
    def __init__(self, source, table, lists, vertices):
        self.source, self.table, self.lists = source, table, lists
        self.shift = 64 - min(vertices.bit_length() + 1, 18)
        self.places, self.memory = [], {}

    def read(self):
        """Places of all vertices, in their order."""
        walk = Walk(self.table)
        for _, fan, is_open in walk:
            neighbours, parallelograms = self.surroundings(walk, fan, is_open)
            self.places.append([self.place(axis, neighbours, parallelograms) for axis in range(3)])
        self.table.vertex = [walk.number[v] for v in self.table.vertex]
        return self.places

    def surroundings(self, walk, fan, is_open):
        table = self.table
        triangles = fan if len(fan) <= 62 else fan[:61]
        corners = [following(c) for c in triangles]
        if is_open or len(fan) > 62:
            corners.append(preceding(triangles[-1]))
        known = [walk.number.get(table.vertex[c]) for c in corners]
        neighbours = [v for v in reversed(known) if v is not None][:16]
        parallelograms = []
        for corner in reversed(triangles):
            begin, end = (walk.number.get(table.vertex[c]) for c in (following(corner), preceding(corner)))
            across = table.opposite[corner]
            tip = None if across is None else walk.number.get(table.vertex[across])
            if None not in (begin, end, tip):
                parallelograms.append((begin, end, tip))
        return neighbours, parallelograms[:8]

    def nearest(self, values, x):
        above = bisect.bisect_left(values, x)
        if above == 0:
            return 0
        is_below = above == len(values) or x - values[above - 1] <= values[above] - x
        return above - is_below

    def place(self, axis, neighbours, parallelograms):
        values = self.lists[axis]
        if not neighbours:
            return self.source.uniform(len(values))
        near = [self.places[v][axis] for v in neighbours]
        a, b, o, shape, pattern, expected = near[0], 0, 0, 2, 5, near[0]
        candidates = []
        if parallelograms:
            corners = [[self.places[v][axis] for v in p] for p in parallelograms]
            total = 0.0
            for begin, end, tip in corners:
                total += values[begin] + values[end] - values[tip]
            expected, shape = self.nearest(values, total / len(corners)), 0
            a, b, o = corners[0]
            pattern = (0 if a == o else 1) if a == b else 2 if a == o else 3 if b == o else 4
            candidates = [a, b, o]
        elif len(near) > 1:
            b, shape, pattern = near[1], 1, 7 if near[0] == near[1] else 6
        key = 0
        for part in (a, b, o, 4 * axis + shape):
            key = (key * MIX + part) & ALL
        key = key * MIX & ALL
        check, remembered = self.memory.get(key >> self.shift, (0, None))
        is_known = remembered is not None and check == key & 0xffffffff and remembered < len(values)
        candidates = [remembered] * is_known + [expected] + candidates + near
        candidates = list(dict.fromkeys(candidates))[:15]
        symbol = self.source.symbol(LIST_PICK + 2 * pattern + is_known)
        if symbol < 15:
            require(symbol < len(candidates), 'no such candidate')
            found = candidates[symbol]
        else:
            folded = self.source.number(LIST_STEP + (shape == 0)) + 1
            found = expected + (-(folded + 1 >> 1) if folded & 1 else folded >> 1)
            require(0 <= found < len(values), 'no such place')
        self.memory[key >> self.shift] = key & 0xffffffff, found
        return found
