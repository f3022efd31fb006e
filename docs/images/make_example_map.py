#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the maps that the drawings of docs/decomposition.md show: flat.pgm and booths.pgm, 0.05 m a pixel.

Usage: make_example_map.py FOLDER
"""
import sys
from pathlib import Path

CELLS_PER_METRE = 20
FREE, OCCUPIED, UNKNOWN = 254, 0, 205
WALL_M = 0.15


class Plan:
    """A picture drawn in metres, y up."""

    def __init__(self, width_m, height_m):
        self.width = round(width_m * CELLS_PER_METRE)
        self.height = round(height_m * CELLS_PER_METRE)
        self.rows = [bytearray([UNKNOWN]) * self.width for _ in range(self.height)]

    def fill(self, x0, y0, x1, y1, value):
        for y in range(round(y0 * CELLS_PER_METRE), round(y1 * CELLS_PER_METRE)):
            for x in range(round(x0 * CELLS_PER_METRE), round(x1 * CELLS_PER_METRE)):
                self.rows[self.height - 1 - y][x] = value

    def room(self, x0, y0, x1, y1):
        """Floor with walls round it."""
        self.fill(x0 - WALL_M, y0 - WALL_M, x1 + WALL_M, y1 + WALL_M, OCCUPIED)
        self.fill(x0, y0, x1, y1, FREE)

    def write(self, path):
        header = f"P5\n{self.width} {self.height}\n255\n".encode("ascii")
        path.write_bytes(header + b"".join(bytes(row) for row in self.rows))


def flat():
    """A corridor with two rooms above, a bedroom, a living room and an open kitchen below, and tables."""
    plan = Plan(13.0, 8.6)
    plan.room(0.5, 0.5, 12.5, 8.1)
    for y in (3.55, 5.0):
        plan.fill(0.5, y, 12.5, y + 0.15, OCCUPIED)
    plan.fill(6.0, 5.0, 6.15, 8.1, OCCUPIED)
    plan.fill(4.0, 0.5, 4.15, 3.7, OCCUPIED)
    plan.fill(9.3, 0.5, 9.45, 1.1, OCCUPIED)
    plan.fill(9.3, 2.7, 9.45, 3.7, OCCUPIED)
    for x, y in ((2.0, 5.0), (10.0, 5.0), (1.5, 3.55), (6.0, 3.55)):
        plan.fill(x, y, x + 0.9, y + 0.15, FREE)
    plan.fill(6.3, 1.6, 7.5, 2.5, OCCUPIED)
    plan.fill(10.2, 6.5, 11.4, 7.3, OCCUPIED)
    return plan


def booths():
    """A hall whose side walls make booths that are open over most of their width, and one real room."""
    plan = Plan(13.0, 7.5)
    plan.room(0.5, 0.5, 12.5, 7.0)
    for x in (2.7, 5.0, 7.3):
        plan.fill(x, 4.9, x + 0.15, 7.0, OCCUPIED)
    plan.fill(9.4, 0.5, 9.55, 7.0, OCCUPIED)
    plan.fill(9.4, 3.0, 9.55, 3.9, FREE)
    plan.fill(5.0, 0.5, 5.15, 1.7, OCCUPIED)
    return plan


def main():
    if len(sys.argv) != 2:
        print("usage: make_example_map.py FOLDER", file=sys.stderr)
        return 2
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    flat().write(folder / "flat.pgm")
    booths().write(folder / "booths.pgm")
    return 0


if __name__ == "__main__":
    sys.exit(main())
