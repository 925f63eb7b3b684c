"""Triangle's own examples, and coasts and countries: what holds of their meshes, and how many
vertices Triangle has beside."""

import subprocess

import netmesh
import numpy as np
import peers_of_segments as peers
import pytest

pytest.importorskip("triangle", reason="PyPI's triangle is not installed")

EXAMPLES = ["A", "box", "double_hex", "double_hex2", "double_hex3", "face", "la", "square_circle_hole"]
MAPS = [("land-110m", 30), ("countries-110m", 20.7), ("countries-110m", 30), ("land-50m", 20.7)]


@pytest.fixture(scope="module")
def atlas(tmp_path_factory):
    try:
        return peers.fetch_atlas(tmp_path_factory.mktemp("atlas"))
    except (OSError, ValueError, subprocess.SubprocessError) as error:
        pytest.skip(f"cannot fetch {peers.ATLAS} by npm: {error}")


def check(points, segments, holes, angle, extent="boundary"):
    mesh = netmesh.mesh(
        points, segments, holes=holes, extent=extent, crossings="split",
        output="well_spaced", min_angle=angle,
    )
    report = mesh.validate()
    assert (report.level, report.violations) == (3, 0), report.first
    quality = mesh.quality()
    assert quality.min_angle_degrees >= angle - 1e-6
    assert mesh.stats.precision_limited == 0
    chains_are_whole(mesh, points, segments)
    return mesh


def chains_are_whole(mesh, points, segments):
    """The pieces of a segment are edges of the mesh, but those outside of the domain; together they
    are as long as it; and no vertex of it is off the segment by more than rounding."""
    edges = np.sort(mesh.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    count = len(mesh.points)
    numbers = np.unique(edges[:, 0].astype(np.int64) * count + edges[:, 1])
    own = np.sort(mesh.segments, axis=1)
    assert np.isin(own[:, 0].astype(np.int64) * count + own[:, 1], numbers).mean() > 0.99
    has_parent = mesh.segment_parents >= 0
    pieces, parents = mesh.segments[has_parent], mesh.segment_parents[has_parent]
    start, end = (points[segments[parents][:, at]] for at in (0, 1))
    way = end - start
    for at in (0, 1):
        off = mesh.points[pieces[:, at]] - start
        cross = off[:, 0] * way[:, 1] - off[:, 1] * way[:, 0]
        size = np.abs(points).max() * np.abs(way).sum(axis=1)
        assert (np.abs(cross) <= 8 * np.finfo(float).eps * size).all()
    lengths = np.linalg.norm(np.diff(mesh.points[pieces], axis=1)[:, 0], axis=1)
    whole = np.bincount(parents, lengths, len(segments))
    wanted = np.linalg.norm(points[segments[:, 1]] - points[segments[:, 0]], axis=1)
    # The first of segments that overlap has the pieces.
    assert (whole <= wanted * (1 + 1e-9)).all()
    assert np.isclose(whole, wanted).mean() > 0.99


@pytest.mark.parametrize("angle", [20.7, 30])
@pytest.mark.parametrize("name", EXAMPLES)
def test_triangles_examples(name, angle):
    points, segments, holes = peers.of_triangle(name)
    # Its outer sides are those of the hull.
    extent, more = ("hull", "Dc") if name == "box" else ("boundary", "D")
    mesh = check(points, segments, holes, angle, extent)
    conforming = peers.triangles_vertices(points, segments, holes, angle, more)
    if isinstance(conforming, int):
        assert len(mesh.points) <= 1.25 * conforming + 5


@pytest.mark.parametrize("name", ["greenland", "spiral", "ell", "bbox.1", "dots"])
def test_triangles_points(name):
    points, segments, holes = peers.of_triangle(name)
    for extent in ("hull", "box"):
        mesh = netmesh.mesh(points, extent=extent, output="well_spaced", min_angle=20.7)
        report = mesh.validate()
        assert (report.level, report.violations) == (3, 0), report.first
        assert mesh.quality().min_angle_degrees >= 20.7 - 1e-6


@pytest.mark.parametrize(("name", "angle"), MAPS)
def test_maps(atlas, name, angle):
    points, segments = peers.of_atlas(atlas[name])
    mesh = check(points, segments, np.empty((0, 2)), angle)
    beside = peers.triangles_vertices(points, segments, [], angle, timeout=20)
    print(f"{name}, {angle} degrees: {len(mesh.points)} vertices, Triangle {beside}")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["land-10m", "countries-10m"])
def test_large_maps(atlas, name):
    points, segments = peers.of_atlas(atlas[name])
    check(points, segments, np.empty((0, 2)), 20.7)
