"""Prints the shape and the bits of an array. Argument: the path."""
import sys

import numpy

points = numpy.load(sys.argv[1], allow_pickle=False)
assert points.dtype == numpy.dtype("<f8") and points.flags.c_contiguous
print(list(points.shape))
print(points.view("<u8").ravel().tolist())
