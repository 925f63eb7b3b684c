"""The code in the documents runs as shown."""

import doctest
import importlib
import pathlib
import pkgutil

import netmesh
import pytest

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "python.md"
MODULES = ["netmesh", *(f"netmesh.{m.name}" for m in pkgutil.iter_modules(netmesh.__path__))]


def test_the_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # Fences are no part of what the code prints.
    text = "\n".join("" if line.startswith("```") else line for line in PAGE.read_text().split("\n"))
    test = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    assert len(test.examples) > 10
    assert doctest.DocTestRunner().run(test).failed == 0


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of(name):
    module = importlib.import_module(name)
    failed, _ = doctest.testmod(module)
    assert failed == 0


def test_everything_public_is_described():
    for name in netmesh.__all__:
        thing = getattr(netmesh, name)
        assert thing.__doc__, name
        assert thing.__module__ == "netmesh" or not issubclass(type(thing), type) or (
            not issubclass(thing, Exception)
        )
    for name in ("mesh", "Mesh", "Delaunay", "LinearNDInterpolator"):
        assert ">>>" in getattr(netmesh, name).__doc__
