"""The examples that are for Python's users do what they say."""

import functools
import importlib.util
import signal
import subprocess
import sys

import netmesh
import numpy as np
import pytest
from checkout import needed


def path_of(name):
    return needed("examples", "python", f"{name}.py")


def example(name, *packages):
    """Returns an example as a module; what it needs is there or the test is skipped."""
    path = path_of(name)
    for package in packages:
        pytest.importorskip(package)
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_heat_in_two_materials_is_that_of_the_closed_form(tmp_path):
    errors = example("two_materials", "skfem", "meshio").main(tmp_path)
    assert {"netmesh", "meshio"} <= set(errors)
    assert all(error < 1e-12 for error in errors.values()), errors


def test_a_country_is_solved_and_drawn(tmp_path):
    picture = tmp_path / "country.png"
    mesh, u = example("country", "skfem", "matplotlib").main(picture)
    assert mesh.quality().min_angle_degrees >= 28 and picture.stat().st_size > 10_000
    # Shoelace formula of the outline that the mesh was made of.
    x, y = mesh.points[: len(mesh.input_vertices)].T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert mesh.volumes.sum() == pytest.approx(area, rel=1e-9)
    # Saint-Venant: no domain of this area has a larger integral of u than the disc, area^2 / (8 pi).
    integral = (u[mesh.simplices].mean(axis=1) * mesh.volumes).sum()
    assert 0.3 < integral / (area**2 / (8 * np.pi)) < 1 and u.min() > -1e-9


def test_adaptive_meshes_beat_uniform_ones():
    adaptive = example("adaptive", "skfem")
    vertices, errors = zip(*adaptive.main(5))
    uniform = netmesh.mesh(adaptive.L, min_angle=28, max_edge=0.025)
    _, energy = adaptive.solve(uniform)
    # Half the vertices of a uniform mesh, and a smaller error.
    assert vertices[-1] < 0.6 * len(uniform.points) and errors[-1] < adaptive.ENERGY - energy
    # The error falls as the vertices grow, which it does not on uniform meshes of this domain.
    assert errors[-1] * vertices[-1] < 1.3 * errors[1] * vertices[1]


def test_a_square_cools_as_the_closed_form_says():
    cooling = example("cooling", "skfem", "scipy")
    coarse, fine = cooling.main(0.1), cooling.main(0.05)
    assert fine < 5e-3 and fine < coarse / 2


def test_many_points_tell_their_progress_and_stop_on_a_signal(tmp_path):
    program = [sys.executable, "-u", str(path_of("many_points"))]
    done = subprocess.run([*program, "2000"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("<netmesh.Mesh: dim 3") and "100.0%" in done.stderr
    # A shell in the background has its programs ignore the signal.
    heeds = functools.partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    running = subprocess.Popen([*program, "2000000"], stderr=subprocess.PIPE, text=True, preexec_fn=heeds)
    with running:
        said = ""
        while "insert" not in said:
            said += running.stderr.read(1)
        running.send_signal(signal.SIGINT)
        said += running.stderr.read()
    assert running.returncode == 1 and said.endswith("stopped; nothing is left of the run\n")


def test_a_script_of_scipys_has_the_same_results_with_its_imports_changed():
    text = path_of("scipy_script").read_text()
    theirs = text.replace("\nfrom netmesh import (\n", "\nfrom scipy.interpolate import (\n")
    theirs = theirs.replace("\nfrom netmesh import ConvexHull", "\nfrom scipy.spatial import ConvexHull")
    changed = [(a, b) for a, b in zip(text.splitlines(), theirs.splitlines()) if a != b]
    assert len(changed) == 2 and all("import" in a and "scipy" in b for a, b in changed)
    assert "import netmesh" not in theirs and "from netmesh" not in theirs
    # The lines that the docstring shows are these.
    for line in ("from scipy.interpolate import (", "from scipy.spatial import ConvexHull"):
        assert f"\n    {line}" in text and f"\n{line}" in theirs
    given = {"__name__": "scipy_script"}
    exec(compile(theirs, "scipy_script", "exec"), given)
    found, expected = example("scipy_script", "scipy").main(), given["main"]()
    assert found["errors"]["cubic"] < 0.2 * found["errors"]["linear"]
    assert set(found) == set(expected) and (found["along"] == -1).sum() == (expected["along"] == -1).sum() > 0
    for name, value in found.items():
        if name == "errors":
            assert value == pytest.approx(expected[name], rel=1e-10)
        else:
            assert value == pytest.approx(expected[name], rel=1e-10, abs=1e-10), name


def test_a_field_on_a_mesh_with_a_ring():
    found = example("spatial_mesh", "skfem").main()
    assert found["meshed"] < 0.8 * found["places"] and found["smallest angle"] >= 25
    assert found["vertices of the ring alone"] < 0.3 * found["vertices"]
    # Noise has a deviation of 0.1.
    assert found["root of the mean squared error"] < 0.1


def test_rings_of_points_become_polygons_with_holes():
    polygons = example("alpha_polygons", "shapely").main()
    rings = [polygon for polygon in polygons if len(polygon.interiors) == 1]
    # Rings from 0.7 to 1, less what the balls take of their sides.
    assert len(polygons) == 3 and len(rings) == 2
    assert all(0.9 * 0.51 * np.pi < ring.area < 0.51 * np.pi for ring in rings)
    assert {round(ring.centroid.x) for ring in rings} == {0, 3}


def test_a_box_of_points_has_the_solution_of_the_cube():
    mesh, largest = example("box", "skfem").main()
    assert mesh.volumes.sum() == pytest.approx(1, rel=1e-12)
    # 0.05621 by the series of the cube; linear elements stay below.
    assert 0.0550 < largest < 0.0563
    assert mesh.quality().below_min_dihedral == 0


def test_a_scan_becomes_a_part_with_heat_in_it():
    surface, mesh, u, came_in, there = example("scan", "skfem", "scipy").main(10_000)
    assert surface.genera == (1,) and len(surface.vertices) > 1_500
    surface.validate()
    assert mesh.volumes.sum() == pytest.approx(surface.volume, rel=1e-12)
    # Pappus: a disc of radius 0.3 that goes round a circle of radius 1; points inside make it smaller.
    assert 0.95 < surface.volume / (2 * np.pi * np.pi * 0.3**2) < 1
    assert came_in == pytest.approx(there, rel=1e-10) and 0 < there < surface.volume
    assert -1e-3 < u.min() and u.max() == pytest.approx(1)
    # Cosines between facets, of whose normals the gradients of barycentric coordinates are.
    corners = mesh.points[mesh.simplices]
    normals = np.linalg.inv(corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    normals = np.concatenate([normals, -normals.sum(axis=1, keepdims=True)], axis=1)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    cosines = normals @ normals.transpose(0, 2, 1)
    is_thin = cosines.min(axis=(1, 2), where=~np.eye(4, dtype=bool), initial=1) < -np.cos(np.radians(9.99))
    is_on_surface = np.isin(mesh.simplices, mesh.hull.vertices).all(axis=1)
    assert not (is_thin & ~is_on_surface).any() and is_thin.sum() < len(mesh.simplices) / 500
