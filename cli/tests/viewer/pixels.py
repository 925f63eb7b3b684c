"""Counts the colours of a screenshot: pixels.py FILE.png WIDTH, of the columns left of WIDTH.

Prints a line `COUNT #rrggbb` for each colour, the most frequent first.
"""

import struct
import sys
import zlib
from collections import Counter


def unfiltered(data, height, stride, size):
    """Undo the filters of PNG (8 bits a channel, `size` channels, not interlaced), row by row."""
    before = bytearray(stride)
    for row in range(height):
        start = row * (stride + 1)
        kind, line = data[start], bytearray(data[start + 1:start + 1 + stride])
        for at in range(stride if kind else 0):
            left = line[at - size] if at >= size else 0
            up, corner = before[at], before[at - size] if at >= size else 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            else:
                errors = [abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)]
                guess = (left, up, corner)[errors.index(min(errors))]
            line[at] = (line[at] + guess) & 255
        yield line
        before = line


def main(path, width):
    content = open(path, "rb").read()
    packed, at = b"", 8
    while at < len(content):
        length, kind = struct.unpack(">I4s", content[at:at + 8])
        body = content[at + 8:at + 8 + length]
        if kind == b"IHDR":
            columns, rows, depth, colours = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += length + 12
    assert depth == 8 and colours in (2, 6) and columns >= width, (columns, rows, depth, colours)
    size = 3 if colours == 2 else 4
    counts = Counter()
    for line in unfiltered(zlib.decompress(packed), rows, columns * size, size):
        counts.update(bytes(line[at:at + 3]) for at in range(0, width * size, size))
    for colour, count in counts.most_common():
        print(count, "#" + colour.hex())


main(sys.argv[1], int(sys.argv[2]))
