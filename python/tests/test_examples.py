"""The examples that are for Python's users do what they say."""

import importlib.util
import signal
import subprocess
import sys
from pathlib import Path

import netmesh
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"


def example(name, *needed):
    """Returns an example as a module; what it needs is there or the test is skipped."""
    for package in needed:
        pytest.importorskip(package)
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
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
    program = [sys.executable, "-u", str(EXAMPLES / "many_points.py")]
    done = subprocess.run([*program, "2000"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("<netmesh.Mesh: dim 3") and "100.0%" in done.stderr
    with subprocess.Popen([*program, "2000000"], stderr=subprocess.PIPE, text=True) as running:
        said = ""
        while "insert" not in said:
            said += running.stderr.read(1)
        running.send_signal(signal.SIGINT)
        said += running.stderr.read()
    assert running.returncode == 1 and said.endswith("stopped; nothing is left of the run\n")
