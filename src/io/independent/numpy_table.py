"""Prints the bits of columns by name, of a structured array or of text with a header. Arguments: the path,
names."""
import sys

import numpy

path = sys.argv[1]
if path.endswith(".npy"):
    table = numpy.load(path, allow_pickle=False)
else:
    table = numpy.genfromtxt(path, delimiter=",", names=True)
for name in sys.argv[2:]:
    print(numpy.ascontiguousarray(table[name], "<f8").view("<u8").ravel().tolist())
