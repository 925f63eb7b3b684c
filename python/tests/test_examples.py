"""The examples that are for Python's users do what they say."""

import importlib.util
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"


def test_heat_in_two_materials_is_that_of_the_closed_form(tmp_path):
    for needed in ("skfem", "meshio"):
        pytest.importorskip(needed)
    spec = importlib.util.spec_from_file_location("two_materials", EXAMPLES / "two_materials.py")
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    errors = example.main(tmp_path)
    assert {"netmesh", "meshio"} <= set(errors)
    assert all(error < 1e-12 for error in errors.values()), errors


def loaded(name, text=None):
    """An example as a module, or another text in its place."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    example = importlib.util.module_from_spec(spec)
    if text is None:
        spec.loader.exec_module(example)
    else:
        exec(compile(text, name, "exec"), example.__dict__)
    return example


def test_a_script_of_scipys_has_the_same_results_with_its_imports_changed():
    text = (EXAMPLES / "scipy_script.py").read_text()
    theirs = text.replace("\nfrom netmesh import (\n", "\nfrom scipy.interpolate import (\n")
    theirs = theirs.replace("\nfrom netmesh import ConvexHull", "\nfrom scipy.spatial import ConvexHull")
    changed = [(a, b) for a, b in zip(text.splitlines(), theirs.splitlines()) if a != b]
    assert len(changed) == 2 and all("import" in a and "scipy" in b for a, b in changed)
    assert "import netmesh" not in theirs and "from netmesh" not in theirs
    # The lines that the docstring shows are these.
    for line in ("from scipy.interpolate import (", "from scipy.spatial import ConvexHull"):
        assert f"\n    {line}" in text and f"\n{line}" in theirs
    found, expected = loaded("scipy_script").main(), loaded("scipy_script", theirs).main()
    assert found["errors"]["cubic"] < 0.2 * found["errors"]["linear"]
    assert set(found) == set(expected) and (found["along"] == -1).sum() == (expected["along"] == -1).sum() > 0
    for name, value in found.items():
        if name == "errors":
            assert value == pytest.approx(expected[name], rel=1e-10)
        else:
            assert value == pytest.approx(expected[name], rel=1e-10, abs=1e-10), name


def test_a_field_on_a_mesh_with_a_ring():
    pytest.importorskip("skfem")
    found = loaded("spatial_mesh").main()
    assert found["meshed"] < 0.8 * found["places"] and found["smallest angle"] >= 25
    assert found["vertices of the ring alone"] < 0.3 * found["vertices"]
    # Noise has a deviation of 0.1.
    assert found["root of the mean squared error"] < 0.1
