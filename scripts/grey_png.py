#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a picture as an 8-bit grey PNG, which is what 'occusg segment' reads.

Usage: grey_png.py IN.png OUT.png. IN is an 8-bit PNG, grey or RGB, with or without alpha, not interlaced. Colours are
weighted as in ITU-R BT.601; alpha is dropped.
"""
import struct
import sys
import zlib
from pathlib import Path

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by colour type: grey, RGB, grey and alpha, RGB and alpha


def chunks(data):
    """Type and content of each chunk."""
    at = len(SIGNATURE)
    while at + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + length]
        at += 12 + length


def paeth(left, up, corner):
    estimate = left + up - corner
    distances = abs(estimate - left), abs(estimate - up), abs(estimate - corner)
    if distances[0] <= distances[1] and distances[0] <= distances[2]:
        return left
    return up if distances[1] <= distances[2] else corner


def unfiltered(raw, height, stride, step):
    """The rows of a decompressed PNG without their filters (PNG specification, 9.2)."""
    rows = []
    previous = bytearray(stride)
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride if kind else 0):
            left = row[x - step] if x >= step else 0
            corner = previous[x - step] if x >= step else 0
            up = previous[x]
            row[x] = (row[x] + (0, left, up, (left + up) // 2, paeth(left, up, corner))[kind]) & 255
        rows.append(row)
        previous = row
    return rows


def grey(row, channels):
    if channels < 3:
        return bytes(row[::channels])
    return bytes((299 * r + 587 * g + 114 * b + 500) // 1000
                 for r, g, b in zip(row[::channels], row[1::channels], row[2::channels]))


def converted(data):
    if not data.startswith(SIGNATURE):
        raise ValueError("is not a PNG")
    parts = list(chunks(data))
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
    if depth != 8 or kind not in CHANNELS or interlaced:
        raise ValueError("is not an 8-bit grey or RGB PNG without interlacing")
    channels = CHANNELS[kind]
    raw = zlib.decompress(b"".join(content for name, content in parts if name == b"IDAT"))
    rows = unfiltered(raw, height, width * channels, channels)
    pixels = zlib.compress(b"".join(b"\0" + grey(row, channels) for row in rows))
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return SIGNATURE + b"".join(
        struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
        for name, content in ((b"IHDR", header), (b"IDAT", pixels), (b"IEND", b"")))


def main():
    if len(sys.argv) != 3:
        print("usage: grey_png.py IN.png OUT.png", file=sys.stderr)
        return 2
    try:
        Path(sys.argv[2]).write_bytes(converted(Path(sys.argv[1]).read_bytes()))
    except (OSError, ValueError, struct.error, zlib.error) as error:
        print(f"{sys.argv[1]}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
