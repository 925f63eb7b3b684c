"""Meshes: arrays, options, errors."""

import copy
import gc
import mmap
import pickle
import re
import weakref

import netmesh
import numpy as np
import pytest


def test_the_arrays_fit_together(random):
    points = random.random((300, 3))
    m = netmesh.mesh(points)
    vertices, simplices = len(m.points), len(m.simplices)
    assert (m.dim, m.points.shape, m.points.dtype) == (3, (vertices, 3), np.float64)
    assert (m.simplices.shape, m.simplices.dtype) == ((simplices, 4), np.int32)
    assert (m.neighbors.shape, m.neighbors.dtype) == ((simplices, 4), np.int32)
    assert (m.kinds.shape, m.kinds.dtype) == ((vertices,), np.uint8)
    assert m.precision_limited.dtype == bool and m.precision_limited.shape == (vertices,)
    assert (m.points[:300] == points).all() and (m.input_vertices == np.arange(300)).all()
    assert set(m.kinds[:300]) == {netmesh.VertexKind.INPUT}
    assert set(m.kinds[300:]) == {netmesh.VertexKind.STEINER, netmesh.VertexKind.CAGE}
    assert m.simplices.min() == 0 and m.simplices.max() == vertices - 1
    edges = m.points[m.simplices[:, 1:]] - m.points[m.simplices[:, :1]]
    assert (np.linalg.det(edges) > 0).all()
    for s, row in enumerate(m.neighbors[:100]):
        for opposite, n in zip(m.simplices[s], row):
            if n != -1:
                assert s in m.neighbors[n]
                assert set(m.simplices[s]) - {opposite} <= set(m.simplices[n])
    root = m.domains[0]
    assert root["parent"] == -1 and root["radius"] > 0.5
    assert m.vertex_domains.max() < len(m.domains) and m.vertex_domains.min() == 0


def test_arrays_are_the_librarys_and_stay_as_they_are(random):
    m = netmesh.mesh(random.random((50, 2)))
    arrays = [m.points, m.simplices, m.neighbors, m.kinds, m.precision_limited, m.input_vertices]
    addresses = [array.ctypes.data for array in arrays]
    assert addresses[0] == m.points.ctypes.data and addresses[1] == m.simplices.ctypes.data
    for array in arrays:
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array.flags.writeable = True
    values = [array.copy() for array in arrays]
    gone = weakref.ref(m)
    del m
    gc.collect()
    assert gone() is None
    filler = [netmesh.mesh(random.random((50, 2))) for _ in range(20)]
    assert all((array == value).all() for array, value in zip(arrays, values))
    assert [array.ctypes.data for array in arrays] == addresses and filler


@pytest.mark.parametrize("dim", range(2, 9))
def test_every_dimension(dim, random):
    m = netmesh.mesh(random.random((dim + 3, dim)), algorithm="delaunay")
    assert m.dim == dim and m.validate() == (3, 0, m.validate().checked, None)


def layouts(points):
    n, dim = points.shape
    wide = np.full((n, dim + 3), np.nan)
    wide[:, :dim] = points
    sparse = np.full((2 * n, 2 * dim), np.nan)
    sparse[::2, ::2] = points
    unaligned = np.zeros(n, np.dtype([("pad", "u1"), ("x", "f8", (dim,))]))
    unaligned["x"] = points
    return {
        "columns first": np.asfortranarray(points),
        "first columns of more": wide[:, :dim],
        "backwards": points[::-1].copy()[::-1],
        "every other": sparse[::2, ::2],
        "not aligned": unaligned["x"],
        "not aligned, contiguous": np.frombuffer(b"." + points.tobytes(), offset=1).reshape(n, dim),
        "swapped bytes": points.astype(">f8"),
        "lists": points.tolist(),
        "objects": points.astype(object),
        "rows twice": np.repeat(points, 2, axis=0)[::2],
    }


def test_every_layout_of_the_points_makes_the_same_mesh(random):
    points = random.random((60, 3))
    expected = netmesh.mesh(points)
    for name, array in layouts(points).items():
        m = netmesh.mesh(array)
        assert (m.points == expected.points).all(), name
        assert (m.simplices == expected.simplices).all(), name
    narrow = netmesh.mesh(points.astype(np.float32))
    assert (narrow.points[:60] == points.astype(np.float32)).all()
    whole = netmesh.mesh(np.arange(20, dtype=np.int16).reshape(10, 2) ** 2 % 31)
    assert whole.points[3].tolist() == [5, 18]
    one = np.broadcast_to([1.0, 2.0], (5, 2))
    with pytest.raises(netmesh.DegenerateInputError, match="5 points, 1 of them distinct"):
        netmesh.mesh(one)


def test_the_points_are_copied(random):
    points = random.random((30, 2))
    m = netmesh.mesh(points)
    before = m.points.copy()
    points[:] = 7
    assert (m.points == before).all()


def test_equal_points_share_a_vertex():
    m = netmesh.mesh([[0, 0], [1, 0], [0.0, -0.0], [0, 1], [1, 0]], algorithm="delaunay")
    assert m.input_vertices.tolist() == [0, 1, 0, 2, 1] and len(m.points) == 3


OPTIONS = {
    "output": ("well_spaced", "'auto' or 'hierarchical' or 'well_spaced'"),
    "algorithm": ("svr", "'netmesh' or 'svr' or 'delaunay'"),
    "ordering": ("deterministic_net", "'sampled_net' or 'deterministic_net'"),
    "criterion": ("radius_edge", "'voronoi_aspect' or 'radius_edge'"),
    "quality_bound": (2.5, "[2.2, 100]"),
    "epsilon": (0.3, "[0.05, 0.6]"),
    "delta": (0.4, "[0.1, 1]"),
    "gamma": (0.25, "[0.01, 0.25]"),
    "yield_radius": (0.3, "[0.05, 1]"),
    "encroachment": (2.0, "[1, 4]"),
    "cage_scale": (0.5, "[0.3, 0.9]"),
    "root_scale": (4.0, "[2, 16]"),
    "seed": (5, None),
    "max_vertices": (100000, None),
    "threads": (2, None),
    "instruments": (True, None),
    "distance_ratio": (0.3, "[0.05, 1]"),
    "min_angle": (25.0, "[0.6, 33.7]"),
    "min_dihedral": (12.0, "[0, 22]"),
    "max_edge": (0.05, None),
    "gives_way": ("bound", "'angle' or 'bound'"),
    "extent": ("hull", "'auto' or 'all' or 'hull' or 'box' or 'boundary'"),
    "crossings": ("split", "'refuse' or 'split'"),
}


def clusters():
    """Points for which every option makes a difference."""
    random = np.random.default_rng(0)
    return (random.random((100, 1, 2)) + 0.01 * random.random((1, 5, 2))).reshape(-1, 2)


@pytest.mark.parametrize("name", OPTIONS)
def test_options_reach_the_library(name):
    points = clusters()
    if name in ("min_dihedral", "gives_way"):
        points = np.random.default_rng(1).random((300, 3))
    value, range_ = OPTIONS[name]
    others = {"output": "well_spaced"} if name in ("distance_ratio", "max_edge") else {}
    if name == "gives_way":
        others = {"min_dihedral": 22, "quality_bound": 3, "output": "hierarchical"}
    default, other = netmesh.mesh(points, **others), netmesh.mesh(points, **others, **{name: value})
    differs = default.points.shape != other.points.shape or (default.points != other.points).any()
    if name == "instruments":
        assert (default.stats.max_ply, other.stats.max_ply > 0) == (0, True)
    # A mesh depends neither on threads nor on room that it does not need.
    assert differs == (name not in ("threads", "max_vertices", "instruments", "crossings"))
    assert other.options[name] == value
    if range_:
        wrong = "Hierarchical" if isinstance(value, str) else 1000.0
        with pytest.raises(netmesh.InvalidArgumentError, match=f"^{name} is .*{re.escape(range_)}"):
            netmesh.mesh(points, **{name: wrong})


def test_a_smallest_angle(random):
    m = netmesh.mesh(random.random((200, 2)), min_angle=33, output="well_spaced")
    assert m.quality_histogram("smallest_angle", bins=[0, 32.9999, 60], hull=True)[0][0] == 0
    with pytest.raises(ValueError, match="^min_angle is 33 and quality_bound is 1.5; one of them"):
        netmesh.mesh(random.random((9, 2)), min_angle=33, quality_bound=1.5)
    with pytest.raises(ValueError, match="^min_angle is 33; it must be 0 in 3D"):
        netmesh.mesh(random.random((9, 3)), min_angle=33)


def test_numbers_of_options():
    points = [[0, 0], [1, 0], [0, 1]]
    for name in ("seed", "threads", "max_vertices"):
        for number in (-1, 2**64):
            with pytest.raises(ValueError, match=f"^{name} is {number}; it must be 0 to"):
                netmesh.mesh(points, **{name: number})
        with pytest.raises(TypeError, match=rf"^{name} is of type \w+; it must be a whole number"):
            netmesh.mesh(points, **{name: 1.5})
    with pytest.raises(ValueError, match="^epsilon is NaN"):
        netmesh.mesh(points, epsilon=np.nan)
    with pytest.raises(TypeError, match=r"^epsilon is of type \w+; it must be a number"):
        netmesh.mesh(points, epsilon="half")
    with pytest.raises(TypeError, match="epsilom"):
        netmesh.mesh(points, epsilom=0.5)
    netmesh.mesh(points, seed=np.uint64(2**64 - 1), epsilon=np.float32(0.5), threads=np.int8(2))


def test_bad_points():
    for points, error, text in [
        ([[0, 0], [1, np.nan]], netmesh.NonFiniteError, r"points\[1\] has a non-finite coordinate 1"),
        ([[0, 0], [np.inf, 1]], netmesh.NonFiniteError, r"points\[1\] .* 0: inf"),
        ([0, 1, 2], netmesh.InvalidArgumentError, r"points has shape \(3,\)"),
        (np.zeros((2, 2, 2)), netmesh.InvalidArgumentError, r"points has shape \(2, 2, 2\)"),
        ([[0], [1]], netmesh.DimensionError, r"points has shape \(2, 1\)"),
        (np.eye(9), netmesh.DimensionError, r"points has shape \(9, 9\)"),
        (np.zeros((0, 3)), netmesh.DegenerateInputError, "0 points"),
        (np.zeros((3, 0)), netmesh.DimensionError, r"\(3, 0\)"),
        ([[0, 0]], netmesh.DegenerateInputError, "1 points"),
        ([[0, 1j], [1, 0]], netmesh.InvalidArgumentError, "points is an array of complex128"),
        ([["a", "b"]], netmesh.InvalidArgumentError, "points is an array of"),
        ([[0, 0], [1]], ValueError, "homogeneous"),
        (np.ma.masked_less(np.eye(3), 1), netmesh.InvalidArgumentError, "^points has masked elements"),
    ]:
        with pytest.raises(error, match=text) as raised:
            netmesh.mesh(points)
        assert isinstance(raised.value, ValueError)


def test_more_points_than_ids():
    # Memory that nobody touches: 64 GiB of addresses.
    flags = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | getattr(mmap, "MAP_NORESERVE", 0x4000)
    try:
        memory = mmap.mmap(-1, 16 * 2**32, flags=flags)
    except OSError as error:
        pytest.skip(f"no 64 GiB of addresses: {error}")
    points = np.frombuffer(memory).reshape(-1, 2)
    message = r"^points has shape \(4294967295, 2\); at most 4294967294 points have ids"
    for make in (netmesh.mesh, netmesh.Delaunay):
        with pytest.raises(netmesh.CapacityError, match=message) as raised:
            make(points[:-1])
        assert isinstance(raised.value, ValueError)


def test_errors_are_what_python_calls_them_too():
    for error, base in [
        (netmesh.InvalidArgumentError, ValueError),
        (netmesh.FileError, OSError),
        (netmesh.OutOfMemoryError, MemoryError),
        (netmesh.LimitError, RuntimeError),
        (netmesh.StateError, RuntimeError),
    ]:
        assert issubclass(error, base) and issubclass(error, netmesh.Error)
    points = np.random.default_rng(0).random((100, 2))
    with pytest.raises(netmesh.LimitError, match="max_vertices"):
        netmesh.mesh(points, max_vertices=100)
    line = np.outer(np.arange(5), [1.0, 1.0])
    with pytest.raises(netmesh.DegenerateInputError, match="affine rank 1"):
        netmesh.mesh(line, algorithm="delaunay")
    with pytest.raises(netmesh.InvalidArgumentError, match="^level is 4"):
        netmesh.mesh(line).validate(4)
    with pytest.raises(TypeError, match="netmesh.mesh"):
        netmesh.Mesh()


def test_copies_and_pickles_are_the_same_mesh():
    points = clusters()
    m = netmesh.mesh(np.concatenate([points, points[:3]]), seed=3, quality_bound=2.5)
    assert copy.copy(m) is m and copy.deepcopy(m) is m
    other = pickle.loads(pickle.dumps(m))
    for name in ("points", "simplices", "neighbors", "domains", "input_vertices"):
        assert (getattr(m, name) == getattr(other, name)).all()
    assert other.options == m.options


def test_results_are_tuples_with_names(random):
    m = netmesh.mesh(random.random((200, 2)))
    stats, quality = m.stats, m.quality()
    assert stats.input_vertices == 200 and stats.rounds > 2 and stats.seconds > 0
    assert stats.input_vertices + stats.steiner_vertices + stats.cage_vertices == len(m.points)
    assert 1 < quality.mean_aspect < quality.worst_aspect <= quality.worst_aspect_anywhere <= 3
    assert quality._asdict()["precision_limited"] == 0
    report = m.validate()
    assert (report.level, report.violations, report.first) == (3, 0, None) and report.checked > 1000
    assert m.validate(1).level == 1


def test_export(tmp_path, random):
    m = netmesh.mesh(random.random((40, 2)))
    m.export(tmp_path / "mesh.npy")
    assert (np.load(tmp_path / "mesh.npy") == m.points).all()
    m.export(str(tmp_path / "mesh.any"), format="tetgen_node")
    assert (tmp_path / "mesh.any").read_text().startswith(str(len(m.points)))
    with pytest.raises(netmesh.InvalidArgumentError, match="extension"):
        m.export(tmp_path / "mesh.any")
    with pytest.raises(netmesh.InvalidArgumentError, match="^format is 'vtk'; it must be 'auto' or"):
        m.export(tmp_path / "mesh.vtu", format="vtk")
    with pytest.raises(OSError, match="No such file"):
        m.export(tmp_path / "nowhere" / "mesh.vtu")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mesh.any", "mesh.any.ele", "mesh.npy"]


def test_attributes_are_exported(tmp_path, random):
    m = netmesh.mesh(random.random((40, 2)))
    values = random.random((len(m.points), 3))
    m.export(tmp_path / "mesh.csv", attributes={"height": values[:, 0], "v": values})
    header, *lines = (tmp_path / "mesh.csv").read_text().split()
    names, table = header.split(","), [line.split(",") for line in lines]
    columns = {name: [row[at] for row in table] for at, name in enumerate(names)}
    assert [float(x) for x in columns["height"]] == values[:, 0].tolist()
    assert len(names) == 3 + 1 + 3 and len(lines) == len(values)
    part = m.part("hull")
    part.export(tmp_path / "part.csv", attributes={"height": values[:, 0]})
    lines = (tmp_path / "part.csv").read_text().split()[1:]
    vertices = np.unique(m.simplices[part.simplices])
    assert [float(line.split(",")[-1]) for line in lines] == values[vertices, 0].tolist()
    hint = r"^attributes\['height'\] has shape \(40,\); it must be .* extend_values makes them"
    with pytest.raises(ValueError, match=hint):
        m.export(tmp_path / "mesh.csv", attributes={"height": values[:40, 0]})
    m.export(tmp_path / "mesh.npy", attributes={"height": values[:, 0], "v": values})
    table = np.load(tmp_path / "mesh.npy")
    assert table.dtype.names == ("points", "kind", "height", "v")
    assert (table["points"] == m.points).all() and (table["kind"] == m.kinds).all()
    assert (table["height"] == values[:, 0]).all() and (table["v"] == values).all()
    for name, format in [("mesh.off", "auto"), ("mesh.csv", "xyz"), ("mesh.mesh", "auto")]:
        with pytest.raises(netmesh.InvalidArgumentError, match="holds no attributes; VTU, TetGen"):
            m.export(tmp_path / name, format, attributes={"height": values[:, 0]})
    for name in ("", "a b", "kind", 65 * "a"):
        with pytest.raises(netmesh.InvalidArgumentError, match="name"):
            m.export(tmp_path / "mesh.csv", attributes={name: values})


def box(count, dim=2):
    corners = np.stack(np.meshgrid(*[[0.0, 1.0]] * dim), axis=-1).reshape(-1, dim)
    return np.vstack([corners, np.random.default_rng(3).random((count, dim))])


def longest(mesh):
    """The longest edge and the largest circumradius over what size 0.05 allows, in the box."""
    corners = mesh.points[mesh.simplices]
    inside = ((corners >= 0) & (corners <= 1)).all(axis=(1, 2))
    sides = np.linalg.norm(corners[inside] - np.roll(corners[inside], 1, axis=1), axis=2)
    half = sides.sum(axis=1) / 2
    area = np.sqrt(half * (half[:, None] - sides).prod(axis=1))
    return sides.max(), (sides.prod(axis=1) / (4 * area)).max() * np.sqrt(3) / 0.05


def test_sizes():
    points = box(20)
    finished = {"output": "well_spaced"}
    plain = netmesh.mesh(points, **finished)
    edges = netmesh.mesh(points, max_edge=0.05, **finished)
    assert longest(edges)[0] <= 0.05
    asked = []

    def size(x):
        asked.append(x.copy())
        return 0.05

    called = netmesh.mesh(points, size=size, **finished)
    assert 0.9 < longest(called)[1] <= 1.0
    assert len(asked) <= len(called.points) and asked[0].shape == (2,)
    assert (np.array(asked) >= 0).all() and (np.array(asked) <= 1).all()
    for same in (0.05, np.full(len(points), 0.05), [0.05] * len(points)):
        other = netmesh.mesh(points, size=same, **finished)
        assert (other.points.shape, longest(other)[1] <= 1.0) == (called.points.shape, True)
    assert len(plain.points) < len(called.points) < len(edges.points)
    # Linear between the points.
    values = 0.02 + 0.1 * points[:, 0]
    linear = netmesh.mesh(points, size=values, **finished)
    function = netmesh.mesh(points, size=lambda x: 0.02 + 0.1 * x[0], **finished)
    assert abs(len(linear.points) / len(function.points) - 1) < 0.02
    assert linear.validate().level == 3


def test_sizes_on_a_background():
    points, finished = box(20), {"output": "well_spaced"}
    coarse = netmesh.mesh(box(40), **finished)
    assert coarse.sizes.shape == (0,)
    values = 0.05 + 0.1 * np.abs(coarse.points[:, 0])
    adapted = netmesh.mesh(points, background=(coarse, values), **finished)
    function = netmesh.mesh(points, size=lambda x: 0.05 + 0.1 * x[0], **finished)
    assert 0.9 < len(adapted.points) / len(function.points) < 1.1
    assert adapted.sizes.shape == (len(adapted.points),)
    assert adapted.sizes[: len(points)] == pytest.approx(0.05 + 0.1 * points[:, 0], abs=0.02)
    both = netmesh.mesh(points, background=(coarse, values), size=0.05, **finished)
    assert len(both.points) > len(adapted.points)
    again = pickle.loads(pickle.dumps(adapted))
    assert (again.points == adapted.points).all()


def test_a_background_that_cannot_be():
    points, finished = box(20), {"output": "well_spaced"}
    coarse = netmesh.mesh(points)
    for background in (coarse, (1, 2), (coarse,), "xy"):
        with pytest.raises(TypeError, match="^background is of type .*; it must be a Mesh and"):
            netmesh.mesh(points, background=background, **finished)
    count = len(coarse.points)
    for values, words in [
        ([0.1] * 3, rf"background has shape \(3,\); .* of {count} vertices of it"),
        ([0.0] * count, r"^background\[1\]\[0\] is 0"),
    ]:
        with pytest.raises(netmesh.InvalidArgumentError, match=words):
            netmesh.mesh(points, background=(coarse, values), **finished)
    solid = netmesh.mesh(np.random.default_rng(2).random((9, 3)))
    with pytest.raises(netmesh.DimensionError):
        netmesh.mesh(points, background=(solid, np.ones(len(solid.points))), **finished)


def test_sizes_that_cannot_be():
    points = box(20)
    finished = {"output": "well_spaced"}
    for size, words in [
        (0.0, "size is 0"),
        (-1, "size is -1"),
        (float("nan"), "size is NaN"),
        ([0.1] * 3, r"size has shape \(3,\); it must have one value for each of 24 points"),
        ([0.1] * 23 + [0.0], r"^size\[23\] is 0"),
        (lambda x: 0.0, "size answers 0 at"),
    ]:
        with pytest.raises(netmesh.InvalidArgumentError, match=words):
            netmesh.mesh(points, size=size, **finished)
    words = "^size is given; it does not go with output='hierarchical'"
    with pytest.raises(netmesh.InvalidArgumentError, match=words):
        netmesh.mesh(points, size=0.1, output="hierarchical")

    def fails(x):
        raise KeyError("no size")

    with pytest.raises(KeyError, match="no size"):
        netmesh.mesh(points, size=fails, **finished)
    with pytest.raises(TypeError):
        netmesh.mesh(points, size=lambda x: "small", **finished)


def test_auto_becomes_what_is_asked_for():
    points = box(20)
    became = {
        ("hierarchical", "all"): [{}, {"quality_bound": 2.5}, {"extent": "all"}],
        ("well_spaced", "all"): [
            {"min_angle": 20},
            {"max_edge": 0.2},
            {"size": 0.2},
            {"size": np.full(len(points), 0.2)},
            {"distance_ratio": 0.5},
            {"output": "well_spaced"},
        ],
        ("well_spaced", "hull"): [{"extent": "hull"}],
        ("hierarchical", "hull"): [{"extent": "hull", "output": "hierarchical"}],
    }
    for expected, asked in became.items():
        for options in asked:
            parameters = netmesh.mesh(points, **options).parameters
            assert (parameters["output"], parameters["extent"]) == expected, options
    options = set(netmesh.mesh.__kwdefaults__) - {"markers", "facet_markers", "regions", "holes", "size"}
    assert set(parameters) == options - {"background", "progress", "cutoff"}
    for asked in ({"size": 0.2}, {"size": np.full(len(points), 0.2)}):
        message = "^size is given; it does not go with output='hierarchical'$"
        with pytest.raises(netmesh.InvalidArgumentError, match=message):
            netmesh.mesh(points, output="hierarchical", **asked)


def test_an_angle_that_cages_break_is_counted():
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    hole = 500 + 0.1 * np.c_[np.cos(angle), np.sin(angle)]
    points = np.vstack([[[0, 0], [1000, 0], [1000, 1000], [0, 1000]], hole])
    ring = np.c_[np.arange(24), (np.arange(24) + 1) % 24] + 4
    given = points, np.vstack([[[0, 1], [1, 2], [2, 3], [3, 0]], ring])
    fine = netmesh.mesh(*given, interior="parity", min_angle=25)
    assert fine.quality().min_angle_degrees >= 25 and fine.quality().below_min_angle == 0
    caged = netmesh.mesh(*given, interior="parity", min_angle=25, output="hierarchical")
    assert caged.quality().min_angle_degrees < 25 and caged.quality().below_min_angle > 0
