"""Pictures of meshes and alpha shapes."""

import netmesh
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
pyplot = pytest.importorskip("matplotlib.pyplot")

REGIONS = [(0.5, 0.5, 3), (1.5, 1.5, -2)]


@pytest.fixture
def ax():
    pyplot.close("all")
    return pyplot.figure().add_subplot()


def plate():
    rings = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]], float)
    sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]]
    return netmesh.mesh(rings, sides, regions=REGIONS, max_edge=0.6)


def test_values_colour_vertices_or_simplices(ax):
    m = plate()
    assert len(m.points) != len(m.simplices)
    heights = np.hypot(*m.points.T)
    assert m.plot(heights, ax=ax, cmap="magma", vmin=0) is ax
    shown = ax.collections[0]
    assert (shown.get_array() == heights).all() and shown.get_cmap().name == "magma"
    assert shown.get_clim()[0] == 0 and len(ax.lines) == 0
    ax.clear()
    m.plot(m.volumes.tolist(), ax=ax, edgecolors="w", lw=2)
    assert (ax.collections[0].get_array() == m.volumes).all()
    assert ax.lines[0].get_color() == "w" and ax.lines[0].get_linewidth() == 2
    ax.figure.colorbar(ax.collections[0])
    ax.figure.canvas.draw()
    counts = rf"\({len(m.points)},\), of vertices, or \({len(m.simplices)},\), of simplices"
    rule = rf"values has shape \(3,\); it must be {counts}"
    with pytest.raises(netmesh.InvalidArgumentError, match=rule):
        m.plot([1, 2, 3], ax=ax)
    with pytest.raises(netmesh.InvalidArgumentError, match="values has shape"):
        m.plot(m.points, ax=ax)


def test_regions_have_colours_and_names(ax):
    m = plate()
    m.plot(regions=True, ax=ax)
    areas = {}
    for collection in ax.collections[:2]:
        corners = [path.vertices[:3] for path in collection.get_paths()]
        (ahead, behind) = (np.array([c[k] - c[0] for c in corners]) for k in (1, 2))
        areas[collection.get_label()] = np.sum(ahead[:, 0] * behind[:, 1] - ahead[:, 1] * behind[:, 0]) / 2
    assert {name: round(area, 9) for name, area in areas.items()} == {"region_-2": 1, "region_3": 8}
    one, other = (tuple(collection.get_facecolor()[0]) for collection in ax.collections[:2])
    assert one != other and ax.get_xlim()[1] > 2.9
    assert [text.get_text() for text in ax.legend().get_texts()] == ["region_-2", "region_3"]
    m.plot(regions=True, ax=ax, cmap="viridis", alpha=0.5)
    with pytest.raises(netmesh.InvalidArgumentError, match="regions is True; the mesh has no"):
        netmesh.mesh([[0, 0], [1, 0], [0, 1]]).plot(regions=True)


def test_quality_is_the_smallest_angle(ax, random):
    m = plate()
    m.plot(by="quality", ax=ax)
    found = ax.collections[0].get_array()
    corners = m.points[m.simplices]
    angles = []
    for k in range(3):
        a, b = corners[:, k - 1] - corners[:, k], corners[:, k - 2] - corners[:, k]
        cosines = (a * b).sum(axis=1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)
        angles.append(np.degrees(np.arccos(cosines)))
    assert np.allclose(found, np.min(angles, axis=0))
    edges = [0, found.min() - 1e-9, found.max() + 1e-9, 90]
    counts, _ = m.quality_histogram("smallest_angle", edges, hull=True)
    assert counts.tolist() == [0, len(found), 0]
    ax.clear()
    m.plot(by="radius_edge", ax=ax)
    # A triangle's circumradius over its shortest edge is 1 / (2 sin of its smallest angle).
    assert np.allclose(ax.collections[0].get_array(), 0.5 / np.sin(np.radians(found)))
    with pytest.raises(netmesh.InvalidArgumentError, match="by is 'beauty'; it must be 'quality' or"):
        m.plot(by="beauty")
    with pytest.raises(netmesh.InvalidArgumentError, match="regions and by both give colours"):
        m.plot(regions=True, by="quality")


def test_angles_of_tetrahedra_are_those_of_the_histogram(random):
    from netmesh._plots import smallest_angles

    m = netmesh.mesh(random.random((40, 3)))
    found = smallest_angles(m.points, m.simplices)
    # Cages have angles of 30 and 45 degrees, which roundings put on either side.
    edges = [0, 5, 15, 29, 44, 59, 75]
    expected, _ = m.quality_histogram("smallest_angle", edges, hull=True)
    assert (np.histogram(found, edges)[0] == expected).all() and expected.sum() == len(found)


def test_long_and_short_names_of_keywords_are_one(ax):
    m = plate()
    short, long = {"lw": 3, "c": "red"}, {"linewidth": 3, "color": "red"}
    for names in (short, long, {**short, **long}):
        ax.clear()
        m.plot(ax=ax, **names)
        assert ax.lines[0].get_linewidth() == 3 and ax.lines[0].get_color() == "red"
    with pytest.raises(netmesh.ArgumentTypeError, match="^lw and linewidth are one keyword"):
        m.plot(ax=ax, lw=3, linewidth=2)
    with pytest.raises(netmesh.InvalidArgumentError, match="plotter is for 3D; the mesh has dim = 2"):
        m.plot(plotter=3)


def test_parts_are_plotted_with_values_of_their_own_or_of_the_mesh(ax, random):
    m = netmesh.mesh(random.random((50, 2)))
    part = m.part("hull")
    heights = random.random(len(m.points))
    for values in (heights, heights[part.vertices]):
        ax.clear()
        part.plot(values, ax=ax)
        assert (ax.collections[0].get_array() == heights[part.vertices]).all()
    for values in (m.volumes, part.volumes):
        ax.clear()
        part.plot(values, ax=ax)
        assert (ax.collections[0].get_array() == part.volumes).all()
    ax.clear()
    part.plot(ax=ax)
    drawn = np.column_stack(ax.lines[0].get_data()).reshape(-1, 3, 2)
    assert len(drawn) == len(part.edges)
    assert len(ax.lines[-1].get_xdata()) == (part.kinds == netmesh.VertexKind.INPUT).sum()
    ax.clear()
    two = netmesh.mesh(np.concatenate([random.random((9, 2)), 0.5 + 1e-5 * random.random((9, 2))]))
    part = two.part(domain=1)
    part.plot(ax=ax)
    drawn = np.column_stack(ax.lines[-1].get_data())
    assert (drawn == part.points[part.kinds == netmesh.VertexKind.INPUT]).all() and len(drawn) < 18


def test_shapes_are_drawn_with_their_lone_edges(ax):
    points = np.array([[0, 0], [1, 0], [0.5, 0.8], [2, 0]])
    shape = netmesh.mesh(points, algorithm="delaunay").filtration().shape(0.32)
    assert shape.face_counts == (4, 4, 1)
    assert shape.plot(ax=ax, c="green", ec="black") is ax
    triangles, lines = ax.collections
    assert len(triangles.get_paths()) == 1 and len(lines.get_segments()) == 4
    assert tuple(triangles.get_facecolor()[0]) == matplotlib.colors.to_rgba("green")
    assert ax.get_xlim()[1] > 1.99
    # A shape without triangles, and one of points alone.
    netmesh.mesh(points, algorithm="delaunay").filtration().shape(0).plot(ax=ax)


def solid(random):
    return netmesh.mesh(random.random((60, 3)))


def test_a_plane_cuts_a_mesh_in_space_between_tetrahedra(random):
    pytest.importorskip("pyvista")
    m = solid(random)
    whole = m.plot(by="quality", clip=False, off_screen=True)
    assert whole.mesh.n_cells == len(m.simplices)
    assert np.isclose(whole.mesh.cell_data["smallest angle"].min(), whole.mesh.active_scalars.min())
    middle = (m.points[:, 2].min() + m.points[:, 2].max()) / 2
    corners = m.points[m.simplices]
    cut = m.plot(m.points[:, 0], clip="z", off_screen=True)
    below = (corners[:, :, 2].min(axis=1) < middle).sum()
    assert 0 < cut.mesh.n_cells == below < len(m.simplices)
    assert (cut.mesh.celltypes == 10).all()
    above = (corners[:, :, 2].max(axis=1) > 0.5).sum()
    other = m.plot(m.volumes, clip=((0, 0, -1), (0, 0, 0.5)), off_screen=True, lw=3, c="red")
    assert other.mesh.n_cells == above
    image = other.screenshot(return_img=True)
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 10
    plotter = m.part("hull").plot(clip="-x", plotter=other)
    assert plotter is other and len(plotter.actors) >= 2
    for plot in (whole, cut, other):
        plot.close()


def test_on_a_screen_the_plane_is_a_widget(random):
    pytest.importorskip("pyvista")

    class Screen:
        off_screen = False

        def add_mesh_clip_plane(self, grid, **given):
            self.grid, self.given = grid, given

    m = solid(random)
    screen = m.plot(clip="y", plotter=Screen(), linewidth=2)
    assert screen.grid.n_cells == len(m.simplices) and screen.given["line_width"] == 2
    assert screen.given["normal"].tolist() == [0, 1, 0]


def test_regions_and_shapes_in_space(random):
    pytest.importorskip("pyvista")
    box = [[x, y, z] for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)]
    walls = [[0, 1, 3, 2], [8, 10, 11, 9], [4, 5, 7, 6], [0, 4, 8, 9, 5, 1], [2, 3, 7, 11, 10, 6]]
    walls += [[0, 2, 6, 10, 8, 4], [1, 5, 9, 11, 7, 3]]
    m = netmesh.mesh(box, facets=walls, regions=[(0.5, 0.5, 0.5, 1), (1.5, 0.5, 0.5, 2)])
    plotter = m.plot(regions=True, clip=None, off_screen=True)
    assert (plotter.mesh.cell_data["region"] == m.simplex_regions).all()
    plotter.close()
    shape = netmesh.mesh(random.random((80, 3)), algorithm="delaunay").filtration().shape()
    plotter = shape.plot(off_screen=True, color="white")
    lone = (shape.classes(2) == netmesh.FaceClass.SINGULAR).sum()
    assert plotter.mesh.n_cells == len(shape.boundary) + lone
    plotter.close()


def test_planes_that_are_none_are_refused(random):
    pytest.importorskip("pyvista")
    m = solid(random)
    for clip, rule in [("w", "clip is 'w'; it must be 'x'"), ((0, 0, 0), "clip is"), ((1, 2), "clip is")]:
        with pytest.raises(netmesh.InvalidArgumentError, match=rule):
            m.plot(clip=clip, off_screen=True)
    with pytest.raises(netmesh.InvalidArgumentError, match="ax is for 2D; the mesh has dim = 3"):
        m.plot(ax=3)
    with pytest.raises(netmesh.InvalidArgumentError, match="dim = 4; it must be 2 or 3"):
        netmesh.mesh(random.random((9, 4))).plot()
