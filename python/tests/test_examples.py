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
