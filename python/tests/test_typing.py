"""Words that no option has are found by a checker of types, before anything runs."""

import os
import pathlib
import re
import sysconfig

import numpy as np
import pytest

import netmesh

RIGHT = """
import netmesh

m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], output="well_spaced", extent="hull")
inside = m.part("hull").volumes
at = m.interpolate(m.points[:, 0], [[0.2, 0.2]], interpolation="sibson", outside="nearest")
counts, edges = m.quality_histogram("smallest_angle")
where = m.nearest([[0.2, 0.2]], among="inputs")[0]
alpha = m.filtration("mesh")
domain: netmesh.Domain = netmesh.domain([(0, 0), (1, 0), (0, 1)])
values = netmesh.griddata([[0, 0], [1, 0], [0, 1]], [1, 2, 3], [[0.2, 0.2]], method="cubic", outside="nearest")
"""

#: Arrays by the types that a script expects of them.
ARRAYS = """
import numpy as np
from numpy.typing import NDArray
import netmesh

m = netmesh.mesh([[0, 0], [1, 0], [0, 1]], algorithm="delaunay")
tri = netmesh.Delaunay(m.points)
vor = netmesh.Voronoi(m.points)
hull = netmesh.ConvexHull(m.points)
alpha = m.filtration("alpha")
doubles: list[NDArray[np.float64]] = [
    m.points, m.sizes, m.volumes, m.circumcenters, m.circumradii, m.part().points, m.nearest([[0, 0]])[1],
    alpha.points, alpha.values(0), tri.points, tri.equations, tri.transform, tri.min_bound, vor.vertices,
    hull.points, hull.equations, netmesh.offset_hull([[0, 0]], 1), netmesh.merge_points([[0, 0], [1, 1]]),
    m.quality_histogram()[1],
]
ids: list[NDArray[np.int32]] = [
    m.simplices, m.cells, m.neighbors, m.edges, m.hull.vertices, m.facets.simplices, m.input_vertices,
    m.vertex_inputs, m.representatives, m.segments, m.segment_parents, m.segment_markers, m.facet_triangles,
    m.facet_parents, m.facet_markers, m.facet_simplices, m.simplex_regions, m.vertex_domains,
    m.vertex_simplices.indices, m.part().cells, m.part().vertices, m.locate([[0, 0]]), m.nearest([[0, 0]])[0],
    alpha.faces(1), alpha.facets(1), alpha.cofaces(0).indices, tri.simplices, tri.neighbors, tri.coplanar,
    tri.convex_hull, tri.vertex_to_simplex, tri.find_simplex([[0, 0]]), vor.ridge_points, hull.simplices,
    hull.neighbors, hull.vertices, hull.coplanar, netmesh.representatives([[0, 0]], 1),
]
numbers: list[NDArray[np.int64]] = [
    m.vertex_simplices.indptr, alpha.cofaces(0).indptr, m.quality_histogram()[0], vor.point_region,
]
bytes: list[NDArray[np.uint8]] = [m.kinds, m.placements(), m.part().kinds]
flags: list[NDArray[np.bool_]] = [m.precision_limited, m.voronoi.is_bounded, m.voronoi.is_ridge_bounded]
"""

#: Lines with one wrong word each.
WRONG = [
    'netmesh.mesh([[0, 0], [1, 0], [0, 1]], output="wellspaced")',
    'netmesh.mesh([[0, 0], [1, 0], [0, 1]], crossings="cut")',
    'm.part("convex")',
    'm.interpolate([0.0], [[0, 0]], outside="zero")',
    'm.quality_histogram("angle")',
    'm.nearest([[0, 0]], among="points")',
    'm.filtration("rips")',
    'm.placements("circle")',
    'netmesh.griddata(m.points, m.sizes, m.points, method="spline")',
    'netmesh.LinearNDInterpolator(m.points, m.sizes, outside="zero")',
]


def errors_of(script, folder):
    api = pytest.importorskip("mypy.api")
    path = folder / "script.py"
    path.write_text(script)
    package = str(pathlib.Path(netmesh.__file__).parents[1])
    before = os.environ.pop("MYPYPATH", None)
    # What mypy reads it finds beside itself, which it refuses to be told, or where that path leads.
    if package not in {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}:
        os.environ["MYPYPATH"] = package
    try:
        out, complaints, _ = api.run(["--strict", "--follow-imports=silent", "--cache-dir", str(folder), str(path)])
    finally:
        os.environ.pop("MYPYPATH", None)
        if before is not None:
            os.environ["MYPYPATH"] = before
    assert not complaints, complaints
    # Its last line; without it nothing was checked.
    assert re.search(r"(no issues found in|checked) 1 source file", out), out
    return re.findall(r"script\.py:(\d+): error: (.*)", out)


def test_right_words_have_no_error_and_each_wrong_one_has_one(tmp_path):
    assert errors_of(RIGHT, tmp_path) == []
    lines = ["import netmesh", "m = netmesh.mesh([[0, 0], [1, 0], [0, 1]])", *WRONG]
    found = errors_of("\n".join(lines) + "\n", tmp_path)
    assert [int(line) for line, _ in found] == list(range(3, 3 + len(WRONG))), found
    assert all("Literal" in message for _, message in found), found


def test_arrays_have_the_types_that_they_are_annotated_with(tmp_path):
    assert errors_of(ARRAYS, tmp_path) == []
    wrong = ARRAYS.replace("[np.float64]]", "[np.int32]]", 1)
    found = [message for _, message in errors_of(wrong, tmp_path)]
    assert len(found) >= 19 and all("incompatible type" in message for message in found), found
    made = {}
    exec(ARRAYS, made)
    for name, dtype in {"doubles": "f8", "ids": "i4", "numbers": "i8", "bytes": "u1", "flags": "?"}.items():
        kinds = [array.dtype for array in made[name]]
        assert kinds == [np.dtype(dtype)] * len(kinds), name
