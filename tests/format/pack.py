# SPDX-License-Identifier: MIT
"""Packs and their directories: docs/FORMAT.md, sections 1 and 2."""
import hashlib

from coding import Bytes, require

REGIONS_A_PAGE = 256


class Record:
    def __init__(self, **fields):
        self.__dict__.update(fields)


def check_hash(data, expected):
    require(hashlib.sha256(data).digest()[:16] == expected, 'not the bytes that the hash is of')


def read_box(source):
    low = [source.varint() for _ in range(3)]
    return [(at, at + source.varint()) for at in low]


def read_grid(source):
    first = source.unpack('B')
    require(8 <= first & 127 <= 24, 'impossible bits')
    return Record(bits=first & 127, origin=[source.unpack('d') for _ in range(3)], step=source.unpack('d')), first >> 7


def read_levels(source):
    levels = []
    for i in range(source.varint()):
        size = source.varint()
        if size == 0:
            require(i > 0, 'nothing to repeat')
            levels.append(None)
            continue
        level = Record(size=size, vertices=source.varint(), triangles=source.varint(), hash=source.take(16), dropped=0)
        if i > 0:
            source.unpack('f')
            level.dropped = source.unpack('B')
        levels.append(level)
    return levels


def read_entry(source, region):
    entry = Record(box=read_box(source), loops=[source.varint() for _ in range(source.varint())])
    entry.levels = read_levels(source)
    entry.bundle = None
    size = source.varint()
    if size:
        triangles, lower, above = source.varint(), [], region
        for _ in range(source.varint()):
            above -= source.varint() + 1
            lower.insert(0, above)
        entry.bundle = Record(size=size, triangles=triangles, regions=lower + [region], hash=source.take(16))
    return entry


class Pack:
    """Entries of all regions, and their parts' bytes, hashes checked."""

    def __init__(self, data):
        header = Bytes(data[:64])
        require(header.take(8) == b'\x89SLV\r\n\x1a\n', 'no pack')
        require(header.unpack('H') == 1, 'an unknown version')
        header.unpack('H')
        summary_size, directory_size, size = header.unpack('I'), header.unpack('Q'), header.unpack('Q')
        identity = header.take(16)
        require(header.take(16) == bytes(16) and size == len(data), 'a malformed header')
        summary = data[64:64 + summary_size]
        check_hash(summary, identity)
        pages = self.read_summary(Bytes(summary))
        at = 64 + summary_size
        self.entries = []
        for page in pages:
            self.read_page(data[at:at + page.size], page.hash)
            at += page.size
        require(at == 64 + directory_size and len(self.entries) == self.regions, 'pages do not fill the directory')
        self.place_parts(data, at)

    def read_summary(self, source):
        self.name, self.units = source.string(), source.string()
        self.metadata = {source.string(): source.string() for _ in range(source.varint())}
        self.grid, self.is_exact = read_grid(source)
        for _ in range(6 + 3 + 1):
            source.varint()
        self.regions = source.varint()
        pages = []
        for _ in range(0, self.regions, REGIONS_A_PAGE):
            size, _ = source.varint(), source.varint()
            read_box(source)
            pages.append(Record(size=size, hash=source.take(16)))
        return pages  # names of parts may follow

    def read_page(self, data, page_hash):
        check_hash(data, page_hash)
        source = Bytes(data)
        for _ in range(min(REGIONS_A_PAGE, self.regions - len(self.entries))):
            self.entries.append(read_entry(source, len(self.entries)))
        require(source.at_end(), 'bytes left over in a page')

    def place_parts(self, data, at):
        for entry in self.entries:
            for part in [level for level in reversed(entry.levels) if level] + [entry.bundle] * bool(entry.bundle):
                part.data = data[at:at + part.size]
                check_hash(part.data, part.hash)
                at += part.size
        require(at == len(data), 'parts do not fill the file')
