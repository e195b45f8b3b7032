# SPDX-License-Identifier: MIT
"""Bundle parts: docs/FORMAT.md, section 5."""
from coding import RangeCoder, require

STEP, START, HAS_TURNED, TURNED, SLOT, START_SKIP, TIP_GAP = 0, 1164, 1165, 1166, 1168, 1170, 1171


class Topology:
    """Loops of the regions that a bundle touches; vertices are numbered through."""

    def __init__(self, regions):
        self.ids = [region for region, _ in regions]
        self.slot, self.after, self.before, self.base = [], [], [], []
        for slot, (_, lengths) in enumerate(regions):
            self.base.append(len(self.slot))
            for length in lengths:
                first = len(self.slot)
                self.slot += [slot] * length
                self.after += [first + (i + 1) % length for i in range(length)]
                self.before += [first + (i - 1) % length for i in range(length)]
        self.base.append(len(self.slot))
        self.own = len(regions) - 1

    def count(self, slot):
        return self.base[slot + 1] - self.base[slot]

    def name(self, vertex):
        slot = self.slot[vertex]
        return self.ids[slot], vertex - self.base[slot]


class BundleReader:
    def __init__(self, data, topology, bank):
        self.topology, self.source = topology, RangeCoder(data, bank)
        self.triangles, self.turned = [], []
        self.gates, self.waiting = [], {}
        self.known, self.last = set(), {}
        self.next_own = 0
        self.has_turned, self.was_turned = False, 0

    def read(self, count):
        self.has_turned = self.source.symbol(HAS_TURNED) != 0
        while len(self.triangles) < count:
            corners = self.start()
            self.add(corners)
            for k in range(3):
                self.add_gate(corners[k], corners[(k + 1) % 3], ())
            while self.gates:
                self.cross(*self.gates.pop())
        require(len(self.triangles) == count, 'not the promised triangles')
        self.source.finish()

    def start(self):
        kind = self.source.symbol(START)
        if kind == 1:
            return [self.vertex(SLOT) for _ in range(3)]
        require(kind == 0, 'an unknown start')
        skip, topology = self.source.number(START_SKIP), self.topology
        while True:
            require(self.next_own < topology.count(topology.own), 'no such edge')
            v = topology.base[topology.own] + self.next_own
            self.next_own += 1
            if v in self.known:
                continue
            if skip == 0:
                return [topology.after[v], v, self.vertex(SLOT)]
            skip -= 1

    def vertex(self, model):
        below = self.source.number(model)
        slot = self.topology.own - below
        require(slot >= 0 and self.topology.count(slot) > 0, 'no such slot')
        base, count = self.topology.base[slot], self.topology.count(slot)
        if slot not in self.last:
            return base + self.source.choice(count)
        gap = self.source.number(TIP_GAP)
        distance = (gap + 1) // 2 if gap % 2 else -(gap // 2)
        return base + (self.last[slot] - base - distance) % count

    def add(self, corners):
        slots = [self.topology.slot[v] for v in corners]
        require(len(set(corners)) == 3 and self.topology.own in slots, 'an impossible triangle')
        turned = 0
        if self.has_turned:
            turned = self.was_turned = int(self.source.symbol(TURNED + self.was_turned) != 0)
        self.triangles.append(corners)
        self.turned.append(turned)
        for k in range(3):
            tail, head = corners[k], corners[(k + 1) % 3]
            self.last[self.topology.slot[tail]] = tail
            if self.topology.after[head] == tail:
                self.known.add(head)

    def add_gate(self, x, y, path):
        if self.topology.slot[x] == self.topology.slot[y]:
            return
        if self.waiting.get((y, x), 0):
            self.waiting[y, x] -= 1
            return
        self.waiting[x, y] = self.waiting.get((x, y), 0) + 1
        self.gates.append((x, y, path))

    def cross(self, x, y, path):
        if not self.waiting[x, y]:
            return
        self.waiting[x, y] -= 1
        topology = self.topology
        symbol = self.source.symbol(self.step_model(x, y, path))
        require(symbol < 4, 'an unknown step')
        if symbol == 2:
            return
        z = topology.before[x] if symbol == 0 else topology.after[y] if symbol == 1 else self.vertex(SLOT + 1)
        self.add([y, x, z])
        path = path + (symbol,) if symbol < 2 else ()
        self.add_gate(x, z, path)
        self.add_gate(z, y, path)

    def step_model(self, x, y, path):
        topology = self.topology
        own = 1 if topology.slot[x] == topology.own else 2 if topology.slot[y] == topology.own else 0
        runs = 0
        if path:
            lengths, at, side = [], len(path), path[-1]
            for _ in range(3):
                length = 0
                while at > 0 and path[at - 1] == side:
                    at, length = at - 1, length + 1
                lengths.append(length)
                side = 1 - side
            i, j, k = min(lengths[0], 4), min(lengths[1], 3), min(lengths[2], 2)
            runs = 1 + ((4 * path[-1] + i - 1) * 4 + j) * 3 + k
        a, b = topology.before[x] in self.known, y in self.known
        return STEP + ((runs * 2 + a) * 2 + b) * 3 + own


def read_bundle(data, regions, count, bank):
    """Triangles as ((region, boundary index) * 3, turned)."""
    topology = Topology(regions)
    reader = BundleReader(data, topology, bank)
    reader.read(count)
    return [([topology.name(v) for v in corners], turned)
            for corners, turned in zip(reader.triangles, reader.turned)]
