"""A field from noisy measurements by a Gaussian Markov random field, as INLA does: spatial_mesh.py

The mesh is fine where there are data and coarse in a ring round them; a projector takes the field from
its vertices to the places of the data. Needs netmesh, numpy, scipy and scikit-fem.
"""
import netmesh
import numpy as np
import scipy.sparse.linalg
import skfem
from skfem.helpers import dot, grad

#: Distance at which the field's correlation is near a tenth, and its standard deviation.
RANGE, DEVIATION = 0.3, 1.0
NOISE = 0.1


def truth(places):
    x, y = places.T
    return np.sin(5 * x) * np.cos(4 * y) + 0.5 * np.cos(9 * x * y)


# [mesh]
def mesh_of(places):
    """Return the mesh, with edges of a fifth of the range inside, where no two vertices are nearer than
    a twentieth of it by reason of data alone."""
    return netmesh.spatial_mesh(
        places,
        max_edge=(RANGE / 5, RANGE),
        offset=(RANGE / 3, 1.5 * RANGE),
        cutoff=RANGE / 20,
    )
# [end]


# [matrices]
def precision_of(mesh):
    """Return the precision matrix of a Matern field (Lindgren, Rue, Lindstrom 2011), from the mass and
    stiffness matrices of scikit-fem."""
    points, triangles = (np.ascontiguousarray(of.T) for of in (mesh.points, mesh.simplices.astype(np.int64)))
    basis = skfem.Basis(skfem.MeshTri(points, triangles), skfem.ElementTriP1())
    mass = skfem.BilinearForm(lambda u, v, w: u * v).assemble(basis)
    stiffness = skfem.BilinearForm(lambda u, v, w: dot(grad(u), grad(v))).assemble(basis)
    lumped = np.asarray(mass.sum(axis=1)).ravel()
    kappa = np.sqrt(8) / RANGE
    tau = 1 / (np.sqrt(4 * np.pi) * kappa * DEVIATION)
    operator = kappa**2 * scipy.sparse.diags_array(lumped) + stiffness
    return tau**2 * operator @ scipy.sparse.diags_array(1 / lumped) @ operator
# [end]


# [field]
def estimate(mesh, places, measured):
    """Return the mean of the field at the vertices, given what was measured at the places."""
    projector = mesh.projector(places, outside="refuse")
    precision = precision_of(mesh) + projector.T @ projector / NOISE**2
    right = projector.T @ measured / NOISE**2
    return scipy.sparse.linalg.spsolve(precision.tocsc(), right)
# [end]


def main():
    rng = np.random.default_rng(3)
    # Half of the places are in clusters, nearer to each other than the field can tell.
    centers = rng.random((40, 2))
    clusters = centers.repeat(10, axis=0) + 0.005 * rng.normal(size=(400, 2))
    places = np.concatenate([rng.random((400, 2)), clusters])
    measured = truth(places) + NOISE * rng.normal(size=len(places))
    made = mesh_of(places)
    mesh = made.mesh
    field = estimate(mesh, places, measured)
    at = np.stack(np.meshgrid(*2 * [np.linspace(0.05, 0.95, 40)]), axis=-1).reshape(-1, 2)
    error = mesh.projector(at, outside="refuse") @ field - truth(at)
    inner = np.unique(mesh.simplices[mesh.simplex_regions == 1])
    return {
        "places": len(places),
        "meshed": int((made.representatives == np.arange(len(places))).sum()),
        "vertices": len(mesh.points),
        "vertices of the ring alone": len(mesh.points) - len(inner),
        "smallest angle": mesh.quality().min_angle_degrees,
        "root of the mean squared error": float(np.sqrt((error**2).mean())),
    }


if __name__ == "__main__":
    for name, value in main().items():
        print(f"{name}: {value}")
