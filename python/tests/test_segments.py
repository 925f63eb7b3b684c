"""Segments and regions in the plane."""

import pickle

import netmesh
import numpy as np
import pytest

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]


def test_segments_become_chains_of_edges():
    mesh = netmesh.mesh(SQUARE, SIDES + [[0, 2]], markers=[5, 6, 7, 8, 9])
    edges, parents = mesh.segments, mesh.segment_parents
    assert edges.shape == (len(parents), 2) and edges.dtype == np.int32
    for parent, (start, end) in enumerate(SIDES + [[0, 2]]):
        chain = edges[parents == parent]
        assert chain[0, 0] == start and chain[-1, 1] == end
        assert (chain[1:, 0] == chain[:-1, 1]).all()
    sides = np.sort(mesh.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert {tuple(edge) for edge in np.sort(edges, axis=1)} <= {tuple(side) for side in sides}


def test_regions_have_labels():
    regions = [(0.75, 0.25, 4), (0.25, 0.75, -2, 0.5)]
    mesh = netmesh.mesh(SQUARE, SIDES + [[0, 2]], regions=regions, output="well_spaced")
    x, y = mesh.points[mesh.simplices].mean(axis=1).T
    inside = (x > 0) & (y > 0) & (x < 1) & (y < 1)
    assert (mesh.simplex_regions == np.where(inside, np.where(x > y, 4, -2), 0)).all()


def test_without_segments_there_is_nothing():
    mesh = netmesh.mesh(SQUARE)
    assert mesh.segments.shape == (0, 2) and mesh.simplex_regions.shape == (0,)


def test_a_copy_by_pickle_has_the_segments():
    mesh = netmesh.mesh(SQUARE, SIDES, holes=[[9, 9]], extent="all")
    assert area(mesh) == pytest.approx(1)
    again = pickle.loads(pickle.dumps(mesh))
    assert (again.segments == mesh.segments).all() and (again.points == mesh.points).all()


def area(mesh):
    a, b, c = mesh.points[mesh.simplices].transpose(1, 0, 2)
    (x, y), (z, w) = (b - a).T, (c - a).T
    return ((x * w - y * z) / 2).sum()


def test_curves_tell_what_is_inside():
    # Squares in squares, the third in the other direction.
    squares = [np.array(SQUARE) * (5 - ring) + ring / 2 for ring in range(4)]
    rings = [np.array(SIDES) + 4 * ring for ring in range(4)]
    rings[2] = rings[2][:, ::-1]
    given = np.vstack(squares), np.vstack(rings)
    inside = {"extent": "boundary", "output": "well_spaced"}
    assert area(netmesh.mesh(*given, **inside)) == pytest.approx(25)
    parity = netmesh.mesh(*given, interior="parity", **inside)
    assert area(parity) == pytest.approx(25 - 16 + 9 - 4)
    assert parity.validate().violations == 0 and parity.options["interior"] == "parity"
    winding = netmesh.mesh(*given, interior="winding", holes=[[0.25, 0.25]], **inside)
    assert area(winding) == pytest.approx(16)
    again = pickle.loads(pickle.dumps(parity))
    assert (again.simplices == parity.simplices).all()
    messages = {
        "parity": "^input 0 is an end of 1 segments; with interior='parity' that number",
        "winding": "^input 0 is the first end of 1 segments and the second end of 0; with",
        "seeds": "^segments enclose nothing, with extent='boundary' and interior='seeds';",
        "odd": "^interior is 'odd'; it must be 'auto' or 'seeds' or 'parity' or 'winding'",
    }
    for interior, message in messages.items():
        with pytest.raises(netmesh.InvalidArgumentError, match=message):
            netmesh.mesh(SQUARE, SIDES[:3], interior=interior, **inside)
    with pytest.raises(netmesh.InvalidArgumentError, match="^interior='parity' does not go with extent='all'"):
        netmesh.mesh(SQUARE, SIDES, interior="parity", extent="all")


def test_forced_triangles_are_counted_apart():
    angles = 0.3 + 0.01 * 1.5 ** np.arange(8)
    rays = 0.5 + 0.4 * np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.vstack([SQUARE, [[0.5, 0.5]], rays])
    segments = SIDES + [[4, end] for end in range(5, 13)]
    quality = netmesh.mesh(points, segments, extent="boundary", min_angle=25).quality()
    assert quality.forced > 0 and 0 < quality.least_forced_angle_degrees < 1
    assert quality.min_angle_degrees > 25 - 1e-6
    plain = netmesh.mesh(SQUARE, SIDES, extent="boundary").quality()
    assert (plain.forced, plain.least_forced_angle_degrees) == (0, 0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"segments": [[0, 1, 2]]}, "segments has shape (1, 3); it must be (segments, 2)"),
        ({"segments": [[0.0, 1.0]]}, "segments has dtype float64; it must be of whole numbers"),
        ({"segments": [[0, 1], [2, -1]]}, "segments[1] has the end -1;"),
        ({"segments": [[0, 1], [2, 4]]}, "segments[1] has the end 4;"),
        ({"segments": [[1, 1]]}, "segments[0] has input 1 as both ends;"),
        ({"segments": SIDES, "markers": [1]}, "markers has shape (1,); it must be"),
        ({"segments": [[0, 1]], "markers": [2**40]}, "markers[0] is 1099511627776;"),
        (
            {"segments": [[0, 2], [1, 3]]},
            "segments[0] and segments[1] cross near (0.5, 0.5), where no input is; with "
            "crossings='split' they are split there",
        ),
        (
            {
                "segments": SIDES + [[0, 2]],
                "regions": [(0.75, 0.25, 1)],
                "holes": [(0.2, 0.7), (0.5, 0)],
            },
            "holes[1] is on segments[0]; it must be in the interior of a region",
        ),
        ({"segments": SIDES, "algorithm": "svr"}, "algorithm='svr' goes neither with segments"),
        ({"extent": "boundary"}, "extent='boundary' needs segments; the mesh has none"),
        ({"regions": [(1, 2)]}, "regions[0] has 2 values;"),
        ({"regions": [(0, 0, 1.5)]}, "regions[0] has the label 1.5;"),
        ({"regions": [(0.5, 0.5, 1, -3)]}, "regions[0].max_edge is -3;"),
        ({"holes": [[1, 2, 3]]}, "holes[0] has 3 coordinates;"),
    ],
)
def test_what_cannot_be_is_refused(given, message):
    with pytest.raises(netmesh.InvalidArgumentError) as error:
        netmesh.mesh(SQUARE, **given)
    assert str(error.value).startswith(message)


def test_seeds_that_name_no_region_are_refused_by_their_names():
    points = SQUARE + [[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]]
    segments = SIDES + [[4, 5], [5, 6], [6, 7], [7, 4]]

    def refusal(**given):
        with pytest.raises(netmesh.InvalidArgumentError) as error:
            netmesh.mesh(points, segments, extent="boundary", **given)
        return str(error.value)

    label = (0.1, 0.5, 3)
    outside = "(2.0, 0.5), outside of all that segments enclose;"
    assert refusal(holes=[[0.5, 0.5], [2, 0.5]]).startswith(f"holes[1] is {outside}")
    assert refusal(regions=[label, (2, 0.5, 1)]).startswith(f"regions[1] is {outside}")
    assert refusal(regions=[label], holes=[[2, 0.5]]).startswith(f"holes[0] is {outside}")
    same = refusal(regions=[label], holes=[[0.5, 0.5], [0.1, 0.6]])
    assert same.startswith("holes[1] is in the same region as regions[0];")
    assert refusal(regions=[label], holes=[[0.5, 0.25]]).startswith("holes[0] is on segments[4];")
