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


def frame_and_halves():
    """Returns a mesh with segments in the plane, and one with facets and segments in space."""
    rings = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]], float)
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    markers, regions = [1, 2, 3, 4, 0, 0, -5, 7], [(0.5, 0.5, 3), (1.5, 1.5, -2)]
    frame = netmesh.mesh(rings, sides, markers=markers, regions=regions, size=0.5)
    box = [[x, y, z] for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)]
    walls = [[0, 1, 3, 2], [8, 10, 11, 9], [4, 5, 7, 6], [0, 4, 8, 9, 5, 1], [2, 3, 7, 11, 10, 6]]
    walls += [[0, 2, 6, 10, 8, 4], [1, 5, 9, 11, 7, 3]]
    regions = [(0.5, 0.5, 0.5, 1), (1.5, 0.5, 0.5, -2)]
    numbers = [1, 2, 30, 4, 4, 0, -7]
    halves = netmesh.mesh(
        box, [[0, 3], [4, 7]], walls, markers=[9, -9], facet_markers=numbers, regions=regions
    )
    return frame, halves


def test_pyvista_has_the_cells_and_data_of_a_file(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    for m in frame_and_halves():
        m.export(tmp_path / "mesh.vtu")
        read, made = pyvista.read(tmp_path / "mesh.vtu"), m.to_pyvista(None, {"volume": m.volumes})
        assert (made.points == read.points).all() and (made.celltypes == read.celltypes).all()
        assert (made.cell_connectivity == read.cell_connectivity).all()
        names = {"kind", "domain", "input", "precision_limited"}
        assert names <= set(made.point_data)
        for name in names:
            # The files have unsigned numbers, of which the largest stands for none.
            theirs = read.point_data[name]
            assert (made.point_data[name].astype(theirs.dtype) == theirs).all()
        names = {"region", "marker", "facet"} if m.dim == 3 else {"region"}
        assert names <= set(made.cell_data)
        for name in names:
            theirs = read.cell_data[name]
            assert (made.cell_data[name].astype(theirs.dtype) == theirs).all()
        assert (made.field_data["segments"] == read.field_data["segments"]).all()
        assert (made.field_data["segment_markers"] == read.field_data["segment_markers"].ravel()).all()
        volumes = made.cell_data["volume"]
        assert (volumes[: len(m.simplices)] == m.volumes).all()
        assert np.isnan(volumes[len(m.simplices) :]).all()
    frame, halves = frame_and_halves()
    assert (frame.to_pyvista().point_data["size"] == 0.5).all()
    assert "size" not in halves.to_pyvista().point_data
    assert set(netmesh.mesh([[0, 0], [1, 0], [0, 1]]).to_pyvista().cell_data) == set()


def test_meshio_has_blocks_of_facets_and_segments(tmp_path):
    meshio = pytest.importorskip("meshio")
    frame, halves = frame_and_halves()
    for m, kinds in [(frame, ["triangle", "line"]), (halves, ["tetra", "triangle", "line"])]:
        made = m.to_meshio(None, {"volume": m.volumes, "number": np.arange(len(m.simplices))})
        assert [block.type for block in made.cells] == kinds
        assert (made.cells_dict["line"] == m.segments).all()
        assert (made.get_cell_data("marker", "line") == m.segment_markers).all()
        assert (made.get_cell_data("region", kinds[0]) == m.simplex_regions).all()
        assert (made.get_cell_data("region", "line") == 0).all()
        assert (made.get_cell_data("marker", kinds[0]) == 0).all()
        assert np.isnan(made.get_cell_data("volume", "line")).all()
        assert (made.get_cell_data("number", "line") == 0).all()
        made.write(tmp_path / "mesh.vtu")
        read = meshio.read(tmp_path / "mesh.vtu")
        assert (read.get_cell_data("marker", "line") == m.segment_markers).all()
    made = halves.to_meshio()
    assert (made.cells_dict["triangle"] == halves.facet_triangles).all()
    assert (made.get_cell_data("marker", "triangle") == halves.facet_markers).all()
    assert (made.get_cell_data("facet", "triangle") == halves.facet_parents).all()
    assert (made.get_cell_data("facet", "tetra") == -1).all()
    # Markers are those that the caller gave, by the parents.
    numbers = np.array([1, 2, 30, 4, 4, 0, -7])
    assert (halves.facet_markers == numbers[halves.facet_parents]).all()
    given = np.where(halves.segment_parents < 0, 0, np.array([9, -9])[halves.segment_parents])
    assert (halves.segment_markers == given).all() and set(given.tolist()) >= {9, -9}


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
