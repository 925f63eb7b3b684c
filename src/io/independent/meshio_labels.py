"""Prints the simplices with their labels, in space the triangles of facets with their markers, then the edges of
segments with theirs, each as [vertices, label], in order. Arguments: the path."""
import contextlib
import sys

with contextlib.redirect_stdout(sys.stderr):
    import meshio
    import numpy

    mesh = meshio.read(sys.argv[1])
kinds = {block.type for block in mesh.cells}
ROWS = {kind: [] for kind in ("tetra", "triangle", "line") if kind != "tetra" or kind in kinds}
NAMES = ("marker_", "region_", "segment_") if "tetra" in kinds else ("marker_", "region_")


def add(kind, cells, labels):
    labels = numpy.ravel(labels).tolist()
    assert len(cells) == len(labels)
    ROWS[kind] += [[*cell, label] for cell, label in zip(cells.tolist(), labels)]


if sys.argv[1].endswith(".msh"):
    names = {(dim, tag): int(name.split("_")[1]) for name, (tag, dim) in mesh.field_data.items()}
    assert all(name.startswith(NAMES) for name in mesh.field_data)
    for at, block in enumerate(mesh.cells):
        dim = ["line", "triangle", "tetra"].index(block.type) + 1
        groups = mesh.cell_data["gmsh:physical"][at]
        add(block.type, block.data, [names[dim, group] for group in groups])
        assert len(mesh.cell_data["domain"][at]) == len(block.data)
elif sys.argv[1].endswith(".mesh"):
    for block, labels in zip(mesh.cells, mesh.cell_data["medit:ref"]):
        add(block.type, block.data, labels)
else:
    assert [block.type for block in mesh.cells] == list(ROWS)[:-1]
    add(mesh.cells[0].type, mesh.cells[0].data, mesh.cell_data["region"][0])
    if "tetra" in kinds:
        add("triangle", mesh.cells[1].data, mesh.cell_data["marker"][1])
        assert not mesh.cell_data["marker"][0].any() and not mesh.cell_data["region"][1].any()
    add("line", mesh.field_data["segments"].reshape(-1, 2), mesh.field_data["segment_markers"])
for rows in ROWS.values():
    print(sorted(rows))
