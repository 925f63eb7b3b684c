"""Finite elements on the meshes of domains: what scikit-fem solves has the values of closed forms."""

import netmesh
import numpy as np
import pytest

skfem = pytest.importorskip("skfem")
from skfem.helpers import dot, grad  # noqa: E402
from skfem.models.poisson import laplace, mass, unit_load  # noqa: E402

# The largest value of the solution of -div grad u = 1 on the unit cube that is 0 on its sides: the
# sum of its Fourier series.
LARGEST = 0.0562128

BOUND = {"criterion": "radius_edge", "quality_bound": 2.0}


def elements(mesh, element=None):
    """Returns the basis of finite elements on the tetrahedra of a mesh."""
    tetrahedra = np.ascontiguousarray(mesh.simplices.T.astype(np.int64))
    whole = skfem.MeshTet(np.ascontiguousarray(mesh.points.T), tetrahedra)
    return skfem.Basis(whole, element or skfem.ElementTetP2())


@pytest.mark.parametrize("degrees", [0, 10])
def test_a_box_of_random_points_has_the_largest_value_of_the_cube(degrees):
    points = np.random.default_rng(1).random((400, 3))
    points = np.concatenate([points, [[0, 0, 0], [1, 1, 1], [0.5, 0.5, 0.5]]])
    mesh = netmesh.mesh(points, extent="box", min_dihedral=degrees, **BOUND)
    basis = elements(mesh)
    system = skfem.condense(laplace.assemble(basis), unit_load.assemble(basis), D=basis.get_dofs())
    assert skfem.solve(*system).max() == pytest.approx(LARGEST, rel=2e-3)


def test_quadratic_functions_are_exact_on_an_l():
    # Two legs of an L, whose corner has an edge of 270 degrees.
    profile = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    points = np.array([[x, y, z] for z in (0, 1) for x, y in profile], float)
    sides = [list(range(5, -1, -1)), list(range(6, 12))]
    sides += [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    mesh = netmesh.mesh(points, facets=sides, max_edge=0.4, **BOUND)
    assert mesh.volumes.sum() == pytest.approx(3, abs=1e-12)
    basis = elements(mesh)
    exact = (basis.doflocs**2).sum(axis=0)
    load = -6 * unit_load.assemble(basis)
    system = skfem.condense(laplace.assemble(basis), load, x=exact, D=basis.get_dofs())
    assert np.abs(skfem.solve(*system) - exact).max() < 1e-10


def test_heat_bends_where_two_materials_meet():
    points = np.array([[x, y, z] for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)], float)
    ends, wall = [[0, 1, 3, 2], [8, 10, 11, 9]], [[4, 5, 7, 6]]
    around = [[a, b, b + 4, a + 4] for first in (0, 4)
              for a, b in [(first, first + 1), (first + 1, first + 3), (first + 3, first + 2), (first + 2, first)]]
    mesh = netmesh.mesh(
        points,
        facets=ends + wall + around,
        facet_markers=[1, 2] + 9 * [0],
        regions=[(0.5, 0.5, 0.5, 1), (1.5, 0.5, 0.5, 4)],
        max_edge=0.3,
        **BOUND,
    )
    basis = elements(mesh, skfem.ElementTetP1())
    conducts = basis.with_element(skfem.ElementTetP0()).interpolate(mesh.simplex_regions.astype(float))
    flow = skfem.BilinearForm(lambda u, v, w: w.conducts * dot(grad(u), grad(v)))
    # 0 on the side with marker 1, and 5 on that with marker 2.
    held = [np.unique(mesh.facet_triangles[mesh.facet_parents == end]) for end in (0, 1)]
    start = np.zeros(len(mesh.points))
    start[held[1]] = 5
    system = skfem.condense(flow.assemble(basis, conducts=conducts), x=start, D=np.concatenate(held))
    found = skfem.solve(*system)
    # The flow is the same on both sides: 4 of the fall is in the first metre, and 1 in the second.
    x = mesh.points[:, 0]
    assert np.abs(found - np.where(x <= 1, 4 * x, 3 + x)).max() < 1e-12
    volume = unit_load.assemble(basis) @ np.ones(len(x))
    assert volume == pytest.approx(2, abs=1e-12) == mass.assemble(basis).sum()
