"""Files of points for the tests, in the current directory."""

import numpy

random = numpy.random.default_rng(1)
space = random.random((1500, 3))
space[100:130] = space[:30]
plane = random.random((1500, 2)).astype("f4")
for dim, points in (2, plane), (3, space):
    numpy.save(f"in{dim}.npy", points)
    numpy.savetxt(f"in{dim}.xyz", points.astype("f8"), fmt="%.17g", header="points")
plane[3, 1] = numpy.nan
numpy.save("nan.npy", plane)
with open("bad.xyz", "w") as file:
    file.write("# two columns\n" + "1 2\n\n3 4\n" * 400 + "5 x\n" + "6 7\n" * 50)
with open("empty.xyz", "w") as file:
    file.write("# nothing\n\n" * 100)
