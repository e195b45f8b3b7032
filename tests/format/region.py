# SPDX-License-Identifier: MIT
"""Region parts: docs/FORMAT.md, section 4."""
import math
import struct

from coding import Rans, require
from connectivity import CornerTable, read_connectivity
from geometry import PositionCoder, boundary_loops, f32, read_offset
from lists import PlaceReader, read_ascending, read_float_magnitudes, read_lists, LIST_GAP

IS_LISTED = 819
TURNED, ANCHOR_COUNT, ANCHOR_GAP, GROUP_STEP, LOOSE_COUNT = 799, 801, 802, 803, 804
DIGITS, PLACES, EXACT, EXACT_NEW = 805, 806, 807, 811
MAP_LOOP, MAP_LEAD, MAP_RUN, MAP_EXCESS = 815, 816, 817, 818
LARGEST_FLOAT = struct.unpack('<f', b'\xff\xff\x7f\x7f')[0]


def float_rank(value):
    bits = float_bits(value)
    return bits ^ 0xffffffff if bits >> 31 else bits | 1 << 31


def bits_of_rank(rank):
    return rank ^ 1 << 31 if rank >> 31 else rank ^ 0xffffffff


def float_bits(value):
    return struct.unpack('<I', struct.pack('<f', value))[0]


def decimal_value(rank, digits, places):
    """As a double."""
    end, e, k = 10 ** digits, places, abs(rank)
    while k >= end:
        e, k = e - 1, k - (end - end // 10)
    value = k / 10.0 ** e if e >= 0 else k * 10.0 ** -e
    return -value if rank < 0 else value


class FloatReader:
    """The floats behind grid points, as their bits: section 4.4."""

    def __init__(self, source, origin, step):
        self.source, self.origin, self.step = source, origin, step
        self.digits = source.symbol(DIGITS)
        require(self.digits <= 9, 'too many digits')
        self.places = source.symbol(PLACES) if self.digits else 0
        self.seen, self.last = [{}, {}, {}], [0, 0, 0]

    def read(self, axis, coordinate):
        seen = self.seen[axis]
        symbol = self.source.symbol((EXACT if coordinate in seen else EXACT_NEW) + self.last[axis])
        self.last[axis] = symbol
        low = self.origin[axis] + (coordinate - 0.5) * self.step
        high = self.origin[axis] + (coordinate + 0.5) * self.step
        if symbol == 0:
            require(coordinate in seen, 'nothing seen')
        elif symbol == 1:
            require(self.digits, 'no decimals')
            first, last = self.decimal_rank(low), self.decimal_rank(high)
            seen[coordinate] = self.decimal_bits(first + self.source.uniform(last - first + 1))
        elif symbol == 2:
            first, last = (float_rank(f32(max(-LARGEST_FLOAT, min(LARGEST_FLOAT, x)))) for x in (low, high))
            seen[coordinate] = bits_of_rank(first - 2 + self.source.uniform(last - first + 5))
        else:
            require(symbol == 3, 'an unknown symbol')
            seen[coordinate] = self.source.bits(32)
        require(seen[coordinate] >> 23 & 255 != 255, 'no finite float')
        return seen[coordinate]

    def scaled(self, x, e):
        return math.floor((x * 10.0 ** e if e >= 0 else x / 10.0 ** -e) + 0.5)

    def decimal_rank(self, x):
        end, e = 10 ** self.digits, self.places
        k = self.scaled(abs(x), e)
        while k >= end and e > -22:
            e -= 1
            k = self.scaled(abs(x), e)
        rank = (self.places - e) * (end - end // 10) + min(k, end - 1)
        return -rank if x < 0 else rank

    def decimal_bits(self, rank):
        return float_bits(decimal_value(rank, self.digits, self.places))


def read_boundary_map(source, finest_lengths, loops):
    vertices, expected = [], 0
    require(len(loops) == len(finest_lengths), 'not as many loops')
    taken = set()
    for length in finest_lengths:
        number = expected + source.signed(MAP_LOOP)
        require(0 <= number < len(loops) and number not in taken, 'no such loop')
        taken.add(number)
        expected = number + 1
        loop, mapped, index = loops[number], [None] * length, source.number(MAP_LEAD)
        at = source.bits((len(loop) - 1).bit_length())
        require(index < length and at < len(loop), 'outside the loop')
        left = length
        for i in range(len(loop)):
            run = left
            if i + 1 < len(loop):
                run = source.symbol(MAP_RUN) + 1
                if run == 16:
                    run += source.number(MAP_EXCESS)
            require(0 < run <= left, 'a run too long')
            left -= run
            for _ in range(run):
                mapped[index] = loop[(at + i) % len(loop)]
                index = (index + 1) % length
        vertices += mapped
    return vertices


def read_anchors(source, boundary, vertices):
    order = boundary + [v for v in range(vertices) if v not in set(boundary)]
    count, place, group, anchors = source.number(ANCHOR_COUNT), 0, 0, []
    require(count > 0, 'no anchors')
    for _ in range(count):
        place += source.number(ANCHOR_GAP)
        group = (group + source.signed(GROUP_STEP)) & 0xffffffff
        require(place < len(order), 'no such vertex')
        anchors.append((order[place], group))
        place, group = place + 1, group + 1
    return anchors


class Region:
    pass


def read_listed_positions(source, table, box, vertices, grid, region):
    """Section 4.8; `grid` is that of a bit-exact model, else None."""
    if grid is None:
        magnitudes = read_ascending(source, LIST_GAP)
    else:
        rounded = lambda rank, digits, places: f32(decimal_value(rank, digits, places))
        magnitudes = read_float_magnitudes(source, rounded)
    lists = read_lists(source, magnitudes)
    require(all(lists) and sum(map(len, lists)) <= 3 * vertices, 'no values, or too many')
    places = PlaceReader(source, table, lists, vertices).read()
    values = [[lists[axis][p[axis]] for axis in range(3)] for p in places]
    if grid is None:
        region.positions = values
    else:
        region.floats = [[float_bits(x) for x in p] for p in values]
        last = (1 << grid.bits) - 1
        steps = [[math.floor((p[a] - grid.origin[a]) / grid.step + 0.5) for a in range(3)] for p in values]
        region.positions = [[max(0, min(last, x)) for x in p] for p in steps]
    for p in region.positions:
        require(all(low <= x <= high for x, (low, high) in zip(p, box)), 'outside the box')


def read_region(data, entry, level, grid, is_exact, tables):
    """entry, level: as pack.py reads them."""
    flags, number = data[0], entry.levels.index(level)
    require(flags & 15 == 1, 'an unknown version')
    require(flags >> 7 == (number > 0) and flags >> 6 & 1 == (is_exact and number == 0), 'other flags')
    source = Rans(data[1:], tables.region)
    box = [(low >> level.dropped, high >> level.dropped) for low, high in entry.box]
    region = Region()
    region.floats = None
    if level.triangles:
        table = read_connectivity(source, level.triangles)
        way = source.symbol(IS_LISTED)
        require(way <= 1, 'an unknown way')
        if way:
            read_listed_positions(source, table, box, level.vertices, grid if flags >> 6 & 1 else None, region)
        else:
            region.positions = PositionCoder(source, table, box, tables).read()
        loops = boundary_loops(table)
    else:
        table = CornerTable()
        require(source.number(LOOSE_COUNT) == level.vertices, 'not the promised vertices')
        region.positions = [read_offset(source, box) for _ in range(level.vertices)]
        loops = [list(range(level.vertices))]
    require(len(region.positions) == level.vertices, 'not the promised vertices')
    region.triangles = [table.vertex[c:c + 3] for c in range(0, len(table.vertex), 3)]
    own_boundary = [v for loop in loops for v in loop]
    region.boundary = own_boundary
    if flags >> 6 & 1 and region.floats is None:
        floats = FloatReader(source, grid.origin, grid.step)
        region.floats = [[floats.read(axis, p[axis]) for axis in range(3)] for p in region.positions]
    if number > 0:
        region.boundary = read_boundary_map(source, entry.loops, loops)
        middle = (1 << level.dropped) >> 1
        region.positions = [[(x << level.dropped) + middle for x in p] for p in region.positions]
    else:
        require([len(loop) for loop in loops] == entry.loops, 'other loops')
    region.turned, before = [0] * level.triangles, 0
    if flags >> 4 & 1:
        for t in range(level.triangles):
            region.turned[t] = before = int(source.symbol(TURNED + before) != 0)
    region.anchors = read_anchors(source, own_boundary, level.vertices) if flags >> 5 & 1 else []
    source.finish()
    return region
