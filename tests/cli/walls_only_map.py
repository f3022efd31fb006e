#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a .bt as programs make it from a point cloud: the walls of a square room, occupied voxels only.

Usage: walls_only_map.py FILE
"""
import struct
import sys

RESOLUTION_M = 0.1
SIDE = 10
HEIGHT = 24
ZERO = 32768
DEPTH = 16


def occupied_keys():
    return {(ZERO + x, ZERO + y, ZERO + z) for x in range(SIDE) for y in range(SIDE) for z in range(HEIGHT)
            if x in (0, SIDE - 1) or y in (0, SIDE - 1)}


def child_index(key, depth):
    bit = DEPTH - 1 - depth
    return ((key[0] >> bit) & 1) | ((key[1] >> bit) & 1) << 1 | ((key[2] >> bit) & 1) << 2


def encode(keys, depth):
    """The records of a node, depth first, and how many nodes lie below it."""
    children = [set() for _ in range(8)]
    for key in keys:
        children[child_index(key, depth)].add(key)
    leaf = depth == DEPTH - 1
    record = sum(((2 if leaf else 3) << (2 * i)) for i in range(8) if children[i])
    data = struct.pack("<H", record)
    count = sum(1 for below in children if below)
    if not leaf:
        for below in children:
            if below:
                more, nodes = encode(below, depth + 1)
                data += more
                count += nodes
    return data, count


def main():
    data, count = encode(occupied_keys(), 0)
    header = (f"# Octomap OcTree binary file\n# by hand\n#\nid OcTree\nsize {count + 1}\n"
              f"res {RESOLUTION_M}\ndata\n")
    with open(sys.argv[1], "wb") as file:
        file.write(header.encode() + data)


if __name__ == "__main__":
    main()
