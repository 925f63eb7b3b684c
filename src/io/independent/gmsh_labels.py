"""The same with Gmsh, whose physical groups are the labels: by their names, and where these are positive by
their numbers."""
import sys

import gmsh

gmsh.initialize(["gmsh", "-nopopup"], False, False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open(sys.argv[1])
top = max(dim for dim, _ in gmsh.model.getPhysicalGroups())
names = {2: {1: "marker", 2: "region"}, 3: {1: "segment", 2: "marker", 3: "region"}}[top]
rows = {dim: [] for dim in names}


def add(dim, entity, label):
    kinds, _, vertices = gmsh.model.mesh.getElements(dim, entity)
    assert list(kinds) == [{1: 1, 2: 2, 3: 4}[dim]]
    ids = [int(vertex) - 1 for vertex in vertices[0]]
    rows[dim] += [ids[at : at + dim + 1] + [label] for at in range(0, len(ids), dim + 1)]


for dim, tag in gmsh.model.getPhysicalGroups():
    kind, label = gmsh.model.getPhysicalName(dim, tag).split("_")
    assert kind == names[dim] and (int(label) == tag or int(label) <= 0)
    for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag):
        add(dim, entity, int(label))
for dim in range(top, 0, -1):
    assert sum(map(len, gmsh.model.mesh.getElements(dim)[1])) == len(rows[dim])
    print(sorted(rows[dim]))
gmsh.finalize()
