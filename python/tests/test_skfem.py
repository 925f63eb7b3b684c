"""Meshes of scikit-fem, beside those that it makes of files for Gmsh."""

import netmesh
import numpy as np
import pytest

skfem = pytest.importorskip("skfem")
meshio = pytest.importorskip("meshio")
io = pytest.importorskip("skfem.io.meshio")

RINGS = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]], float)
# The domain is on the left of the first sides, and on the right of the fourth.
SIDES = [[0, 1], [1, 2], [2, 3], [0, 3], [4, 5], [6, 5], [6, 7], [4, 7]]


def plate(**options):
    markers = [1, 2, 2, 4, 0, 0, -5, 7]
    regions = [(0.5, 0.5, 3), (1.5, 1.5, -2)]
    return netmesh.mesh(RINGS, SIDES, markers=markers, regions=regions, max_edge=0.4, **options)


def halves():
    box = [[x, y, z] for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)]
    walls = [[0, 1, 3, 2], [8, 10, 11, 9], [4, 5, 7, 6], [0, 4, 8, 9, 5, 1], [2, 3, 7, 11, 10, 6]]
    walls += [[0, 2, 6, 10, 8, 4], [1, 5, 9, 11, 7, 3]]
    regions = [(0.5, 0.5, 0.5, 1), (1.5, 0.5, 0.5, 2)]
    numbers = [1, 2, 30, 4, 4, 0, -7]
    return netmesh.mesh(box, [[0, 3]], walls, markers=[9], facet_markers=numbers, regions=regions)


def faces(mesh, name):
    """Returns the vertices of the facets of a boundary, with the element on whose side it is."""
    chosen = mesh.boundaries[name]
    sides = mesh.f2t[chosen.ori, chosen]
    return {(*sorted(face), side) for face, side in zip(mesh.facets[:, chosen].T.tolist(), sides.tolist())}


def compared(made, path):
    """Holds that a mesh is the one that scikit-fem reads."""
    read = io.from_meshio(meshio.read(path))
    assert (made.p == read.p).all()
    # Elements of files stand by their groups.
    new = {tuple(sorted(cell)): at for at, cell in enumerate(made.t.T.tolist())}
    number = np.array([new[tuple(sorted(cell))] for cell in read.t.T.tolist()])
    assert set(made.subdomains) == set(read.subdomains)
    for name, cells in read.subdomains.items():
        assert set(made.subdomains[name].tolist()) == set(number[cells].tolist())
    assert set(made.boundaries or {}) == set(read.boundaries or {})
    for name in read.boundaries or {}:
        theirs = {(*face, number[side]) for *face, side in faces(read, name)}
        assert faces(made, name) == theirs and len(theirs) > 0
    return read


def test_a_plate_has_the_names_of_its_file(tmp_path):
    m = plate()
    m.export(tmp_path / "plate.msh")
    made = m.to_skfem()
    assert isinstance(made, skfem.MeshTri1) and made.is_valid()
    compared(made, tmp_path / "plate.msh")
    names = {"marker_-5", "marker_0", "marker_1", "marker_2", "marker_4", "marker_7"}
    assert set(made.boundaries) == names and set(made.subdomains) == {"region_3", "region_-2"}

    @skfem.Functional
    def one(w):
        return 1.0 + 0 * w.x[0]

    element = skfem.ElementTriP1()
    length = {"marker_1": 3, "marker_2": 6, "marker_4": 3, "marker_0": 2, "marker_-5": 1, "marker_7": 1}
    for name, expected in length.items():
        assert np.isclose(one.assemble(skfem.FacetBasis(made, element, facets=name)), expected)
    for name, area in {"region_3": 8, "region_-2": 1}.items():
        assert np.isclose(one.assemble(skfem.CellBasis(made, element, elements=name)), area)


def test_normals_point_to_the_right_of_segments_and_before_facets():
    made = plate().to_skfem()
    basis = skfem.FacetBasis(made, skfem.ElementTriP1(), facets="marker_-5")
    # From (2, 2) to (1, 2): what is right of it is above.
    assert np.allclose(basis.normals[1], 1)
    basis = skfem.FacetBasis(made, skfem.ElementTriP1(), facets="marker_7")
    assert np.allclose(basis.normals[0], 1)
    space = halves()
    basis = skfem.FacetBasis(space.to_skfem(), skfem.ElementTetP1(), facets="marker_30")
    corners = space.points[space.facet_triangles[space.facet_markers == 30][0]]
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    assert np.allclose(basis.normals[0], np.sign(normal[0]))


def test_a_box_has_the_names_of_its_file(tmp_path):
    m = halves()
    m.export(tmp_path / "box.msh")
    made = m.to_skfem()
    assert isinstance(made, skfem.MeshTet1) and made.is_valid()
    compared(made, tmp_path / "box.msh")
    assert set(made.boundaries) == {"marker_1", "marker_2", "marker_30", "marker_4", "marker_0", "marker_-7"}


@pytest.mark.parametrize("dim", [2, 3])
def test_a_mesh_of_points_is_one_subdomain(dim, random, tmp_path):
    m = netmesh.mesh(random.random((30, dim)))
    m.export(tmp_path / "points.msh")
    made = m.to_skfem()
    compared(made, tmp_path / "points.msh")
    assert list(made.subdomains) == ["mesh"] and not made.boundaries


def test_parts_and_cropped_meshes_go_to_scikit_fem(tmp_path):
    m = plate(extent="all", output="well_spaced")
    part = m.part("box", across=True)
    part.export(tmp_path / "part.msh")
    made = part.to_skfem()
    compared(made, tmp_path / "part.msh")
    assert made.t.shape[1] == len(part.simplices) < len(m.simplices)
    assert (np.sort(made.t, axis=0) == np.sort(part.cells.T, axis=0)).all()
    hull = plate(extent="hull")
    hull.export(tmp_path / "hull.msh")
    compared(hull.to_skfem(), tmp_path / "hull.msh")


def test_other_dimensions_are_refused(random):
    with pytest.raises(netmesh.InvalidArgumentError, match="the mesh has dim = 4; it must be 2 or 3"):
        netmesh.mesh(random.random((10, 4))).to_skfem()


def turned_cube(count):
    """Returns a cube turned, with so many points along its edges on its faces, and these as squares."""
    grid = np.stack(np.meshgrid(*[np.arange(count)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    grid = grid[((grid == 0) | (grid == count - 1)).any(axis=1)]
    numbers = {tuple(place): at for at, place in enumerate(grid.tolist())}
    squares = []
    for axis in range(3):
        for side in (0, count - 1):
            for u in range(count - 1):
                for v in range(count - 1):
                    ring = [(u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)]
                    squares.append([numbers[tuple(np.insert(corner, axis, side))] for corner in ring])
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    return grid @ turn.T / 3 + 0.7, squares


def test_tetrahedra_that_are_flat_in_a_facet_are_told():
    points, squares = turned_cube(4)
    m = netmesh.mesh(points, facets=squares)
    flat = m.flat_simplices
    assert len(flat) == m.quality().flat > 0 and (np.diff(flat) > 0).all()
    corners = m.points[m.simplices]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    # A lattice has others inside.
    assert volumes[flat].max() < 1e-12 and (volumes < 1e-12).sum() >= len(flat)
    with pytest.warns(UserWarning, match=f"{len(flat)} of the simplices have all vertices on one facet"):
        made = m.to_skfem()
    assert made.remove_elements(flat).nelements == len(m.simplices) - len(flat)


def test_nothing_is_told_of_meshes_without_flat_tetrahedra(recwarn):
    m = halves()
    assert len(m.flat_simplices) == m.quality().flat == 0
    m.to_skfem()
    assert not recwarn.list
