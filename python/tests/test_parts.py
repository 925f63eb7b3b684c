"""Parts of meshes as meshes of their own, beside brute force with exact arithmetic."""

import copy
import fractions
import os
import pathlib
import pickle

import netmesh
import numpy as np
import pytest

DATA = pathlib.Path(
    os.environ.get("NETMESH_DATA", pathlib.Path(__file__).parents[3] / "shared" / "data")
)


def real_points(name, columns):
    path = DATA / name
    if not path.exists():
        pytest.skip(f"{path} is not there")
    return np.unique(np.loadtxt(path, usecols=range(columns)), axis=0)


def sign(*points):
    """Returns the sign of the orientation of the points."""
    rows = [[fractions.Fraction(x) for x in point] for point in points]
    matrix = [[x - y for x, y in zip(row, rows[0])] for row in rows[1:]]
    if len(matrix) == 2:
        (a, b), (c, d) = matrix
        value = a * d - b * c
    else:
        (a, b, c), (d, e, f), (g, h, i) = matrix
        value = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return (value > 0) - (value < 0)


def holders(points, cells, query):
    """Returns the rows of cells whose closure holds a point, by exact signs."""
    corners = points[cells]
    near = ((corners.min(axis=1) <= query) & (query <= corners.max(axis=1))).all(axis=1)
    found = []
    for row in np.flatnonzero(near):
        replaced = np.repeat(corners[row][None], cells.shape[1], axis=0)
        replaced[np.arange(cells.shape[1]), np.arange(cells.shape[1])] = query
        if all(sign(*simplex.tolist()) >= 0 for simplex in replaced):
            found.append(row)
    return found


def nested(dim, random):
    """Returns a mesh with a domain in the root."""
    return netmesh.mesh(np.concatenate([random.random((15, dim)), 0.5 + 1e-5 * random.random((15, dim))]))


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("choice", [{"extent": "hull"}, {"extent": "box", "across": True}, {"domain": 1}, {}])
def test_a_part_has_its_own_vertices_and_cells(dim, choice, random):
    m = nested(dim, random)
    part = m.part(**choice)
    assert 0 < len(part.simplices) <= len(m.simplices)
    assert (part.vertices == np.unique(m.simplices[part.simplices])).all()
    assert (part.points == m.points[part.vertices]).all() and (part.kinds == m.kinds[part.vertices]).all()
    assert (part.vertices[part.cells] == m.simplices[part.simplices]).all()
    assert part.dim == dim and part.points.dtype == np.float64 and part.cells.dtype == np.int32
    assert len(part.volumes) == len(part.cells)


@pytest.mark.parametrize("dim", [2, 3])
def test_points_are_located_in_the_part_alone(dim, random):
    m = nested(dim, random)
    for part in (m.part("hull"), m.part("hull", across=True), m.part(domain=1)):
        corners = m.points[m.simplices]
        edges = (corners[:, 0] + corners[:, 1])[:: 1 + len(corners) // 60] / 2
        middles = corners.mean(axis=1)[:: 1 + len(corners) // 60]
        queries = np.concatenate([m.points[::5], part.points[:30], edges, middles, random.random((20, dim))])
        found = part.locate(queries)
        for query, row in zip(queries, found):
            expected = holders(part.points, part.cells, query)
            assert row == (expected[0] if expected else -1)
        assert (found >= 0).sum() > 5 and (found < 0).sum() > 5
        assert (part.locate(queries, threads=2) == found).all()
        assert part.locate(queries.reshape(1, -1, dim)).shape == (1, len(queries))


def test_faces_that_the_mesh_finds_outside_of_the_part_are_located_in_it(random):
    # A vertex on the boundary of the part is found first in a simplex of the mesh that the part has not.
    m = nested(2, random)
    part = m.part(domain=1)
    least = m.locate(part.points)
    assert (~np.isin(least, part.simplices)).any()
    rows = part.locate(part.points)
    assert (rows == [np.flatnonzero((part.cells == v).any(axis=1))[0] for v in range(len(part.points))]).all()


def test_points_are_located_in_a_part_of_a_cropped_mesh(random):
    square = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [3, 3], [1, 3]], float)
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    cluster = [0.5, 2] + 1e-5 * random.random((10, 2))
    m = netmesh.mesh(
        np.concatenate([square, cluster]), sides, holes=[[2, 2]], output="hierarchical", min_angle=20
    )
    assert len(m.domains) > 1
    part = m.part(domain=1)
    assert 0 < len(part.simplices) < len(m.simplices)
    queries = np.concatenate([m.points, [[2, 2], [5, 5]], m.points[m.simplices].mean(axis=1)])
    for query, row in zip(queries, part.locate(queries)):
        expected = holders(part.points, part.cells, query)
        assert row == (expected[0] if expected else -1)


def test_faces_are_located_across_holes():
    # Two holes leave the inside of the hull and the outside no facet in common at a corner.
    corners = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [3, 1], [1, 3]], float)
    sides = [[0, 1], [1, 4], [4, 0], [0, 3], [3, 5], [5, 0]]
    found_elsewhere = 0
    for turns in range(4):
        turned = corners @ np.linalg.matrix_power([[0, 1], [-1, 0]], turns)
        holes = [turned[[0, 1, 4]].mean(axis=0), turned[[0, 3, 5]].mean(axis=0)]
        m = netmesh.mesh(turned, sides, holes=holes, extent="all")
        for part in (m.part("hull"), m.part("hull", across=True)):
            found_elsewhere += m.locate(turned[0]) not in part.simplices
            for query, row in zip(part.points, part.locate(part.points)):
                assert row == holders(part.points, part.cells, query)[0]
    assert found_elsewhere > 0


def radius_edges(m, part):
    corners = part.points[part.cells]
    count = corners.shape[1]
    edges = [np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a in range(count) for b in range(a)]
    return part.circumradii / np.min(edges, axis=0)


@pytest.mark.parametrize("dim", [2, 3])
def test_quality_is_that_of_the_part(dim, random):
    corners = np.stack(np.meshgrid(*[[0.0, 1.0]] * dim), axis=-1).reshape(-1, dim)
    m = netmesh.mesh(np.concatenate([corners, random.random((60, dim))]), output="well_spaced")
    part = m.part("hull", across=True)
    quality = part.quality()
    at_cage = np.isin(m.simplices[part.simplices], m.hull.vertices).any(axis=1)
    assert np.isclose(quality.worst_radius_edge, radius_edges(m, part)[~at_cage].max(), rtol=1e-9)
    # Each edge counts for both of its ends.
    assert quality.max_degree == np.bincount(part.edges.ravel()).max()
    # The cells of vertices off the boundary of the part are those in the mesh.
    inner = np.setdiff1d(part.vertices, part.hull.vertices)
    indptr, indices = m.vertex_neighbors
    at, of = m.vertex_simplices
    aspects = []
    for v in inner:
        near = np.linalg.norm(m.points[indices[indptr[v] : indptr[v + 1]]] - m.points[v], axis=1).min()
        aspects.append(2 * m.circumradii[of[at[v] : at[v + 1]]].max() / near)
    assert len(inner) > 20 and np.isclose(quality.worst_aspect, max(aspects), rtol=1e-9)
    assert np.isclose(quality.mean_aspect, np.mean(aspects), rtol=1e-9)
    counts, _ = part.quality_histogram("radius_edge", [0, 1e9], hull=True)
    assert counts.tolist() == [len(part.cells)]
    counts, _ = part.quality_histogram("aspect", [0, 1e9])
    assert counts.tolist() == [len(inner)]


def test_quality_of_all_is_that_of_the_mesh(random):
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    sides = [[0, 1], [1, 2], [2, 3], [3, 0]]
    for m in (
        nested(2, random),
        nested(3, random),
        netmesh.mesh(square, sides, max_edge=0.2),
        netmesh.mesh(random.random((50, 3)), output="well_spaced", min_dihedral=10, gives_way="bound"),
    ):
        assert m.part().quality() == m.quality()
        for measure in ("aspect", "smallest_angle"):
            mine, theirs = (x.quality_histogram(measure, [0, 10, 1e9]) for x in (m.part(), m))
            assert (mine[0] == theirs[0]).all()


def test_figures_of_domains_stay_within_those_of_the_mesh(random):
    m = nested(2, random)
    whole, inner = m.quality(), m.part(domain=1).quality()
    assert 1 < inner.worst_aspect <= whole.worst_aspect
    assert 1 < inner.worst_aspect_anywhere <= whole.worst_aspect_anywhere
    assert 0 < inner.worst_radius_edge <= whole.worst_radius_edge


def test_parts_of_earthquakes():
    points = real_points("usgs_quakes_week.xyz", 3)
    m = netmesh.mesh(points, output="well_spaced")
    part = m.part("hull")
    assert (part.points[part.cells] == m.points[m.simplices[part.simplices]]).all()
    rows = part.locate(part.points[part.cells].mean(axis=1))
    assert (rows == np.arange(len(part.cells))).mean() > 0.99
    outside = m.placements("hull") == netmesh.Placement.OUTSIDE
    assert (part.locate(m.points[m.simplices[outside]].mean(axis=1)) == -1).all()


def test_parts_have_sizes_and_regions(random):
    box = [[x, y] for x in (0, 1, 2) for y in (0, 1)]
    walls = [[0, 2], [2, 4], [4, 5], [5, 3], [3, 1], [1, 0], [2, 3]]
    regions = [(0.5, 0.5, 7), (1.5, 0.5, -8)]
    m = netmesh.mesh(box, walls, regions=regions, size=0.3, extent="all", output="well_spaced")
    part = m.part("box")
    assert 0 < len(part.simplices) < len(m.simplices)
    assert (part.sizes == m.sizes[part.vertices]).all() and len(part.sizes)
    assert (part.simplex_regions == m.simplex_regions[part.simplices]).all()
    assert set(part.simplex_regions.tolist()) == {7, -8}
    plain = netmesh.mesh(random.random((10, 2))).part("hull")
    assert len(plain.sizes) == len(plain.simplex_regions) == 0


def test_parts_are_written_and_shown_alike(random, tmp_path):
    meshio = pytest.importorskip("meshio")
    m = nested(3, random)
    part = m.part("hull", across=True)
    heights = random.random(len(m.points))
    part.export(tmp_path / "all.vtu", attributes={"height": heights})
    part.export(tmp_path / "own.vtu", attributes={"height": heights[part.vertices]})
    assert (tmp_path / "all.vtu").read_bytes() == (tmp_path / "own.vtu").read_bytes()
    read = meshio.read(tmp_path / "all.vtu")
    volumes = random.random(len(m.simplices))
    made = part.to_meshio({"height": heights}, {"volume": volumes})
    assert (made.points == read.points).all() and (made.cells[0].data == read.cells[0].data).all()
    for name in ("kind", "height", "input"):
        theirs = read.point_data[name].ravel()
        assert (made.point_data[name].astype(theirs.dtype) == theirs).all()
    assert (made.cell_data["volume"][0] == volumes[part.simplices]).all()
    own = part.to_meshio({"height": heights[part.vertices]}, {"volume": volumes[part.simplices]})
    assert (own.point_data["height"] == made.point_data["height"]).all()
    assert (own.cell_data["volume"][0] == made.cell_data["volume"][0]).all()
    rule = r" has shape \(3,\); it must be"
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^point_data\['x'\]" + rule):
        part.to_meshio({"x": [1, 2, 3]})
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^cell_data\['x'\]" + rule):
        part.to_meshio(None, {"x": [1, 2, 3]})
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^attributes\['x'\]" + rule):
        part.export(tmp_path / "own.vtu", attributes={"x": [1, 2, 3]})


def test_a_part_of_nothing_is_empty(tmp_path):
    m = netmesh.mesh([[0, 0], [1, 0], [3, 0]])
    part = m.part("hull")
    assert part.points.shape == (0, 2) and part.cells.shape == (0, 3) and len(part.vertices) == 0
    assert (part.locate(m.points) == -1).all()
    assert part.quality().max_degree == 0 and part.quality_histogram(hull=True)[0].sum() == 0
    part.export(tmp_path / "empty.vtu")
    pytest.importorskip("meshio")
    assert len(part.to_meshio().points) == 0


def same(one, other, names):
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


def test_parts_and_filtrations_and_shapes_pickle(random):
    m = netmesh.mesh(random.random((30, 2)), algorithm="delaunay")
    part, alpha = netmesh.mesh(random.random((30, 2))).part("hull", across=True), m.filtration()
    near = netmesh.mesh(random.random((30, 2)), output="well_spaced").filtration("mesh", threads=2)
    shape = alpha.shape()
    for thing in (part, alpha, near, shape):
        assert copy.copy(thing) is thing and copy.deepcopy(thing) is thing
    other = pickle.loads(pickle.dumps(part))
    assert same(other, part, ["simplices", "vertices", "points", "cells", "kinds", "volumes"])
    for kind, values in ((alpha, "alpha"), (near, "mesh")):
        other = pickle.loads(pickle.dumps(kind))
        assert other.kind == values and other.factor == kind.factor
        for k in range(3):
            assert (other.faces(k) == kind.faces(k)).all() and (other.values(k) == kind.values(k)).all()
    other = pickle.loads(pickle.dumps(shape))
    assert same(other, shape, ["alpha", "volume", "betti", "face_counts", "boundary", "simplices"])
    # A mesh is made again once for all that come of it.
    again, other, same_part = pickle.loads(pickle.dumps((m, alpha, m.part())))
    assert other._mesh is again and same_part._mesh is again


def test_parts_without_simplices_are_refused_where_there_is_nothing_to_show(tmp_path):
    pytest.importorskip("skfem")
    empty = netmesh.mesh([[0, 0], [1, 1]]).part("hull")
    for call in (empty.plot, empty.to_skfem):
        with pytest.raises(netmesh.InvalidArgumentError, match="^the part has no simplices"):
            call()
    empty.export(tmp_path / "empty.svg")
    assert not any(word in (tmp_path / "empty.svg").read_text() for word in ("inf", "NaN", "180"))
    empty.export(tmp_path / "empty.domains.json")
    assert '"center":null,"point":null' in (tmp_path / "empty.domains.json").read_text()


def test_a_part_that_has_not_the_centre_of_a_domain_has_none(tmp_path):
    import json

    random = np.random.default_rng(194)
    m = netmesh.mesh(np.r_[random.random((4, 2)), random.random(2) + 1e-4 * random.random((3, 2))])
    part = m.part("hull")
    part.export(tmp_path / "part.domains.json")
    found = json.loads((tmp_path / "part.domains.json").read_text())["domains"]
    assert len(found) == len(m.domains) > 1
    for domain, center in zip(found, m.domains["center"]):
        if center in part.vertices:
            assert domain["point"] == m.points[center].tolist()
        else:
            assert domain["center"] is None and domain["point"] is None
    assert any(domain["center"] is None for domain in found)


def test_points_in_no_simplex_are_told_to_scikit_fem():
    pytest.importorskip("skfem")
    points = [[0, 0], [1, 0], [1, 1], [0, 1], [3, 3]]
    m = netmesh.mesh(points, [[0, 1], [1, 2], [2, 3], [3, 0]])
    with pytest.warns(UserWarning, match="^1 of the points are in no simplex"):
        assert m.to_skfem().nelements == len(m.simplices)
    assert m.part("all").to_skfem().nvertices == len(m.points) - 1


def test_what_is_shown_comes_before_the_mesh_that_it_is_of():
    pytest.importorskip("matplotlib").use("agg")
    m = netmesh.mesh(np.random.default_rng(264).random((12, 2)))
    part = m.part("hull", across=True)
    assert len(part.cells) == len(m.points) == 45
    colors = part._given_colors(np.arange(45.0))
    assert colors.of == "simplices" and (colors.values == np.arange(45)).all()


def test_names_of_the_mesh_are_not_replaced_in_other_packages():
    pytest.importorskip("meshio")
    m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])
    with pytest.raises(netmesh.InvalidArgumentError, match="^point_data has 'kind', a name that the mesh has"):
        m.to_meshio({"kind": m.kinds})
    with pytest.raises(netmesh.ArgumentTypeError, match="^point_data is of type list; it must be a dict"):
        m.to_meshio([m.kinds])
    with pytest.raises(netmesh.InvalidArgumentError, match="^clip is for 3D"):
        m.plot(clip="y")
    with pytest.raises(netmesh.ArgumentTypeError, match=r"^background\[0\] is of type Part; it must be a Mesh"):
        netmesh.mesh([[0, 0], [1, 0], [1, 1]], background=(m.part("all"), np.ones(3)))
