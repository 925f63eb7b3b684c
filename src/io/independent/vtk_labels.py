"""The same with VTK, whose readers are ParaView's."""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
assert reader.GetErrorCode() == 0
grid = reader.GetOutput()
types = [grid.GetCellType(i) for i in range(grid.GetNumberOfCells())]
assert sorted(types, reverse=True) == types
cells = [grid.GetCell(i) for i in range(len(types))]
cells = [[cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())] for cell in cells]


def show(kind, name):
    labels = vtk_to_numpy(grid.GetCellData().GetArray(name)).tolist()
    print(sorted(cell + [label] for cell, label, other in zip(cells, labels, types) if kind == other))


if 10 in types:
    show(10, "region")
    show(5, "marker")
else:
    assert set(types) == {5}
    show(5, "region")
ends, markers = (vtk_to_numpy(grid.GetFieldData().GetArray(n)).tolist() for n in ("segments", "segment_markers"))
print(sorted(pair + [marker] for pair, marker in zip(ends, markers)))
