"""`Voronoi` beside SciPy's."""

import netmesh
import numpy as np
import pytest

scipy = pytest.importorskip("scipy")


def ridges(vor, fewest=0):
    """The corners of each ridge as points, by the points that it lies between."""

    def corners(ids):
        return sorted(tuple(np.round(vor.vertices[i], 6) + 0.0) for i in ids if i >= 0), -1 in ids

    pairs = np.sort(vor.ridge_points, axis=1).tolist()
    all_ = zip(pairs, vor.ridge_vertices)
    return {tuple(pair): corners(ids) for pair, ids in all_ if len(ids) >= fewest}


def check_alike(points):
    ours, theirs = netmesh.Voronoi(points), scipy.spatial.Voronoi(points)
    mesh = netmesh.Delaunay(points).mesh
    assert len(ours.vertices) == len(theirs.vertices)
    # Qhull leaves out unbounded ridges with fewer corners, the one at infinity included.
    assert ridges(ours, points.shape[1]) == ridges(theirs)
    for p in range(len(points)):
        region, their_region = (vor.regions[vor.point_region[p]] for vor in (ours, theirs))
        assert len(region) == len(their_region) and (-1 in region) == (-1 in their_region)
        corners = ours.vertices[[i for i in region if i >= 0]]
        lengths = np.linalg.norm(corners - points[p], axis=1)
        assert np.allclose(lengths, mesh.nearest(corners)[1], rtol=1e-6)
    return ours


@pytest.mark.parametrize("n, dim", [(200, 2), (80, 3), (30, 4), (14, 5)])
def test_the_same_diagram(n, dim, random):
    vor = check_alike(random.random((n, dim)))
    assert (vor.ndim, vor.npoints, vor.furthest_site) == (dim, n, False)
    assert vor.ridge_points.dtype == np.int32 and vor.point_region.dtype == np.int64


@pytest.mark.parametrize("dim, side", [(2, 6), (3, 4), (4, 3)])
def test_corners_of_a_lattice_are_one(dim, side):
    axes = np.meshgrid(*[np.arange(float(side))] * dim)
    points = np.stack(axes, axis=-1).reshape(-1, dim)
    # Qhull has ridges of lower dimension too in 4D.
    vor = check_alike(points) if dim < 4 else netmesh.Voronoi(points)
    # A cube has one corner inside; only points at distance 1 have a ridge.
    assert len(vor.vertices) == (side - 1) ** dim
    assert len(vor.ridge_points) == dim * (side - 1) * side ** (dim - 1)
    between = points[vor.ridge_points[:, 0]] - points[vor.ridge_points[:, 1]]
    assert (np.abs(between).sum(axis=1) == 1).all()


def test_other_cospherical_points(random):
    icosahedron = np.array(
        [np.roll([0, a, b * 1.5], k) for k in range(3) for a in (-1, 1) for b in (-1, 1)]
    )
    check_alike(np.concatenate([icosahedron, [[0.0, 0, 0], [4, 0, 0]]]))
    bipyramids = [[x, y, z] for z in (0.0, 2) for x in (0.0, 1, 3) for y in (0.0, 1)]
    check_alike(np.array(bipyramids))
    check_alike(np.array([[0.0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [1, 5]]))


def test_order(random):
    vor = netmesh.Voronoi(random.random((60, 2)))
    for p, region in enumerate(vor.regions[i] for i in vor.point_region):
        if -1 not in region:
            x, y = (vor.vertices[region] - vor.points[p]).T
            steps = np.diff(np.unwrap(np.arctan2(np.append(y, y[0]), np.append(x, x[0]))))
            assert (steps > 0).all() and np.isclose(steps.sum(), 2 * np.pi)
        else:
            assert region[0] == -1 and -1 not in region[1:]
    vor = netmesh.Voronoi(random.random((60, 3)))
    for (a, b), ridge in vor.ridge_dict.items():
        if -1 not in ridge:
            normal = vor.points[b] - vor.points[a]
            corners = vor.vertices[ridge]
            after = np.roll(corners, -1, axis=0)
            turns = np.cross(after - corners, np.roll(after, -1, axis=0) - after) @ normal
            assert (turns > 0).all() or (turns < 0).all()


def test_equal_points_share_a_region(random):
    points = random.random((20, 2))
    vor = netmesh.Voronoi(np.concatenate([points, points[4:5]]))
    assert vor.point_region[20] == vor.point_region[4] and len(vor.regions) == 20
    assert vor.ridge_points.max() == 19


def test_points_are_added(random):
    points = random.random((30, 2))
    vor = netmesh.Voronoi(points[:10], incremental=True)
    assert len(vor.ridge_dict) == len(vor.ridge_points)
    vor.add_points(points[10:])
    other = netmesh.Voronoi(points)
    assert ridges(vor) == ridges(other) and vor.ridge_dict == other.ridge_dict
    vor.close()
    with pytest.raises(netmesh.StateError):
        vor.add_points(points)
    with pytest.raises(ValueError, match="furthest_site"):
        netmesh.Voronoi(points, furthest_site=True)
