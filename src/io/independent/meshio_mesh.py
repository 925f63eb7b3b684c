"""Prints the bits of the points, then the vertices of all cells of a type, then integer arrays, those of
cells under a name that begins with "cell ". Arguments: the path, meshio's name of the type, arrays."""
import contextlib
import sys

with contextlib.redirect_stdout(sys.stderr):
    import meshio
    import numpy

    mesh = meshio.read(sys.argv[1])
print(numpy.ascontiguousarray(mesh.points, "<f8").view("<u8").ravel().tolist())
cells = [block.data.ravel() for block in mesh.cells if block.type == sys.argv[2]]
print(numpy.concatenate(cells).tolist())
for name in sys.argv[3:]:
    if name.startswith("cell "):
        values = numpy.concatenate(mesh.cell_data[name.removeprefix("cell ")])
    else:
        values = mesh.point_data[name]
    print(values.astype("i8").ravel().tolist())
