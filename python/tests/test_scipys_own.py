"""SciPy's own tests of `Delaunay`, `Voronoi`, `ConvexHull`, the interpolators and `griddata`, from its
wheel, run against netmesh. What differs is listed in `DIFFERENCES` with its reason, and must differ.
"""

import re
import types

import netmesh
import pytest

their_interpolation = pytest.importorskip("scipy.interpolate.tests.test_interpnd")
their_griddata = pytest.importorskip("scipy.interpolate.tests.test_ndgriddata")
their_qhull = pytest.importorskip("scipy.spatial.tests.test_qhull")

ORDER = "simplices come in another order, and start with another vertex"
QHULL = "QJ moves the points; here one that equals another is never a vertex"
FURTHEST = "furthest_site is not supported"
CORNERS = "corners come in another order, and there is no empty region for a point at infinity"
APART = "corners that are a rounding apart are two; Qhull merges them"
VISIBLE = "which facets see a point is not told"
EUCLIDEAN = "nearest is by the Euclidean distance alone"
FLAT = "Qhull merges some of the flattest simplices: 22 have no transform, of the exact ones 31"

#: By name, or a pattern of names with parameters.
DIFFERENCES = {
    "TestUtilities.test_find_simplex": ORDER,
    "TestUtilities.test_convex_hull": ORDER,
    "TestUtilities.test_degenerate_barycentric_transforms": FLAT,
    "TestDelaunay.test_2d_square": ORDER,
    "TestDelaunay.test_joggle": QHULL,
    "TestDelaunay.test_furthest_site": FURTHEST,
    "TestVoronoi.test_furthest_site": FURTHEST,
    "TestVoronoi.test_furthest_site_flag": FURTHEST,
    "TestVoronoi.test_simple": CORNERS,
    "TestVoronoi.test_point_region_structure*Qz*": CORNERS,
    "TestVoronoi.test_incremental*pathological-2-*": APART,
    "TestVoronoi.test_ridges*pathological-2*": APART,
    "TestNearestNDInterpolator.test_nearest_query_options": EUCLIDEAN,
    "TestConvexHull.test_good2d[[]*": VISIBLE,
    "TestConvexHull.test_good2d_incremental_changes*": VISIBLE,
    "TestConvexHull.test_good2d_inside*": VISIBLE,
    "TestConvexHull.test_good3d*": VISIBLE,
}

their_qhull.qhull = types.SimpleNamespace(
    Delaunay=netmesh.Delaunay,
    Voronoi=netmesh.Voronoi,
    ConvexHull=netmesh.ConvexHull,
    tsearch=lambda tri, x: tri.find_simplex(x),
)
their_qhull.Voronoi = netmesh.Voronoi
their_interpolation.qhull = their_qhull.qhull


def estimated_gradients(tri, values, **arguments):
    """The gradients of an interpolator, in the shape that SciPy's function has."""
    return netmesh.CloughTocher2DInterpolator(tri, values, **arguments).grad[:, 0]


their_interpolation.interpnd = types.SimpleNamespace(
    LinearNDInterpolator=netmesh.LinearNDInterpolator,
    CloughTocher2DInterpolator=netmesh.CloughTocher2DInterpolator,
    GradientEstimationWarning=netmesh.GradientEstimationWarning,
    estimate_gradients_2d_global=estimated_gradients,
)
for name in ("griddata", "NearestNDInterpolator", "LinearNDInterpolator", "CloughTocher2DInterpolator"):
    setattr(their_griddata, name, getattr(netmesh, name))
MODULES = (their_qhull, their_interpolation, their_griddata)


def taken(theirs):
    """A class of theirs without limits of time."""
    members = {}
    for name in dir(theirs):
        if not name.startswith("test_"):
            continue
        test = getattr(theirs, name)
        copied = types.FunctionType(
            test.__code__, test.__globals__, name, test.__defaults__, test.__closure__
        )
        marks = getattr(test, "pytestmark", [])
        copied.pytestmark = [mark for mark in marks if mark.name in ("parametrize", "slow")]
        members[name] = copied
    helpers = {n: getattr(theirs, n) for n in dir(theirs) if n.startswith("_") and n[1] != "_"}
    return type(theirs.__name__, (), {**helpers, **members})


TestUtilities = taken(their_qhull.TestUtilities)
TestVertexNeighborVertices = taken(their_qhull.TestVertexNeighborVertices)
TestDelaunay = taken(their_qhull.TestDelaunay)
TestVoronoi = taken(their_qhull.TestVoronoi)
TestConvexHull = taken(their_qhull.TestConvexHull)
TestLinearNDInterpolation = taken(their_interpolation.TestLinearNDInterpolation)
TestEstimateGradients2DGlobal = taken(their_interpolation.TestEstimateGradients2DGlobal)
TestCloughTocher2DInterpolator = taken(their_interpolation.TestCloughTocher2DInterpolator)
TestGriddata = taken(their_griddata.TestGriddata)
TestNearestNDInterpolator = taken(their_griddata.TestNearestNDInterpolator)
TestNDInterpolators = taken(their_griddata.TestNDInterpolators)


def test_issue_8051():
    their_qhull.Test_Qhull().test_issue_8051()


def test_every_name_is_of_a_test():
    for name in DIFFERENCES:
        theirs, test = re.split(r"[*[]", name)[0].split(".")
        module = next(module for module in MODULES if hasattr(module, theirs))
        assert hasattr(getattr(module, theirs), test)
