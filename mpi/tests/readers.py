"""Reads what ranks have written with what others wrote: VTK, meshio and NumPy.

    readers.py INPUT.npy NAME        (NAME.pvtu, NAME.points.npy, NAME.simplices.npy)
"""

import sys
import xml.etree.ElementTree as xml

import numpy

GHOST = 1


def arrays_of(piece):
    """The arrays of a piece by name, as VTK reads them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(piece)
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetPointData().GetGlobalIds().GetName() == "GlobalNodeId"
    assert grid.GetCellData().GetGlobalIds().GetName() == "GlobalCellId"
    size = grid.GetCell(0).GetNumberOfPoints() if grid.GetNumberOfCells() else 1
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, size)
    named = lambda data, name: vtk_to_numpy(data.GetArray(name))
    points = grid.GetPoints()
    return {
        "points": vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3)),
        "cells": cells,
        "point_ids": named(grid.GetPointData(), "GlobalNodeId"),
        "point_ghosts": named(grid.GetPointData(), "vtkGhostType"),
        "kinds": named(grid.GetPointData(), "kind"),
        "cell_ids": named(grid.GetCellData(), "GlobalCellId"),
        "cell_ghosts": named(grid.GetCellData(), "vtkGhostType"),
        "ranks": named(grid.GetCellData(), "rank"),
    }


def check_pieces(index, points, simplices):
    """Own cells are the simplices, each once; ghosts are the same under the same ids."""
    own_cells, own_points = [], []
    directory = index.rsplit("/", 1)[0]
    sources = [piece.get("Source") for piece in xml.parse(index).iter("Piece")]
    for rank, source in enumerate(sources):
        piece = arrays_of(f"{directory}/{source}")
        dim = points.shape[1]
        assert numpy.array_equal(piece["points"][:, :dim], points[piece["point_ids"]]), source
        assert not piece["points"][:, dim:].any(), source
        # A rank may have no simplices, and VTK no shape for them.
        ids = piece["point_ids"][piece["cells"]].reshape(-1, dim + 1)
        assert numpy.array_equal(ids, simplices[piece["cell_ids"]]), source
        ghosts = piece["cell_ghosts"] == GHOST
        assert numpy.array_equal(ghosts, piece["ranks"] != rank), source
        assert set(piece["point_ghosts"]) <= {0, GHOST}
        own_cells.append(piece["cell_ids"][~ghosts])
        own_points.append(piece["point_ids"][piece["point_ghosts"] == 0])
    own_cells, own_points = numpy.concatenate(own_cells), numpy.concatenate(own_points)
    assert numpy.array_equal(numpy.sort(own_cells), numpy.arange(len(simplices)))
    assert numpy.array_equal(numpy.sort(own_points), numpy.unique(simplices))
    return len(sources)


def check_whole(index, simplices):
    """VTK's parallel reader finds the pieces by the index."""
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(index)
    reader.Update()
    grid = reader.GetOutput()
    ghosts = grid.GetCellGhostArray()
    own = sum(ghosts.GetValue(cell) == 0 for cell in range(ghosts.GetNumberOfTuples()))
    assert own == len(simplices), (own, len(simplices))


def check_volume(points, simplices):
    """Positively oriented, and together as large as their convex hull: no gap, no overlap."""
    corners = points[simplices]
    edges = corners[:, 1:] - corners[:, :1]
    volumes = numpy.linalg.det(edges)
    assert volumes.min() > -1e-12 * volumes.max(), volumes.min()
    facets = {}
    for opposite in range(simplices.shape[1]):
        facet = numpy.sort(numpy.delete(simplices, opposite, axis=1), axis=1)
        for key, simplex in zip(map(tuple, facet.tolist()), range(len(simplices))):
            facets.setdefault(key, []).append((simplex, opposite))
    assert max(map(len, facets.values())) == 2
    # The hull, seen from a point within: the volume is that of cones over its facets.
    centre = points[numpy.unique(simplices)].mean(axis=0)
    cones = 0.0
    for key, sides in facets.items():
        if len(sides) == 1:
            simplex, opposite = sides[0]
            cone = points[simplices[simplex]].copy()
            cone[opposite] = centre
            volume = numpy.linalg.det(cone[1:] - cone[:1])
            assert volume > 0, "the hull is not convex there"
            cones += volume
    assert abs(cones - volumes.sum()) < 1e-9 * cones, (cones, volumes.sum())


def main():
    inputs = numpy.load(sys.argv[1])
    name = sys.argv[2]
    points = numpy.load(f"{name}.points.npy")
    simplices = numpy.load(f"{name}.simplices.npy")
    assert simplices.dtype == numpy.uint64 and points.dtype == numpy.float64
    simplices = simplices.astype(numpy.int64)
    assert numpy.array_equal(points[: len(inputs)], inputs)
    used = numpy.unique(simplices)
    distinct = numpy.unique(inputs, axis=0)
    assert (used < len(inputs)).sum() == len(distinct)
    assert numpy.array_equal(used[used >= len(inputs)], numpy.arange(len(inputs), len(points)))
    check_volume(points, simplices)
    pieces = check_pieces(f"{name}.pvtu", points, simplices)
    check_whole(f"{name}.pvtu", simplices)
    import meshio

    # meshio cannot read a piece without cells, which a rank of few points may have.
    rank = next(at for at in range(pieces) if len(arrays_of(f"{name}_{at}.vtu")["cells"]))
    first = meshio.read(f"{name}_{rank}.vtu")
    assert set(first.point_data) >= {"GlobalNodeId", "kind", "vtkGhostType", "domain"}
    print(f"{len(points)} points and {len(simplices)} simplices of {pieces} pieces are read")


main()
