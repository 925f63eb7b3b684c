"""The same with VTK, whose readers are ParaView's."""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
assert reader.GetErrorCode() == 0
grid = reader.GetOutput()
assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} == {5}
labels = vtk_to_numpy(grid.GetCellData().GetArray("region")).tolist()
cells = [[grid.GetCell(i).GetPointId(k) for k in range(3)] for i in range(grid.GetNumberOfCells())]
print(sorted(cell + [label] for cell, label in zip(cells, labels)))
ends, markers = (vtk_to_numpy(grid.GetFieldData().GetArray(n)).tolist() for n in ("segments", "segment_markers"))
print(sorted(pair + [marker] for pair, marker in zip(ends, markers)))
