"""The same with VTK, whose readers are ParaView's. Arguments: the path, VTK's number of the type, arrays."""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

path = sys.argv[1]
is_ply = path.endswith(".ply")
reader = vtkPLYReader() if is_ply else vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
assert reader.GetErrorCode() == 0
grid = reader.GetOutput()
vertices = []
for i in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(i)
    if cell.GetCellType() == int(sys.argv[2]):
        vertices += [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
points = vtk_to_numpy(grid.GetPoints().GetData())
# VTK's reader of PLY rounds coordinates to floats.
kind, bits = ("<f4", "<u4") if is_ply else ("<f8", "<u8")
print(points.astype(kind).view(bits).ravel().tolist())
print(vertices)
for name in sys.argv[3:]:
    data = grid.GetCellData() if name.startswith("cell ") else grid.GetPointData()
    array = data.GetArray(name.removeprefix("cell "))
    print(vtk_to_numpy(array).astype("i8").ravel().tolist())
