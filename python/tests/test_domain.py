"""`domain`: what other packages and files have becomes a mesh, beside their own areas and volumes."""

import dataclasses
import json
import pathlib
import sys
import warnings

import numpy as np
import pytest

import netmesh

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
LAKE = [(1, 1), (3, 1), (3, 3), (1, 3)]
ISLAND = [(1.5, 1.5), (2.5, 1.5), (2.5, 2.5), (1.5, 2.5)]
SURFACES = pathlib.Path(__file__).parents[3] / "shared" / "data" / "surfaces"


def area(domain, **options):
    return float(netmesh.mesh(domain, **options).volumes.sum())


def closed(ring):
    return [*ring, ring[0]]


def refused(call, kind=netmesh.InvalidArgumentError):
    with pytest.raises(kind) as error:
        call()
    return str(error.value)


def test_rings_are_inside_by_parity():
    assert area(netmesh.domain(SQUARE)) == pytest.approx(16, rel=1e-12)
    for rings in ([SQUARE, LAKE, ISLAND], [np.array(SQUARE), closed(LAKE), tuple(ISLAND)]):
        made = netmesh.domain(rings)
        assert area(made) == pytest.approx(16 - 4 + 1, rel=1e-12)
        assert made.markers.tolist() == [1] * 4 + [2] * 4 + [3] * 4
    assert netmesh.mesh(made).parameters["interior"] == "parity"
    # Winding and seeds by name.
    assert area(made, interior="seeds") == pytest.approx(16, rel=1e-12)


def test_equal_points_in_a_row_have_no_segment():
    made = netmesh.domain([(0, 0), (0, 0), (1, 0), (1, 1), (1, 1)])
    assert len(made.points) == 5 and made.segments.tolist() == [[1, 2], [2, 3], [4, 0]]
    assert area(made) == pytest.approx(0.5, rel=1e-12)


def test_geometries_of_shapely_have_their_areas():
    shapely = pytest.importorskip("shapely")
    polygon = shapely.Polygon(SQUARE, [LAKE])
    blob = shapely.Point(10, 10).buffer(2).difference(shapely.Point(11, 10).buffer(0.5))
    for geometry in (polygon, shapely.MultiPolygon([polygon, shapely.Polygon(ISLAND)]), blob):
        assert area(netmesh.domain(geometry)) == pytest.approx(geometry.area, rel=1e-12)
    both = shapely.GeometryCollection([polygon, shapely.LineString([(0.5, 0.5), (3.5, 0.5)]), shapely.Point(2, 3.5)])
    made = netmesh.domain(both)
    assert made.sides.tolist() == [True] * 8 + [False] and len(made.points) == 11
    mesh = netmesh.mesh(made)
    # The line is kept, and encloses nothing.
    on_line = mesh.segments[mesh.segment_parents == 8]
    assert len(on_line) and (mesh.points[on_line][..., 1] == 0.5).all()
    assert mesh.volumes.sum() == pytest.approx(12, rel=1e-12)


def test_tables_have_a_marker_for_each_row():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    rows = [shapely.Polygon(SQUARE, [LAKE]), None, shapely.Polygon(ISLAND)]
    series = geopandas.GeoSeries(rows)
    assert set(netmesh.domain(series).markers.tolist()) == {1, 3}
    # Dates are no JSON.
    import pandas

    table = geopandas.GeoDataFrame({"code": [7, 8, 9], "day": pandas.Timestamp("2026-01-01")}, geometry=rows)
    assert area(netmesh.domain(table)) == pytest.approx(series.area.sum(), rel=1e-12)
    assert netmesh.domain(table, markers="code").markers.tolist() == [7] * 8 + [9] * 4
    message = refused(lambda: netmesh.domain(table, markers="name"))
    assert message == "markers is 'name', which feature 0 has not; features must have it among their properties"


def test_geojson_and_files_of_it_are_one_domain(tmp_path):
    polygon = {"type": "Polygon", "coordinates": [closed(SQUARE), closed(LAKE)]}
    features = [{"type": "Feature", "properties": {"k": 5}, "geometry": polygon}]
    collection = {"type": "FeatureCollection", "features": features}
    path = tmp_path / "lake.geojson"
    path.write_text(json.dumps(collection))
    for thing in (polygon, features[0], collection, path, str(path)):
        made = netmesh.domain(thing)
        assert area(made) == pytest.approx(12, rel=1e-12) and set(made.markers.tolist()) == {1}
    assert set(netmesh.domain(collection, markers="k").markers.tolist()) == {5}

def test_files_have_properties_as_markers(tmp_path):
    def feature(number, ring):
        geometry = {"type": "Polygon", "coordinates": [closed(ring)]} if ring else None
        return {"type": "Feature", "properties": {"k": number, "name": "no number"}, "geometry": geometry}

    path = tmp_path / "lakes.GeoJSON"
    features = [feature(5, SQUARE), feature(6, None), feature(-7, LAKE)]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    assert netmesh.domain(path, markers="k").markers.tolist() == [5] * 4 + [-7] * 4
    assert netmesh.domain(path).markers.tolist() == [1] * 4 + [3] * 4
    message = refused(lambda: netmesh.domain(path, markers="code"))
    assert message == "markers is 'code', which feature 0 has not; features must have it among their properties"
    assert "the property 'name' has dtype" in refused(lambda: netmesh.domain(path, markers="name"))
    message = refused(lambda: netmesh.domain(tmp_path / "none.geojson", markers="k"), netmesh.FileError)
    assert "none.geojson: cannot open" in message
    text = tmp_path / "lake.wkt"
    text.write_text("POLYGON ((0 0, 4 0, 4 4, 0 0))")
    for name in (text, str(text)):
        message = refused(lambda: netmesh.domain(name, markers="k"))
        assert message == f"markers is 'k'; {text} has no properties by name, as files of GeoJSON have"


@pytest.mark.parametrize("end", [".gpkg", ".shp", ".fgb"])
def test_tables_in_files_are_those_of_geopandas(end, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    rows = [shapely.Polygon(SQUARE, [LAKE]), shapely.Polygon(ISLAND)]
    path = tmp_path / f"lakes{end}"
    geopandas.GeoDataFrame({"code": [7, 9]}, geometry=rows, crs="EPSG:3857").to_file(path)
    made = netmesh.domain(path, markers="code")
    assert sorted(made.markers.tolist()) == [7] * 8 + [9] * 4
    assert area(made) == pytest.approx(13, rel=1e-12)
    assert sorted(set(netmesh.domain(str(path)).markers.tolist())) == [1, 2]
    path.write_bytes(b"no table")
    assert refused(lambda: netmesh.domain(path), netmesh.FormatError).startswith(f"{path}: GeoPandas cannot read it: ")
    missing = tmp_path / f"missing{end}"
    assert refused(lambda: netmesh.domain(missing), netmesh.FileError).startswith(f"{missing}: GeoPandas cannot")


def test_tables_in_files_need_geopandas(monkeypatch):
    monkeypatch.setitem(sys.modules, "geopandas", None)
    message = refused(lambda: netmesh.domain("lakes.gpkg"), netmesh.FormatError)
    assert message == "lakes.gpkg: files of this kind are read by GeoPandas, which is not installed"


def test_dicts_of_triangle_keep_regions_holes_and_largest_areas():
    plain = {
        "vertices": SQUARE + LAKE,
        "segments": [[i, (i + 1) % 4 + i // 4 * 4] if i % 4 < 3 else [i, i // 4 * 4] for i in range(8)],
        "segment_markers": [[k] for k in range(10, 18)],
    }
    holed = netmesh.domain({**plain, "holes": [[2, 2]]})
    assert area(holed) == pytest.approx(12, rel=1e-12) and holed.markers.tolist() == list(range(10, 18))
    largest = 0.01
    made = netmesh.domain({**plain, "regions": [[2, 2, 7, largest], [0.5, 0.5, 3, -1]]})
    mesh = netmesh.mesh(made)
    inner = mesh.volumes[mesh.simplex_regions == 7]
    assert inner.sum() == pytest.approx(4, rel=1e-12) and inner.max() <= largest * (1 + 1e-12)
    assert mesh.volumes[mesh.simplex_regions == 3].max() > largest
    with pytest.warns(UserWarning, match="x has 'vertex_markers', which a domain has no place for"):
        netmesh.domain({**plain, "vertex_markers": [0] * 8})
    message = refused(lambda: netmesh.domain({**plain, "regions": [[2, 2, 7]]}))
    assert message == "x['regions'][0] has shape (3,); it must be (x, y, attribute, largest area)"


@pytest.mark.parametrize("name", ["A", "double_hex", "double_hex2", "double_hex3", "face"])
def test_triangles_own_examples_are_domains(name):
    triangle = pytest.importorskip("triangle")
    data = pathlib.Path(triangle.__file__).parent / "data"
    if not (data / f"{name}.poly").exists():
        pytest.skip(f"PyPI's triangle came without its example {name}")
    given = triangle.load(str(data), name)
    theirs = triangle.triangulate(given, "p")
    corners = theirs["vertices"][theirs["triangles"]]
    edges = corners[:, 1:] - corners[:, :1]
    expected = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]).sum() / 2
    assert area(netmesh.domain(data / f"{name}.poly")) == pytest.approx(expected, rel=1e-9)
    with pytest.warns(UserWarning, match="'vertex_(markers|attributes)'"):
        made = netmesh.domain(given)
    assert area(made) == pytest.approx(expected, rel=1e-9)


BOX = {
    "points": np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]),
    "quads": [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
}


def test_surfaces_of_trimesh_have_their_volumes():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=2)
    assert area(netmesh.domain(ball)) == pytest.approx(ball.volume, rel=1e-9)
    ball.face_attributes["side"] = (ball.triangles_center[:, 2] > 0).astype(int)
    made = netmesh.domain(ball, markers="side")
    assert set(made.facet_markers.tolist()) == {0, 1}
    assert refused(lambda: netmesh.domain(ball, markers="top")) == "markers is 'top'; x.face_attributes has 'side'"


def test_polydata_of_pyvista_are_facets_and_lines():
    pyvista = pytest.importorskip("pyvista")
    for box in (pyvista.Box((0, 2, 0, 1, 0, 1)), pyvista.Box((0, 2, 0, 1, 0, 1)).triangulate()):
        made = netmesh.domain(box)
        assert len(made.facets) == box.n_cells and area(made) == pytest.approx(2, rel=1e-12)
    faces = np.concatenate([[4, *quad] for quad in BOX["quads"]])
    mixed = pyvista.PolyData(BOX["points"], faces=faces, lines=[2, 0, 7])
    mixed.cell_data["m"] = [20, 1, 2, 3, 4, 5, 6]
    made = netmesh.domain(mixed, markers="m")
    assert made.segments.tolist() == [[0, 7]] and made.markers.tolist() == [20]
    assert made.facet_markers.tolist() == [1, 2, 3, 4, 5, 6]
    mesh = netmesh.mesh(made)
    assert mesh.volumes.sum() == pytest.approx(2, rel=1e-12) and len(mesh.segments)
    grid = pyvista.ImageData(dimensions=(2, 2, 2)).cast_to_unstructured_grid()
    assert "its extract_surface() makes one" in refused(lambda: netmesh.domain(grid))
    strip = pyvista.PolyData(BOX["points"], strips=[4, 0, 1, 2, 3])
    assert "its triangulate() makes triangles" in refused(lambda: netmesh.domain(strip))


def test_meshes_of_meshio_are_facets_and_lines():
    meshio = pytest.importorskip("meshio")
    box = meshio.Mesh(BOX["points"], [("quad", BOX["quads"])], cell_data={"gmsh:physical": [list(range(6))]})
    made = netmesh.domain(box)
    assert made.facet_markers.tolist() == list(range(6)) and area(made) == pytest.approx(2, rel=1e-12)
    mixed = meshio.Mesh(BOX["points"], [("quad", BOX["quads"][:3]), ("triangle", [[2, 3, 7], [2, 7, 6]]),
                                        ("quad", BOX["quads"][4:]), ("tetra", [[0, 1, 2, 4]])])
    with pytest.warns(UserWarning, match="x has cells of the kinds tetra, which are left out"):
        made = netmesh.domain(mixed)
    assert len(made.facets) == 7 and area(made) == pytest.approx(2, rel=1e-12)
    flat = meshio.Mesh([(x, y, 0) for x, y in SQUARE], [("line", [[0, 1], [1, 2], [2, 3], [3, 0]])],
                       cell_data={"side": [[4, 5, 6, 7]]})
    made = netmesh.domain(flat, markers="side")
    assert made.points.shape == (4, 2) and made.markers.tolist() == [4, 5, 6, 7] and area(made) == pytest.approx(16)


def test_files_of_surfaces_are_domains(tmp_path):
    path = tmp_path / "tetrahedron.off"
    path.write_text("OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
    made = netmesh.domain(path)
    assert made.facets.shape == (4, 3) and area(made) == pytest.approx(1 / 6, rel=1e-12)
    assert netmesh.intersections(made) == [] and netmesh.odd_edges(made) == []
    assert len(netmesh.close_holes(dataclasses.replace(made, facets=made.facets[1:], facet_markers=None))) == 1
    points = tmp_path / "mesh.mesh"
    netmesh.mesh(SQUARE).export(points)
    with pytest.warns(UserWarning, match="left out are .* faces; its points are taken"):
        assert netmesh.domain(points).segments is None


def test_a_poly_of_tetgen_has_regions_and_holes():
    path = SURFACES / "made" / "two_cubes.poly"
    if not path.exists():
        pytest.skip(f"no {path}")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made = netmesh.domain(path)
    assert made.points.shape[1] == 3 and len(made.facets)
    assert set(netmesh.mesh(made).simplex_regions.tolist()) >= {int(one[3]) for one in made.regions}


def test_a_domain_takes_further_regions_and_holes_but_no_other_boundary():
    made = netmesh.domain([SQUARE, LAKE])
    assert area(dataclasses.replace(made, sides=None), holes=[[2, 2]]) == pytest.approx(12)
    both = netmesh.mesh(dataclasses.replace(made, sides=None, regions=[(0.5, 0.5, 1)]), regions=[(2, 2, 9)])
    assert set(both.simplex_regions.tolist()) == {1, 9}
    for name, value in {"segments": [[0, 1]], "facets": [[0, 1, 2]], "markers": [1], "facet_markers": [1]}.items():
        message = refused(lambda: netmesh.mesh(made, **{name: value}))
        assert message == f"{name} is given; points is a Domain, which has its own; dataclasses.replace changes them"
    message = refused(lambda: netmesh.mesh(dataclasses.replace(made, sides=[True])))
    assert message == "sides is of bool with shape (1,); it must be of bool, with the shape of the segments, (8,)"


def test_meshes_of_domains_are_pickled():
    import pickle

    made = netmesh.mesh(netmesh.domain([SQUARE, LAKE]))
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(made)).simplices, made.simplices)


@pytest.mark.parametrize(
    "thing, kind, expected",
    [
        (5, "InvalidArgument", "x is of type int; it must be a path"),
        (b"a.poly", "InvalidArgument", "x is of type bytes; it must be a path"),
        ([], "InvalidArgument", "x is empty; it must be a ring of points"),
        ([(0, 0), (1, 1)], "InvalidArgument", "x has 2 points; a ring must have 3 or more"),
        ([SQUARE, [(0, 0), (1, 1), (0, 0)]], "InvalidArgument", "x[1] has 2 points; a ring must have 3"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "InvalidArgument", "x has shape (3, 3); a ring must be (n, 2)"),
        ({"points": SQUARE}, "InvalidArgument", "x has no 'vertices'"),
        ({"type": "Polygon", "coordinates": [SQUARE]}, "Format", "x: feature 1: ring 1 begins at"),
        ({"type": "Polygon", "coordinates": []}, "Format", "x: it holds no points"),
        ({"type": "Point", "coordinates": [0, 0, 1]}, "Dimension", "x: a third coordinate, 1.0"),
        ({"type": "Point", "coordinates": {1}}, "InvalidArgument", "x is no GeoJSON: objects of type set"),
        ("missing.poly", "File", "missing.poly: cannot open"),
        ("points.docx", "InvalidArgument", "points.docx"),
    ],
)
def test_what_is_no_domain_is_refused(thing, kind, expected):
    message = refused(lambda: netmesh.domain(thing), getattr(netmesh, f"{kind}Error"))
    assert message.startswith(expected), message


def test_points_that_are_no_array_are_pointed_to_domain():
    for thing in ("part.stl", pathlib.Path("part.stl"), {"vertices": SQUARE}):
        assert "netmesh.domain makes a domain of other things" in refused(lambda: netmesh.mesh(thing))


def test_rings_and_sequences_of_geometries_are_domains():
    shapely = pytest.importorskip("shapely")
    assert area(netmesh.domain(shapely.LinearRing(SQUARE))) == pytest.approx(16, rel=1e-12)
    pieces = [shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 2)]
    for thing in (pieces, np.array(pieces), tuple(pieces)):
        made = netmesh.domain(thing)
        assert area(made) == pytest.approx(3, rel=1e-12) and made.markers.tolist() == [1] * 4 + [2] * 4


def test_planar_meshes_of_meshio_are_their_lines():
    meshio = pytest.importorskip("meshio")
    for points in ([[0.0, 0], [1, 0], [1, 1]], [[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]):
        cells = [("triangle", [[0, 1, 2]]), ("line", [[0, 1], [1, 2], [2, 0]])]
        with pytest.warns(UserWarning, match="x has cells of the kinds triangle, which are left out"):
            made = netmesh.domain(meshio.Mesh(points, cells))
        assert made.facets is None and area(made) == pytest.approx(0.5, rel=1e-12)


def test_words_and_numbers_of_a_wrong_kind_are_refused_by_name():
    assert repr(dataclasses.replace(netmesh.domain(SQUARE), points=[[0, 0], [1, 0], [1, 1], [0, 1]]))
    message = refused(lambda: netmesh.domain(SQUARE, markers=[5]), netmesh.ArgumentTypeError)
    assert message == "markers is of type list; it must be the name of the data that has them"
    without = netmesh.domain({"vertices": SQUARE, "segments": None, "holes": None, "regions": None})
    assert without.segments is None and len(without.points) == 4
    message = refused(lambda: netmesh.domain({"vertices": SQUARE, "segment_markers": [1]}))
    assert message == "x has 'segment_markers'; it must have the 'segments' that they are of"


def test_pickles_do_not_follow_arrays_that_change():
    import pickle

    points, sizes = np.random.default_rng(0).random((50, 2)), np.full(50, 0.3)
    ring = netmesh.domain(SQUARE)
    made, marked = netmesh.mesh(points, size=sizes), netmesh.mesh(ring)
    sizes *= 0.5
    ring.segments[:] = 0
    ring.markers[:] = 7
    assert len(pickle.loads(pickle.dumps(made)).points) == len(made.points)
    again = pickle.loads(pickle.dumps(marked))
    assert (again.segment_markers == marked.segment_markers).all() and set(again.segment_markers.tolist()) == {1}
