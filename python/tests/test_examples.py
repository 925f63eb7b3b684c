"""The examples that are for Python's users do what they say."""

import importlib.util
from pathlib import Path

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
