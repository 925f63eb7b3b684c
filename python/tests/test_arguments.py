"""One way in for arrays: what is refused of all of them, and how."""

import ast
import errno
import math
import pathlib
import pickle

import netmesh
import numpy as np
import pytest

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.25, 0.5]])
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]
# A square in a square, for what is between them and for the hole.
RINGS = {
    "points": [[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]],
    "segments": [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]],
    "extent": "boundary",
}


@pytest.fixture(scope="module")
def mesh():
    return netmesh.mesh(SQUARE)


def masked(values):
    """The same array with its first element masked."""
    values = np.asarray(values)
    mask = np.zeros(values.shape, bool)
    mask.flat[0] = True
    return np.ma.array(values, mask=mask)


# Each argument of the package that is an array, as a function that gives it, and an array that is right.
def entries(mesh):
    n, vertices, simplices = len(SQUARE), len(mesh.points), len(mesh.simplices)
    x, y = SQUARE.T
    tri = netmesh.Delaunay(SQUARE, incremental=True)
    f = netmesh.LinearNDInterpolator(SQUARE, x)
    sized = {"output": "well_spaced"}
    return {
        "points of mesh": (netmesh.mesh, SQUARE),
        "points of mesh, in rows": (lambda p: netmesh.mesh(list(p)), SQUARE),
        "segments": (lambda s: netmesh.mesh(SQUARE, s), SIDES),
        "markers": (lambda m: netmesh.mesh(SQUARE, SIDES, markers=m), [1, 2, 3, 4]),
        "regions": (lambda r: netmesh.mesh(**RINGS, regions=r), [[0.5, 0.5, 3]]),
        "holes": (lambda h: netmesh.mesh(**RINGS, holes=h), [[1.5, 1.5]]),
        "size": (lambda s: netmesh.mesh(SQUARE, size=s, **sized), np.full(n, 2.0)),
        "background": (
            lambda s: netmesh.mesh(SQUARE, background=(mesh, s), **sized),
            np.full(vertices, 2.0),
        ),
        "locate": (mesh.locate, SQUARE),
        "nearest": (mesh.nearest, SQUARE),
        "nearest among inputs": (lambda p: mesh.nearest(p, among="inputs"), SQUARE),
        "points of interpolate": (lambda p: mesh.interpolate(np.zeros(vertices), p), SQUARE),
        "values of interpolate": (lambda v: mesh.interpolate(v, SQUARE), np.zeros(vertices)),
        "extend_values": (mesh.extend_values, np.zeros(n)),
        "bins": (lambda b: mesh.quality_histogram(bins=b), [0.0, 90, 180]),
        "range": (lambda r: mesh.quality_histogram(range=r), [0.0, 90]),
        "attributes": (
            lambda v: mesh.export("/dev/null", "csv", attributes={"a": v}),
            np.zeros(vertices),
        ),
        "points of Delaunay": (netmesh.Delaunay, SQUARE),
        "find_simplex": (tri.find_simplex, SQUARE),
        "lift_points": (tri.lift_points, SQUARE),
        "plane_distance": (tri.plane_distance, SQUARE),
        "add_points": (tri.add_points, SQUARE + 2),
        "points of Voronoi": (netmesh.Voronoi, SQUARE),
        "points of LinearNDInterpolator": (lambda p: netmesh.LinearNDInterpolator(p, x), SQUARE),
        "an axis of LinearNDInterpolator": (lambda a: netmesh.LinearNDInterpolator((a, y), x), x),
        "values of LinearNDInterpolator": (lambda v: netmesh.LinearNDInterpolator(SQUARE, v), x),
        "fill_value": (lambda v: netmesh.LinearNDInterpolator(SQUARE, x, v), np.array(3.0)),
        "points of CloughTocher2DInterpolator": (lambda p: netmesh.CloughTocher2DInterpolator(p, x), SQUARE),
        "values of CloughTocher2DInterpolator": (lambda v: netmesh.CloughTocher2DInterpolator(SQUARE, v), x),
        "points of NearestNDInterpolator": (lambda p: netmesh.NearestNDInterpolator(p, x), SQUARE),
        "values of NearestNDInterpolator": (lambda v: netmesh.NearestNDInterpolator(SQUARE, v), x),
        "a call for the nearest": (netmesh.NearestNDInterpolator(SQUARE, x), SQUARE),
        "points of griddata": (lambda p: netmesh.griddata(p, x, SQUARE), SQUARE),
        "xi of griddata": (lambda p: netmesh.griddata(SQUARE, x, p, method="cubic"), SQUARE),
        "projector": (mesh.projector, SQUARE),
        "representatives": (lambda p: netmesh.representatives(p, 0.5), SQUARE),
        "offset_hull": (lambda p: netmesh.offset_hull(p, 0.5), SQUARE),
        "points of spatial_mesh": (lambda p: netmesh.spatial_mesh(p, max_edge=(1, 2), offset=(1, 2)), SQUARE),
        "max_edge of spatial_mesh": (
            lambda e: netmesh.spatial_mesh(SQUARE, max_edge=e, offset=(1, 2)),
            np.array([1.0, 2.0]),
        ),
        "a call": (f, SQUARE),
        "an axis of a call": (lambda a: f(a, 0.5), x),
        "alpha": (
            netmesh.mesh(SQUARE, algorithm="delaunay").filtration().shape,
            np.array(0.5),
        ),
    }


NAMES = list(entries(netmesh.mesh(SQUARE)))


def entry(name, mesh):
    if name == "projector":
        pytest.importorskip("scipy")
    return entries(mesh)[name]


@pytest.mark.parametrize("name", NAMES)
def test_masks_are_refused_everywhere(name, mesh):
    give, right = entry(name, mesh)
    give(right)
    give(np.ma.array(right))
    with pytest.raises(netmesh.InvalidArgumentError, match="has masked elements; fill or drop them"):
        give(masked(right))


@pytest.mark.parametrize("name", NAMES)
def test_ragged_rows_and_words_are_refused_everywhere(name, mesh):
    give, _ = entry(name, mesh)
    for wrong in ([[0.1, 0.2], [0.3]], ["a", "b"]):
        with pytest.raises(netmesh.Error) as refused:
            give(wrong)
        assert isinstance(refused.value, (ValueError, TypeError)), refused.value


def test_views_take_arrays_by_the_same_way(mesh):
    pytest.importorskip("meshio")
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^point_data\['h'\] has masked elements"):
        mesh.to_meshio({"h": masked(np.zeros(len(mesh.points)))})
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^cell_data\['h'\] has shape \(3,\)"):
        mesh.to_meshio(cell_data={"h": np.zeros(3)})


def test_masked_axes_are_no_points():
    # The number under the mask made a value of 25.75 once.
    x, y, v = np.ma.array([0, 1, 0, 1, 100.0], mask=[0, 0, 0, 0, 1]), [0, 0, 1, 1, 0.5], [0, 1, 2, 3, 100]
    with pytest.raises(netmesh.InvalidArgumentError, match=r"^points\[0\] has masked elements"):
        netmesh.LinearNDInterpolator((x, y), v)
    rows = list(zip(x, y))
    with pytest.raises(netmesh.InvalidArgumentError, match="^points has masked elements"):
        netmesh.mesh(rows)


def test_nothing_else_makes_arrays_of_arguments():
    """NumPy's functions that make arrays of anything are called in `_arrays.py` alone."""
    makers = {"asarray", "asanyarray", "array", "ascontiguousarray", "require", "atleast_1d", "shape", "ndim"}
    found = []
    for path in pathlib.Path(netmesh.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            is_call = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
            if is_call and ast.unparse(node.func.value) == "np" and node.func.attr in makers:
                found.append((path.name, ast.unparse(node)))
    assert {name for name, _ in found} == {"_arrays.py"}


BIG = 2**53 + 1


@pytest.mark.parametrize(
    "points, place",
    [
        ([[0, 0], [1, 0], [BIG, 1]], "2, 0"),
        ([[0, 0], [1, 0.5], [BIG, 1]], "2, 0"),
        ([[0.5, 0], [1, 0], [1, -BIG]], "2, 1"),
        (np.array([[0, 0], [1, 0], [BIG, 1]]), "2, 0"),
        (np.array([[0, 0], [1, 0], [BIG, 1]], np.uint64), "2, 0"),
        (np.array([[0, 0], [1, -(2**63) + 1], [3, 1]]), "1, 1"),
        (np.array([[0, 0], [1, 2**63 - 1], [3, 1]]), "1, 1"),
        (np.array([[0, 0], [1, 2**64 - 1], [3, 1]], np.uint64), "1, 1"),
        ([[0, 0], [1, 2**70 + 1], [3, 1]], "1, 1"),
        ([(0, 0), (2**63, -1), (BIG, 1)], "2, 0"),
    ],
)
def test_whole_numbers_are_not_rounded(points, place):
    with pytest.raises(netmesh.InvalidArgumentError, match=rf"^points\[{place}\] is -?\d+; whole numbers"):
        netmesh.mesh(points)
    with pytest.raises(netmesh.InvalidArgumentError, match=rf"^xi\[{place}\] is"):
        netmesh.Delaunay(SQUARE).find_simplex(points)


def test_whole_numbers_that_are_doubles_are_taken():
    for large in (2**53, 2**53 + 2, 2**62, 2**70, 3 * 2**80, -(2**63)):
        m = netmesh.mesh([[0, 0], [1, 0], [large, 1]])
        assert int(m.points[2, 0]) == large
    assert int(netmesh.mesh(np.array([[0, 0], [1, 0], [-(2**63), 1]])).points[2, 0]) == -(2**63)
    with pytest.raises(netmesh.InvalidArgumentError, match="^points must be an array of real numbers"):
        netmesh.mesh([[0, 0], [1, 0], [10**400, 1]])
    # A double that was one before is the caller's.
    assert netmesh.mesh([[0.0, 0], [1, 0], [float(BIG), 1]]).points[2, 0] == 2**53
    f = netmesh.LinearNDInterpolator(SQUARE, SQUARE[:, 0])
    with pytest.raises(netmesh.InvalidArgumentError, match=rf"^xi\[1\] is {BIG}"):
        f(0.5, BIG)
    with pytest.raises(netmesh.InvalidArgumentError, match=rf"^size is {BIG}"):
        netmesh.mesh(SQUARE, size=BIG, output="well_spaced")


def test_arrays_stay_read_only():
    m = netmesh.mesh(np.random.default_rng(1).random((30, 3)))
    part = m.part("hull")
    twice = np.concatenate([m.points, m.points[:3]])
    alpha = netmesh.mesh(twice, algorithm="delaunay").filtration()
    arrays = {name: getattr(m, name) for name in dir(type(m)) if name[0] != "_"}
    arrays.update({f"part.{name}": getattr(part, name) for name in dir(part) if name[0] != "_"})
    arrays.update({"faces": alpha.faces(1), "values": alpha.values(1), "points of alpha": alpha.points})
    found = []
    for name, value in arrays.items():
        for array in value if isinstance(value, tuple) else [value]:
            if not isinstance(array, np.ndarray) or array.dtype.names:
                continue
            found.append(name)
            base = array
            while isinstance(base, np.ndarray):
                assert not base.flags.writeable, name
                with pytest.raises(ValueError):
                    base.flags.writeable = True
                base = base.base
    expected = {"points", "edges", "circumcenters", "circumradii", "facets", "vertex_inputs", "voronoi"}
    assert expected <= set(found) and "part.edges" in found and len(found) > 25


def refused(call):
    with pytest.raises(netmesh.Error) as error:
        call()
    return str(error.value)


def test_errors_are_netmeshs_and_name_the_argument():
    points, values = SQUARE, SQUARE[:, 0]
    f = netmesh.LinearNDInterpolator(points, values)
    boundary = {"points": points, "segments": SIDES}
    mesh = netmesh.mesh
    expected = [
        (lambda: mesh([[0, 0], [1], [2, 2]]), "points is no array"),
        (lambda: f(0.5), "xi has shape (); it must be (..., 2)"),
        (lambda: f([0.5, 0.5, 0.5]), "xi has shape (3,); it must be (..., 2)"),
        (lambda: f([1, 2], [1, 2, 3]), "xi has the shapes (2,) and (3,); they must"),
        (lambda: f(1, 2, 3), "xi has shape (3,); it must be (..., 2)"),
        (lambda: f(), "xi has the shapes of no arrays"),
        (lambda: f("a", "b"), "xi[0] is an array of"),
        (lambda: mesh(**boundary, holes=[0.2, 0.2]), "holes has shape (2,); it must be (holes, 2)"),
        (lambda: mesh(**boundary, holes=7), "holes has shape (); it must be (holes, 2)"),
        (lambda: mesh(**boundary, regions=[(0.5, 0.5, math.nan)]), "regions[0] has the label nan;"),
        (lambda: mesh(**boundary, regions=[(0.5, 0.5, math.inf)]), "regions[0] has the label inf;"),
        (lambda: mesh(**boundary, regions=[0.5, 0.5, 1]), "regions[0] has shape (); it must be (x, y"),
        (lambda: mesh(**boundary, regions=5), "regions is 5; it must be a sequence"),
        (lambda: mesh(**boundary, regions=[("x", 0, 1)]), "regions[0] is an array of"),
        (lambda: mesh(points, np.array([[0, 2**64 - 1]], np.uint64)), "segments[0, 1] is 18446744073709551615,"),
        (lambda: mesh(points, size="fine", output="well_spaced"), "size is an array of"),
        (lambda: mesh(points, size=[[1.0]], output="well_spaced"), "size has shape"),
        (lambda: mesh(points, background=7, output="well_spaced"), "background is of type int"),
        (lambda: mesh(points, threads="two"), "threads is of type str"),
        (lambda: mesh(points, progress=3), "progress is of type int"),
        (lambda: netmesh.LinearNDInterpolator(points, values, [1, 2]), "fill_value has shape (2,)"),
        (lambda: netmesh.LinearNDInterpolator(points, values, 1j), "fill_value is an array of complex"),
        (lambda: mesh(points).quality_histogram(bins=0), "bins is 0; it must be at least 1"),
        (lambda: mesh(points).quality_histogram(bins=2.5), "bins is of type float"),
        (lambda: mesh(points).quality_histogram(range=(2, 1)), "range is (2.0, 1.0); it must ascend"),
        (lambda: mesh(points).quality_histogram(range=(0, math.nan)), "range is (0.0, nan)"),
    ]
    for call, message in expected:
        assert refused(call).startswith(message), (refused(call), message)


def test_none_is_no_number():
    for call in (
        lambda: netmesh.mesh([[0, 0], [1, 0], [None, 1]]),
        lambda: netmesh.LinearNDInterpolator(SQUARE, [0, 1, 2, None, 4]),
        lambda: netmesh.mesh(SQUARE).locate([[None, 0.5]]),
    ):
        assert "is an array of object; it must be real numbers" in refused(call)


def test_regions_may_be_an_array():
    regions = np.array([[0.75, 0.25, 4], [0.25, 0.75, -2]])
    m = netmesh.mesh(SQUARE[:4], SIDES + [[0, 2]], regions=regions)
    assert set(m.simplex_regions.tolist()) == {4, -2}
    assert len(netmesh.mesh(SQUARE, SIDES, regions=np.zeros((0, 3))).simplices) > 0


@pytest.mark.parametrize("answer", [[0.3], "wide", None, np.array(None)])
def test_sizes_that_are_no_numbers_are_refused(answer):
    message = refused(lambda: netmesh.mesh(SQUARE, size=lambda x: answer, output="well_spaced"))
    assert message.startswith("size answered ") and message.endswith("; it must be a number")
    for size in (np.float64(0.5), np.array(0.5), 1, np.float32(0.5), np.array([[0.5]])):
        m = netmesh.mesh(SQUARE, size=lambda x: size, output="well_spaced")
        assert len(m.points) > len(SQUARE)


def test_file_errors_have_number_and_path(tmp_path, mesh):
    alpha = netmesh.mesh(SQUARE, algorithm="delaunay").filtration()
    for write, name in [
        (mesh.export, "a.vtu"),
        (mesh.part("hull").export, "a.vtu"),
        (alpha.export, "a.filtration"),
        (alpha.shape().export, "a.ply"),
    ]:
        path = tmp_path / "missing" / name
        with pytest.raises(netmesh.FileError) as error:
            write(path)
        assert isinstance(error.value, OSError) and error.value.errno == errno.ENOENT
        assert error.value.filename == str(path) and str(error.value).startswith(f"{path}: cannot")
        again = pickle.loads(pickle.dumps(error.value))
        assert (again.errno, again.filename, str(again)) == (errno.ENOENT, str(path), str(error.value))
    with pytest.raises(OSError) as error:
        mesh.export(tmp_path, "vtu")
    assert error.value.errno == errno.EISDIR
