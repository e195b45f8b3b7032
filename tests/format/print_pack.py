# SPDX-License-Identifier: MIT
"""print_pack.py TRAINED_TABLES PACK...: decodes every part of packs and prints what it holds, as print_pack.cpp does.

Written from docs/FORMAT.md alone, to show that it suffices.
"""
import sys

from bundle import read_bundle
from coding import Tables
from pack import Pack
from region import read_region


def print_region(region, name):
    print(name)
    for corners, turned in zip(region.triangles, region.turned):
        print('t', *corners, turned)
    for v, position in enumerate(region.positions):
        print('v', *position, *(region.floats[v] if region.floats else []))
    print('b', *region.boundary)
    for anchor in region.anchors:
        print('a', *anchor)


def main(tables_path, *paths):
    tables = Tables(tables_path)
    for path in paths:
        with open(path, 'rb') as file:
            pack = Pack(file.read())
        for number, entry in enumerate(pack.entries):
            for i, level in enumerate(entry.levels):
                if level:
                    region = read_region(level.data, entry, level, pack.grid, pack.is_exact, tables)
                    print_region(region, f'region {number} level {i}')
            if entry.bundle:
                loops = [(i, pack.entries[i].loops) for i in entry.bundle.regions]
                print(f'bundle {number}')
                for corners, turned in read_bundle(entry.bundle.data, loops, entry.bundle.triangles, tables.bundle):
                    print('t', *(x for corner in corners for x in corner), turned)


if __name__ == '__main__':
    main(*sys.argv[1:])
