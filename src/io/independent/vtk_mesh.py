"""The same with VTK, whose readers are ParaView's. Arguments: the path, VTK's number of the type, arrays."""
import sys

import vtk
from vtk.util.numpy_support import vtk_to_numpy

path = sys.argv[1]
planar = path.endswith(".ply")
reader = vtk.vtkPLYReader() if planar else vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
assert reader.GetErrorCode() == 0
grid = reader.GetOutput()
corners = []
for i in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(i)
    if cell.GetCellType() == int(sys.argv[2]):
        corners += [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
points = vtk_to_numpy(grid.GetPoints().GetData())
# VTK's reader of PLY rounds coordinates to floats.
print(points.astype("<f4").view("<u4").ravel().tolist() if planar else points.astype("<f8").view("<u8").ravel().tolist())
print(corners)
for name in sys.argv[3:]:
    data = grid.GetCellData() if name.startswith("cell ") else grid.GetPointData()
    array = data.GetArray(name.removeprefix("cell "))
    print(vtk_to_numpy(array).astype("i8").ravel().tolist())
