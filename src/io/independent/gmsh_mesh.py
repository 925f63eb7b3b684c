"""The same with Gmsh, whose views hold the arrays. Arguments: the path, Gmsh's number of the type, arrays.
Where arrays are asked for, the physical group is looked at too."""
import sys

import gmsh
import numpy

gmsh.initialize(["gmsh", "-nopopup"], False, False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open(sys.argv[1])
tags, coordinates, _ = gmsh.model.mesh.getNodes()
order = numpy.argsort(tags)
assert (tags[order] == numpy.arange(1, len(tags) + 1)).all()
print(coordinates.reshape(-1, 3)[order].astype("<f8").view("<u8").ravel().tolist())
elements, vertices = gmsh.model.mesh.getElementsByType(int(sys.argv[2]))
print((vertices.astype("i8") - 1).tolist())
views = {gmsh.option.getString(f"View[{gmsh.view.getIndex(tag)}].Name"): tag for tag in gmsh.view.getTags()}
for name in sys.argv[3:]:
    on_cells = name.startswith("cell ")
    kind, ids, data, _, components = gmsh.view.getModelData(views[name.removeprefix("cell ")], 0)
    assert kind == ("ElementData" if on_cells else "NodeData") and components == 1
    assert (numpy.asarray(ids) == (elements if on_cells else tags[order])).all()
    print([int(value[0]) for value in data])
if len(sys.argv) > 3:
    (dim, tag), = gmsh.model.getPhysicalGroups()
    assert gmsh.model.getPhysicalName(dim, tag) == "mesh"
    assert gmsh.model.getEntitiesForPhysicalGroup(dim, tag).tolist() == [1]
gmsh.finalize()
