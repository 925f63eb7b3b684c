"""Triangle as a peer, through the PyPI module `triangle`, with its published method (off-centres).

refine_with_triangle.py triangle 2 BOUND MEMORY_MIB INPUT OUTPUT: the points in a box of three times their
bounding box, every triangle of circumradius / shortest edge at most BOUND; formats as in main.cpp.
"""

import math
import resource
import sys
import time

import numpy
import triangle


def main():
    _, _, _, bound, memory_mib, source, target = sys.argv
    most = int(memory_mib) << 20
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    points = numpy.fromfile(source, dtype="<f8").reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    side = high - low
    (x0, y0), (x1, y1) = low - side, high + side
    box = numpy.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    angle = math.degrees(math.asin(0.5 / float(bound)))
    domain = {
        "vertices": numpy.concatenate([box, points]),
        "segments": numpy.array([[0, 1], [1, 2], [2, 3], [3, 0]]),
    }
    begun = time.perf_counter()
    mesh = triangle.triangulate(domain, f"pq{angle:.1f}")
    seconds = time.perf_counter() - begun
    with open(target, "wb") as file:
        numpy.array([seconds], dtype="<f8").tofile(file)
        for array, kind in ((mesh["vertices"], "<f8"), (mesh["triangles"], "<u4")):
            numpy.array([len(array)], dtype="<u8").tofile(file)
            numpy.ascontiguousarray(array).astype(kind).tofile(file)


main()
