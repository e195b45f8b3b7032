# SPDX-License-Identifier: MIT
"""Connectivity of a region part: docs/FORMAT.md, section 4.1; and what it leaves: a corner table."""
from coding import require

CLERS, EXTRA_SYMBOLS, HANDLE_COUNT, HANDLE_GAP, HANDLE_REACH = 0, 789, 790, 791, 792
VIRTUAL_COUNT, VIRTUAL_GAP, IS_CLOSED = 793, 794, 795
C, L, E, R, S = range(5)


def following(corner):
    return corner - 2 if corner % 3 == 2 else corner + 1


def preceding(corner):
    return corner + 2 if corner % 3 == 0 else corner - 1


class CornerTable:
    def __init__(self):
        self.vertex, self.opposite = [], []

    def add(self, corners):
        self.vertex += corners
        self.opposite += [None] * 3
        return len(self.vertex) - 3

    def glue(self, a, b):
        require(self.opposite[a] is None and self.opposite[b] is None, 'three triangles at an edge')
        self.opposite[a], self.opposite[b] = b, a

    def counter_clockwise(self, corner):
        across = self.opposite[following(corner)]
        return None if across is None else following(across)

    def clockwise(self, corner):
        across = self.opposite[preceding(corner)]
        return None if across is None else preceding(across)


class Grower:
    """The machine that E, R, L, C and S drive."""

    def __init__(self):
        self.table, self.gates = CornerTable(), []
        self.corners = []  # by vertex, of the triangles grown around it

    def add(self, corners):
        tip = self.table.add(corners)
        for k, v in enumerate(corners):
            self.corners[v].append(tip + k)
        return tip

    def new_vertex(self):
        self.corners.append([])
        return len(self.corners) - 1

    def ends(self, gate):
        return self.table.vertex[following(gate)], self.table.vertex[preceding(gate)]

    def context(self):
        if not self.gates:
            return 0, 0
        return tuple(min(len(self.corners[v]) - 1, 9) for v in self.ends(self.gates[-1]))

    def grow(self, symbol, other_end):
        if symbol == E:
            self.gates.append(self.add([self.new_vertex() for _ in range(3)]))
            return
        require(self.gates, 'no gate to grow at')
        gate = self.gates.pop()
        tail, head = self.ends(gate)
        if symbol == R:
            tip = self.add([head, tail, self.new_vertex()])
            self.table.glue(preceding(tip), gate)
        elif symbol == L:
            tip = self.add([tail, self.new_vertex(), head])
            self.table.glue(following(tip), gate)
        elif symbol == C:
            edge = self.other_border_edge(gate)
            after = self.table.vertex[following(edge)]
            require(after != head, 'a border of two edges')
            tip = self.add([tail, after, head])
            self.table.glue(following(tip), gate)
            self.table.glue(preceding(tip), edge)
        else:
            tip = self.split(gate, other_end)
        self.gates.append(tip)

    def other_border_edge(self, gate):
        """Of the tail's fan; as the corner that faces it."""
        corner = following(gate)
        while self.table.counter_clockwise(corner) is not None:
            corner = self.table.counter_clockwise(corner)
        return following(corner)

    def split(self, gate, left):
        if left is None:
            require(self.gates, 'nothing to join with')
            left = self.gates.pop()
        tail, head = self.ends(gate)
        left_tail, left_head = self.ends(left)
        require(len({tail, head, left_tail, left_head}) == 4, 'edges with a vertex in common')
        kept, gone = tail, left_head
        if len(self.corners[left_head]) > len(self.corners[tail]):
            kept, gone = left_head, tail
        for corner in self.corners[gone]:
            self.table.vertex[corner] = kept
        self.corners[kept] += self.corners[gone]
        self.corners[gone] = []
        tip = self.add([kept, left_tail, head])
        self.table.glue(following(tip), gate)
        self.table.glue(preceding(tip), left)
        return tip

    def close(self, gate):
        u, v = self.ends(gate)
        at_u = self.other_border_edge(gate)
        w = self.table.vertex[following(at_u)]
        corner = preceding(gate)
        while self.table.clockwise(corner) is not None:
            corner = self.table.clockwise(corner)
        at_v = preceding(corner)
        require(self.table.vertex[preceding(at_v)] == w, 'a border of more than three edges')
        tip = self.add([w, v, u])
        self.table.glue(tip, gate)
        self.table.glue(following(tip), at_u)
        self.table.glue(preceding(tip), at_v)


def drop_virtual(table, virtual):
    """Triangles around virtual vertices go; the last that stay fill their places."""
    count = len(table.vertex) // 3
    stays = [not virtual.intersection(table.vertex[3 * t:3 * t + 3]) for t in range(count)]
    place = list(range(count))
    last = count - 1
    for t in range(count):
        if stays[t]:
            continue
        while last > t and not stays[last]:
            last -= 1
        if last <= t:
            break
        place[last] = t
        last -= 1
    kept = sorted((place[t], t) for t in range(count) if stays[t])
    dropped = CornerTable()
    for new, old in kept:
        require(new * 3 == len(dropped.vertex), 'a hole in front')
        dropped.add(table.vertex[3 * old:3 * old + 3])
    for new, old in kept:
        for k in range(3):
            across = table.opposite[3 * old + k]
            if across is not None and stays[across // 3]:
                dropped.opposite[3 * new + k] = 3 * place[across // 3] + across % 3
    return dropped


def read_connectivity(source, triangles):
    symbols = triangles + source.signed(EXTRA_SYMBOLS)
    handles, split = {}, 0
    for _ in range(source.number(HANDLE_COUNT)):
        split += source.number(HANDLE_GAP)
        reach = source.number(HANDLE_REACH)
        handles[split] = 3 * (split - 1 - reach) + (2 if source.bits(1) else 1)
    grower, previous = Grower(), E
    for triangle in range(symbols):
        tail, head = grower.context()
        previous = source.symbol(CLERS + (previous * 10 + tail) * 10 + head)
        require(previous < 5, 'an unknown symbol')
        grower.grow(previous, handles.get(triangle))
    for gate in list(grower.gates):
        if source.symbol(IS_CLOSED) == 1:
            grower.close(gate)
    virtual, vertex = set(), 0
    for _ in range(source.number(VIRTUAL_COUNT)):
        vertex += source.number(VIRTUAL_GAP)
        virtual.add(vertex)
    table = drop_virtual(grower.table, virtual)
    require(len(table.vertex) == 3 * triangles, 'not the promised triangles')
    return table
