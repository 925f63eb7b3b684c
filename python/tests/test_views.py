"""Meshes for other packages."""

import builtins

import netmesh
import numpy as np
import pytest


@pytest.mark.parametrize("dim", [2, 3])
def test_meshio(dim, random, tmp_path):
    meshio = pytest.importorskip("meshio")
    m = netmesh.mesh(random.random((30, dim)))
    values = random.random(len(m.points))
    made = m.to_meshio({"values": values}, {"volume": m.volumes})
    assert (made.points == m.points).all() and (made.cells[0].data == m.simplices).all()
    assert made.cells[0].type == {2: "triangle", 3: "tetra"}[dim]
    made.write(tmp_path / "mesh.vtu")
    read = meshio.read(tmp_path / "mesh.vtu")
    assert (read.points[:, :dim] == m.points).all() and (read.point_data["kind"] == m.kinds).all()
    assert (read.point_data["values"] == values).all()
    assert (read.cell_data["volume"][0] == m.volumes).all()


@pytest.mark.parametrize("dim", [2, 3])
def test_pyvista(dim, random):
    pytest.importorskip("pyvista")
    m = netmesh.mesh(random.random((30, dim)))
    grid = m.to_pyvista({"x": m.points[:, 0]}, {"volume": m.volumes})
    assert (grid.n_points, grid.n_cells) == (len(m.points), len(m.simplices))
    assert (grid.points[:, :dim] == m.points).all() and (grid.point_data["kind"] == m.kinds).all()
    assert (grid.cells_dict[{2: 5, 3: 10}[dim]] == m.simplices).all()
    sizes = grid.compute_cell_sizes()
    assert np.allclose(sizes["Area" if dim == 2 else "Volume"], grid.cell_data["volume"])


def test_plot(random, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("svg")
    # Axes of examples that other tests run are not the current ones.
    pytest.importorskip("matplotlib.pyplot").close("all")
    m = netmesh.mesh(random.random((30, 2)))
    ax = m.plot(color="red")
    edges, dots = ax.lines[0], ax.lines[-1]
    assert edges.get_color() == "red" and len(dots.get_xdata()) == 30
    drawn = np.column_stack(edges.get_data()).reshape(-1, 3, 2)
    assert len(drawn) == len(m.edges)
    assert m.plot(ax) is ax
    ax.figure.savefig(tmp_path / "mesh.svg")


def test_dimensions_and_packages_that_are_not_there(random, monkeypatch):
    m = netmesh.mesh(random.random((10, 4)))
    for view in (m.to_meshio, m.to_pyvista, m.plot):
        with pytest.raises((netmesh.InvalidArgumentError, ImportError), match="dim = 4|No module"):
            view()

    def refuse(name, *arguments):
        if name.split(".")[0] in ("meshio", "pyvista", "matplotlib"):
            raise ModuleNotFoundError(f"No module named '{name}'")
        return imported(name, *arguments)

    imported = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", refuse)
    m = netmesh.mesh(random.random((10, 2)))
    for view, name in [(m.to_meshio, "meshio"), (m.to_pyvista, "pyvista"), (m.plot, "matplotlib")]:
        with pytest.raises(ModuleNotFoundError, match=name):
            view()
