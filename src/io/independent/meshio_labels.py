"""Prints the triangles with their labels, then the edges of segments with their markers, each as [vertices,
label], in order. Arguments: the path."""
import contextlib
import sys

with contextlib.redirect_stdout(sys.stderr):
    import meshio
    import numpy

    mesh = meshio.read(sys.argv[1])
ROWS = {"triangle": [], "line": []}


def add(kind, cells, labels):
    labels = numpy.ravel(labels).tolist()
    assert len(cells) == len(labels)
    ROWS[kind] += [[*cell, label] for cell, label in zip(cells.tolist(), labels)]


if sys.argv[1].endswith(".msh"):
    names = {(dim, tag): int(name.split("_")[1]) for name, (tag, dim) in mesh.field_data.items()}
    assert all(name.startswith(("marker_", "region_")) for name in mesh.field_data)
    for at, block in enumerate(mesh.cells):
        dim = 1 if block.type == "line" else 2
        groups = mesh.cell_data["gmsh:physical"][at]
        add(block.type, block.data, [names[dim, group] for group in groups])
        assert len(mesh.cell_data["domain"][at]) == len(block.data)
elif sys.argv[1].endswith(".mesh"):
    for block, labels in zip(mesh.cells, mesh.cell_data["medit:ref"]):
        add(block.type, block.data, labels)
else:
    assert [block.type for block in mesh.cells] == ["triangle"]
    add("triangle", mesh.cells[0].data, mesh.cell_data["region"][0])
    add("line", mesh.field_data["segments"].reshape(-1, 2), mesh.field_data["segment_markers"])
print(sorted(ROWS["triangle"]))
print(sorted(ROWS["line"]))
