"""Writes points as arrays of each kind that numpy saves. Arguments: a directory, the points as JSON."""
import json
import sys

import numpy
from numpy.lib import format

points = numpy.array(json.loads(sys.argv[2]))
for version in [(1, 0), (2, 0), (3, 0)]:
    for dtype in ["<f8", ">f8", "<f4", ">f4"]:
        for order in "CF":
            name = f"{sys.argv[1]}/{version[0]}{'big' if dtype[0] == '>' else 'little'}{dtype[1:]}{order}.npy"
            with open(name, "wb") as file:
                format.write_array(file, numpy.asarray(points, dtype, order=order), version)
