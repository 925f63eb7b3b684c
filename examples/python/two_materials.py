"""Heat in a part of two materials, from STL files to a solved problem: two_materials.py [FOLDER]

Needs netmesh, numpy, meshio and scikit-fem; with PyVista and Gmsh it reads the mesh by these, too.
"""
import sys
import tempfile
from pathlib import Path

import meshio
import netmesh
import numpy as np
import skfem
from skfem.helpers import dot, grad

# A bar along x with a wall inside at x = 1: the patches of its surface, a file each.
CORNERS = np.array([[x, y, z] for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)], float)
PATCHES = {
    "cold.stl": [[0, 1, 3, 2]],
    "hot.stl": [[8, 10, 11, 9]],
    "wall.stl": [[4, 5, 7, 6]],
    "sides.stl": [[a, b, b + 4, a + 4] for first in (0, 4)
                  for a, b in [(first, first + 1), (first + 1, first + 3), (first + 3, first + 2), (first + 2, first)]],
}
#: Conductivity of the region behind the first patch, and of that behind the second.
CONDUCTIVITY = {1: 1.0, 2: 4.0}


def write_patches(folder):
    for name, quads in PATCHES.items():
        triangles = [half for a, b, c, d in quads for half in ((a, b, c), (a, c, d))]
        meshio.write(folder / name, meshio.Mesh(CORNERS, [("triangle", triangles)]), binary=True)


# [mesh]
def mesh_of(folder):
    """Return the mesh of what the patches enclose, with a marker for each patch, from 1."""
    patches = [meshio.read(folder / name) for name in PATCHES]
    first = np.cumsum([0] + [len(patch.points) for patch in patches])
    triangles = [patch.cells_dict["triangle"] + at for patch, at in zip(patches, first)]
    return netmesh.mesh(
        np.concatenate([patch.points for patch in patches]).astype(float),
        facets=np.concatenate(triangles),
        facet_markers=np.repeat(np.arange(1, 1 + len(patches)), [len(own) for own in triangles]),
        labels="regions",  # a number for each material
        interior="seeds",  # all that is shut off from outside, whatever the directions of triangles
        criterion="radius_edge",
        quality_bound=2.0,
        min_dihedral=10.0,
        max_edge=0.4,
    )
# [end]


# [solve]
def solve(points, tetrahedra, regions, held):
    """Return the temperature at the points, which `held` has for some vertices."""
    whole = skfem.MeshTet(np.ascontiguousarray(points.T), np.ascontiguousarray(tetrahedra.T.astype(np.int64)))
    basis = skfem.Basis(whole, skfem.ElementTetP1())
    conducts = basis.with_element(skfem.ElementTetP0()).interpolate(
        np.array([CONDUCTIVITY[region] for region in regions]))
    flow = skfem.BilinearForm(lambda u, v, w: w.conducts * dot(grad(u), grad(v)))
    start = np.zeros(len(points))
    for vertices, temperature in held:
        start[vertices] = temperature
    fixed = np.concatenate([vertices for vertices, _ in held])
    return skfem.solve(*skfem.condense(flow.assemble(basis, conducts=conducts), x=start, D=fixed))


def held_by_markers(triangles, markers):
    """Return the vertices of the cold and of the hot patch, with their temperatures."""
    return [(np.unique(triangles[markers == marker]), temperature) for marker, temperature in ((1, 0.0), (2, 5.0))]
# [end]


def readers(path, vtu):
    """Yield the points, tetrahedra, regions, triangles and markers that other programs read."""
    found = meshio.read(path)
    physical = found.cell_data_dict["gmsh:physical"]
    cells = found.cells_dict
    yield "meshio", found.points, cells["tetra"], physical["tetra"], cells["triangle"], physical["triangle"]
    try:
        import gmsh
    except ImportError:
        print("gmsh: not installed")
    else:
        yield "gmsh", *read_by_gmsh(gmsh, path)
    try:
        import pyvista
    except ImportError:
        print("pyvista: not installed")
    else:
        grid = pyvista.read(vtu)
        is_solid = grid.celltypes == pyvista.CellType.TETRA
        regions, markers = grid.cell_data["region"][is_solid], grid.cell_data["marker"][~is_solid]
        by_type = grid.cells_dict
        yield "pyvista", grid.points, by_type[10], regions, by_type[5], markers


def read_by_gmsh(gmsh, path):
    gmsh.initialize(["gmsh", "-nopopup", "-v", "0"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.open(str(path))
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        order = np.argsort(tags)
        points = coordinates.reshape(-1, 3)[order]
        found = {2: ([], []), 3: ([], [])}
        for dim, group in gmsh.model.getPhysicalGroups():
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group) if dim in found else ():
                for nodes in gmsh.model.mesh.getElements(dim, entity)[2]:
                    own = np.searchsorted(tags[order], nodes.reshape(-1, dim + 1))
                    found[dim][0].append(own)
                    found[dim][1].append(np.full(len(own), group))
        tetrahedra, regions, triangles, markers = (
            np.concatenate(arrays) for dim in (3, 2) for arrays in found[dim])
        return points, tetrahedra, regions, triangles, markers
    finally:
        gmsh.finalize()


def error_of(points, temperature):
    """Return the largest error: 4 of 5 degrees fall in the first metre, 1 in the second."""
    x = points[:, 0]
    return np.abs(temperature - np.where(x <= 1, 4 * x, 3 + x)).max()


def main(folder):
    folder = Path(folder)
    write_patches(folder)
    mesh = mesh_of(folder)
    markers = np.repeat(np.arange(1, 5), [2, 2, 2, 16])[mesh.facet_parents]
    held = held_by_markers(mesh.facet_triangles, markers)
    found = solve(mesh.points, mesh.simplices, mesh.simplex_regions, held)
    errors = {"netmesh": error_of(mesh.points, found)}
    mesh.export(folder / "part.msh")
    mesh.export(folder / "part.vtu")
    for name, points, tetrahedra, regions, triangles, markers in readers(folder / "part.msh", folder / "part.vtu"):
        found = solve(points, tetrahedra, regions, held_by_markers(triangles, markers))
        errors[name] = error_of(points, found)
    for name, error in errors.items():
        print(f"{name}: {len(mesh.points)} vertices, largest error {error:.1e}")
    return errors


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as own:
            main(own)
