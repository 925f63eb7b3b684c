"""The code in the documents runs as shown."""

import ast
import contextlib
import doctest
import functools
import importlib
import inspect
import pathlib
import pkgutil

import netmesh
import pytest
import run_page
from checkout import needed

MODULES = ["netmesh", *(f"netmesh.{m.name}" for m in pkgutil.iter_modules(netmesh.__path__))]


@pytest.mark.parametrize("page, least", [("python.md", 40), ("domains.md", 8)])
def test_the_page(page, least, tmp_path, monkeypatch):
    found = needed("docs", page)
    monkeypatch.chdir(tmp_path)
    failed, attempted = run_page.run(found)
    assert failed == 0 and attempted >= least


def test_the_page_of_other_packages(tmp_path, monkeypatch):
    page = needed("docs", "python_packages.md")
    for package in ("matplotlib", "meshio", "pyvista", "shapely", "skfem"):
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    failed, attempted = run_page.run(page)
    assert failed == 0 and attempted > 20


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of(name):
    module = importlib.import_module(name)
    runner = Runner()
    for test in [*doctest.DocTestFinder().find(module), *kept_array_examples(module)]:
        with contextlib.suppress(Missing):
            runner.run(test)
    assert runner.summarize().failed == 0
    if runner.missing:
        pytest.skip(f"some examples need {', '.join(sorted(runner.missing))}; the others ran")


#: Packages that netmesh works with and does not need.
OPTIONAL = {"gudhi", "matplotlib", "meshio", "pyvista", "scipy", "shapely", "skfem"}


class Missing(Exception):
    """A package that an example needs is not installed."""


class Runner(doctest.DocTestRunner):
    """Leaves examples at the first that needs a package which is not installed, and keeps its name."""

    def __init__(self):
        super().__init__()
        self.missing = set()

    def report_unexpected_exception(self, out, test, example, exc_info):
        error = exc_info[1]
        package = (getattr(error, "name", None) or "").split(".")[0]
        if isinstance(error, ModuleNotFoundError) and package in OPTIONAL:
            self.missing.add(package)
            raise Missing
        super().report_unexpected_exception(out, test, example, exc_info)


def kept_array_examples(module):
    """Returns the examples of cached properties, which doctest does not look at."""
    parser = doctest.DocTestParser()
    classes = [thing for thing in vars(module).values() if inspect.isclass(thing)]
    return [
        parser.get_doctest(kept.__doc__ or "", {}, f"{kind.__name__}.{name}", None, 0)
        for kind in classes
        if kind.__module__ == module.__name__
        for name, kept in vars(kind).items()
        if isinstance(kept, functools.cached_property)
    ]


def test_examples_of_kept_arrays_are_found():
    from netmesh import _derived

    assert sum(len(test.examples) for test in kept_array_examples(_derived)) > 20


def test_everything_public_is_described():
    for name in netmesh.__all__:
        thing = getattr(netmesh, name)
        assert thing.__doc__, name
        assert thing.__module__ == "netmesh" or not issubclass(type(thing), type) or (
            not issubclass(thing, Exception)
        )
    named = ("mesh", "Mesh", "Delaunay", "LinearNDInterpolator", "CloughTocher2DInterpolator", "ConvexHull")
    functions = ("NearestNDInterpolator", "griddata", "spatial_mesh", "representatives", "offset_hull")
    for name in named + functions:
        assert ">>>" in getattr(netmesh, name).__doc__


def test_every_question_has_an_example():
    for kind in (netmesh.Mesh, netmesh.Part, netmesh.Filtration, netmesh.AlphaShape):
        for name, thing in inspect.getmembers(kind, inspect.isfunction):
            if not name.startswith("_"):
                assert ">>>" in (thing.__doc__ or ""), f"{kind.__name__}.{name}"


def test_the_stub_has_what_the_extension_has():
    from netmesh import _netmesh

    stub = ast.parse(pathlib.Path(netmesh.__file__).with_name("_netmesh.pyi").read_text())
    for described in (node for node in stub.body if isinstance(node, ast.ClassDef)):
        thing = getattr(_netmesh, described.name)
        names = {name for name in dir(thing) if not name.startswith("_")}
        functions = {node.name: node for node in described.body if hasattr(node, "name")}
        assert names == set(functions) - {"__new__"}
        for name in names:
            if inspect.isdatadescriptor(getattr(thing, name)):
                continue
            parameters = [argument.arg for argument in functions[name].args.args]
            assert list(inspect.signature(getattr(thing, name)).parameters) == parameters


def test_every_option_of_the_library_is_a_keyword():
    page = needed("docs", "options.md").read_text()
    rows = [line.split("|")[1] for line in page.split("\n") if line.startswith("| `")]
    options = {row.split("`")[1] for row in rows}
    given = {"points", "segments", "markers", "holes", "regions", "size", "background", "progress"}
    given |= {"facets", "facet_markers", "cutoff"}
    keywords = set(inspect.signature(netmesh.mesh).parameters)
    assert keywords - given == options and len(options) > 10


def test_the_version_is_that_of_the_library():
    import importlib.metadata

    text = needed("Cargo.toml").read_text()
    version = text.split("[workspace.package]")[1].split('version = "')[1].split('"')[0]
    assert netmesh.__version__ == version == importlib.metadata.version("netmesh")
