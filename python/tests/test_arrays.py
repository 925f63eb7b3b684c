"""Arrays that are made of the mesh's, and values of inputs at all vertices."""

import itertools

import netmesh
import numpy as np
import pytest


@pytest.fixture(params=[2, 3, 4])
def mesh(request, random):
    return netmesh.mesh(random.random((60, request.param)))


def rows(array):
    return set(map(tuple, array.tolist()))


def lists(csr):
    return [csr.indices[a:b].tolist() for a, b in zip(csr.indptr, csr.indptr[1:])]


def test_edges_and_facets(mesh):
    dim, simplices = mesh.dim, np.sort(mesh.simplices, axis=1).tolist()
    edges = {pair for s in simplices for pair in itertools.combinations(s, 2)}
    assert mesh.edges.tolist() == sorted(map(list, edges))
    facets = {facet for s in simplices for facet in itertools.combinations(s, dim)}
    assert rows(np.sort(mesh.facets.vertices, axis=1)) == facets
    assert len(mesh.facets.vertices) == len(mesh.facets.simplices) == len(facets)
    for facet, (a, b) in zip(mesh.facets.vertices[:200], mesh.facets.simplices):
        assert set(facet) <= set(mesh.simplices[a]) and (b == -1 or b in mesh.neighbors[a])
    on_hull = mesh.facets.simplices[:, 1] == -1
    assert rows(mesh.facets.vertices[on_hull]) == rows(mesh.hull.vertices)
    assert (mesh.neighbors[mesh.hull.simplices] == -1).any(axis=1).all()


def test_stars(mesh):
    simplices = [[] for _ in mesh.points]
    neighbors = [set() for _ in mesh.points]
    for s, vertices in enumerate(mesh.simplices.tolist()):
        for v in vertices:
            simplices[v].append(s)
            neighbors[v] |= set(vertices) - {v}
    assert lists(mesh.vertex_simplices) == simplices
    assert lists(mesh.vertex_neighbors) == list(map(sorted, neighbors))


def test_measures(mesh):
    corners = mesh.points[mesh.simplices]
    lengths = np.linalg.norm(corners - mesh.circumcenters[:, None], axis=2)
    assert np.allclose(lengths, mesh.circumradii[:, None], rtol=1e-9)
    determinants = np.linalg.det(corners[:, 1:] - corners[:, :1])
    volumes = determinants / np.prod(np.arange(1, mesh.dim + 1))
    assert np.allclose(mesh.volumes, volumes, rtol=1e-9, atol=1e-15)
    voronoi = mesh.voronoi
    assert np.isclose(voronoi.shares.sum(), mesh.volumes.sum(), rtol=1e-12)
    assert (voronoi.volumes[voronoi.is_bounded] == voronoi.shares[voronoi.is_bounded]).all()
    assert np.isinf(voronoi.volumes[~voronoi.is_bounded]).all()
    assert set(np.flatnonzero(~voronoi.is_bounded)) == set(mesh.hull.vertices.ravel())
    assert (voronoi.ridges == mesh.edges).all()
    assert sorted(lists(voronoi.regions)[7]) == lists(mesh.vertex_simplices)[7]
    for ends, corners in zip(mesh.edges[:50].tolist(), lists(voronoi.ridge_corners)):
        assert all(set(ends) <= set(mesh.simplices[s].tolist()) for s in corners)


def test_arrays_are_made_once_and_stay_as_they_are(mesh):
    for name in ("edges", "circumcenters", "circumradii", "volumes"):
        array = getattr(mesh, name)
        assert array is getattr(mesh, name)
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(ValueError, match="read-only"):
        mesh.voronoi.regions.indices[0] = 1


@pytest.mark.parametrize("shape", [(), (2,), (2, 2)])
@pytest.mark.parametrize("options", [{}, {"algorithm": "delaunay"}])
def test_values_of_inputs_at_all_vertices(shape, options, random):
    points = random.random((80, 2))
    points = np.concatenate([points, points[:1]])
    values = random.random((81, *shape)) + 1j * random.random((81, *shape))
    m = netmesh.mesh(points, **options)
    found = m.extend_values(values)
    assert found.shape == (len(m.points), *shape) and (found[:80] == values[:80]).all()
    tri = netmesh.Delaunay(points[:80])
    inside = tri.find_simplex(m.points) >= 0
    linear = netmesh.LinearNDInterpolator(tri, values[:80])(m.points[inside])
    assert np.allclose(found[inside], linear, rtol=0, atol=1e-12)
    nearest, _ = m.nearest(m.points[~inside], among="inputs")
    assert (found[~inside] == values[nearest]).all()
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^values has shape \(80,\)"):
        m.extend_values(np.zeros(80))


def test_values_of_inputs_on_a_line():
    m = netmesh.mesh(np.outer(np.arange(5.0), [1, 2]))
    found = m.extend_values(np.arange(5))
    assert (found == m.nearest(m.points, among="inputs")[0]).all() and len(found) > 5


def test_parts_of_a_mesh(random, tmp_path):
    corners = np.array(list(itertools.product([0.0, 1], repeat=3)))
    m = netmesh.mesh(np.concatenate([corners, random.random((300, 3))]))
    assert m.volumes.sum() > 10
    assert np.isclose(m.voronoi.shares.sum(), m.volumes.sum(), rtol=1e-12)
    # The hull of the inputs is their box.
    for extent in ("hull", "box"):
        placements, part = m.placements(extent), m.part(extent)
        inside = placements == netmesh.Placement.INSIDE
        assert (part.simplices == np.flatnonzero(inside)).all()
        corners = m.points[m.simplices]
        in_box = ((corners >= 0) & (corners <= 1)).all(axis=(1, 2))
        assert (inside == in_box).all() and 0 < part.volumes.sum() < 1
        wide = m.part(extent, across=True)
        assert wide.volumes.sum() > 1
        across = placements == netmesh.Placement.ACROSS
        assert (wide.simplices == np.flatnonzero(inside | across)).all()
        assert (part.volumes == m.volumes[inside]).all()
        assert (part.circumcenters == m.circumcenters[inside]).all()
        assert set(part.hull.simplices) <= set(part.simplices) and len(part.edges) < len(m.edges)
        assert len(part.vertex_simplices.indptr) == len(m.points) + 1
        assert rows(part.hull.vertices) <= rows(part.facets.vertices)
        assert np.isclose(part.voronoi.shares.sum(), part.volumes.sum(), rtol=1e-9)
    part.export(tmp_path / "part.npy")
    assert rows(np.load(tmp_path / "part.npy")) == rows(m.points[np.unique(m.simplices[inside])])
    with pytest.raises(ValueError, match="^extent is 'ball'; it must be 'all' or 'hull' or 'box'"):
        m.part("ball")
    with pytest.raises(ValueError, match="^extent is 'all'; it must be 'hull' or 'box'"):
        m.placements("all")


def test_domains_of_a_mesh():
    random = np.random.default_rng(3)
    points = np.concatenate([random.random((20, 2)), 0.5 + 1e-6 * random.random((20, 2))])
    m = netmesh.mesh(points)
    assert len(m.domains) > 1
    whole, inner = m.part(domain=0), m.part(domain=1)
    assert (whole.simplices == np.arange(len(m.simplices))).all()
    assert 0 < len(inner.simplices) < len(m.simplices)
    vertices = np.unique(m.simplices[inner.simplices])
    lengths = np.linalg.norm(m.points[vertices] - m.points[m.domains[1]["center"]], axis=1)
    assert (lengths <= m.domains[1]["radius"]).all()
    with pytest.raises(netmesh.InvalidArgumentError, match=f"^domain is {len(m.domains)}; the mesh"):
        m.part(domain=len(m.domains))
    with pytest.raises(netmesh.InvalidArgumentError, match="^domain is -1; it must be 0 to"):
        m.part(domain=-1)
