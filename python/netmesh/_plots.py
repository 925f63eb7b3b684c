"""Pictures of meshes, with Matplotlib in the plane and with PyVista in space."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np

from ._arrays import doubles
from ._errors import ArgumentTypeError, InvalidArgumentError
from ._views import points_in_space, require_dimension

#: Other names of Matplotlib's keywords.
_ALIASES = {
    "aa": "antialiased",
    "antialiaseds": "antialiased",
    "c": "color",
    "ec": "edgecolor",
    "edgecolors": "edgecolor",
    "fc": "facecolor",
    "facecolors": "facecolor",
    "linestyles": "linestyle",
    "linewidths": "linewidth",
    "ls": "linestyle",
    "lw": "linewidth",
    "mec": "markeredgecolor",
    "mew": "markeredgewidth",
    "mfc": "markerfacecolor",
    "ms": "markersize",
}

#: Names of Matplotlib's keywords for those of PyVista.
_IN_SPACE = {"linewidth": "line_width", "facecolor": "color", "edgecolor": "edge_color", "alpha": "opacity"}

#: Value of `FaceClass` for faces in nothing larger of a shape.
_SINGULAR = 1

#: Keywords that say how lines are drawn.
_OF_LINES = ("color", "edgecolor", "linewidth", "linestyle")


class Colors(NamedTuple):
    """Values that colour a picture."""

    #: 'vertices', 'simplices', or 'regions', whose values are labels of simplices.
    of: str
    values: np.ndarray
    #: Name of the values.
    name: str


def keywords(given: dict) -> dict:
    """Return keywords of Matplotlib under one name each."""
    found: dict = {}
    source: dict = {}
    for name, value in given.items():
        full = _ALIASES.get(name, name)
        if full in found and not _is_same(found[full], value):
            raise ArgumentTypeError(f"{source[full]} and {name} are one keyword; give one of them")
        found[full], source[full] = value, name
    return found


def _is_same(one: Any, other: Any) -> bool:
    return type(one) is type(other) and bool(np.all(one == other))


def plane_axes(ax: Any) -> Any:
    """Return the axes to draw on, the current ones without any."""
    import matplotlib.pyplot

    return matplotlib.pyplot.gca() if ax is None else ax


def plot_plane(mesh: Any, colors: Optional[Colors], ax: Any, arguments: dict) -> Any:
    """Draw triangles of the core of a mesh, its segments and inputs on axes of Matplotlib."""
    from matplotlib.collections import LineCollection

    ax = plane_axes(ax)
    x, y = mesh.points.T
    given = keywords(arguments)
    if colors is None:
        ax.triplot(x, y, mesh.simplices, **{"linewidth": 0.5, "color": "tab:blue", **given})
        inputs = np.unique(mesh.input_vertices)
        inputs = inputs[inputs >= 0]
    else:
        lines = {name: given.pop(name) for name in _OF_LINES if name in given}
        if colors.of == "regions":
            _fill_regions(ax, mesh, colors.values, given)
        elif colors.of == "simplices":
            ax.tripcolor(x, y, mesh.simplices, facecolors=colors.values, **given)
        else:
            ax.tripcolor(x, y, mesh.simplices, colors.values, **{"shading": "gouraud", **given})
        if lines:
            color = lines.pop("edgecolor", "black")
            ax.triplot(x, y, mesh.simplices, **{"linewidth": 0.5, "color": color, **lines})
    if len(mesh.segments):
        ax.add_collection(LineCollection(mesh.points[mesh.segments], colors="black", linewidths=1))
    if colors is None:
        ax.plot(x[inputs], y[inputs], "k.", markersize=2)
    ax.set_aspect("equal")
    return ax


def _fill_regions(ax: Any, mesh: Any, labels: np.ndarray, given: dict) -> None:
    """Fill the triangles of each region with a colour, under the name of its physical group."""
    import matplotlib
    from matplotlib.collections import PolyCollection

    corners, values = mesh.points[mesh.simplices], np.unique(labels)
    palette = given.pop("cmap", None)
    colors = [f"C{at}" for at in range(len(values))]
    if palette is not None:
        palette = matplotlib.colormaps[palette] if isinstance(palette, str) else palette
        colors = list(palette(np.linspace(0, 1, len(values))))
    for value, color in zip(values.tolist(), colors):
        # With edges of the same colour no gaps show between triangles.
        style = {"facecolor": color, "edgecolor": "face", "linewidth": 0.3, "label": f"region_{value}"}
        ax.add_collection(PolyCollection(corners[labels == value], **{**style, **given}))
    ax.autoscale_view()


def plot_space(
    mesh: Any, colors: Optional[Colors], plotter: Any, clip: Any, off_screen: Optional[bool], arguments: dict
) -> Any:
    """Add tetrahedra of the core of a mesh to a plotter of PyVista, cut open by a plane."""
    import pyvista

    cells = {10: mesh.simplices.astype(np.int64)}
    grid = pyvista.UnstructuredGrid(cells, mesh.points)
    given = {"show_edges": True, **in_space(arguments)}
    if colors is not None:
        data = grid.point_data if colors.of == "vertices" else grid.cell_data
        data[colors.name] = colors.values
        given = {"scalars": colors.name, **given}
        if colors.of == "regions":
            given = {"categories": True, "cmap": "tab10", **given}
    plane = clip_plane(clip, mesh.points)
    plotter = space_plotter(plotter, off_screen)
    if plane is None:
        plotter.add_mesh(grid, **given)
        return plotter
    normal, origin = plane
    if plotter.off_screen:
        plotter.add_mesh(grid.clip(normal=normal, origin=origin, crinkle=True), **given)
    else:
        plotter.add_mesh_clip_plane(grid, normal=normal, origin=origin, crinkle=True, **given)
    return plotter


def space_plotter(plotter: Any, off_screen: Optional[bool]) -> Any:
    """Return the plotter to draw on, a new one without any."""
    import pyvista

    return pyvista.Plotter(off_screen=off_screen) if plotter is None else plotter


def in_space(arguments: dict) -> dict:
    """Return keywords of PyVista, some of which may have Matplotlib's names."""
    found = {}
    for name, value in keywords(arguments).items():
        full = _IN_SPACE.get(name, name)
        if full in found:
            raise ArgumentTypeError(f"{full} is given under two names; give one of them")
        found[full] = value
    return found


def clip_plane(clip: Any, points: np.ndarray) -> Optional[tuple[np.ndarray, np.ndarray]]:
    """Return normal and origin of a plane; None for no plane."""
    if clip is False or clip is None:
        return None
    points = points_in_space(points)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2 if len(points) else np.zeros(3)
    normal, origin = clip if isinstance(clip, tuple) and len(clip) == 2 else (clip, middle)
    if isinstance(normal, str):
        if normal.lstrip("-") not in ("x", "y", "z") or len(normal) > 2:
            rule = "it must be 'x', '-x', 'y', '-y', 'z' or '-z'"
            raise InvalidArgumentError(f"clip is {normal!r}; {rule}")
        sign = -1.0 if normal[0] == "-" else 1.0
        return sign * np.eye(3)["xyz".index(normal[-1])], doubles(origin, "clip[1]")
    normal, origin = doubles(normal, "clip"), doubles(origin, "clip[1]")
    if normal.shape != (3,) or origin.shape != (3,) or not np.linalg.norm(normal) > 0:
        rule = "it must be a direction, three numbers that are not all 0, or one and a point"
        raise InvalidArgumentError(f"clip is {clip!r}; {rule}")
    return normal, origin


def refuse_others(dim: int, **given: Any) -> None:
    """Refuse arguments of plots that are not of this dimension."""
    for name, value in given.items():
        home = 2 if name == "ax" else 3
        if value is not None and home != dim:
            raise InvalidArgumentError(f"{name} is for {home}D; the mesh has dim = {dim}")


def smallest_angles(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return the smallest angle of each triangle, or dihedral angle of each tetrahedron, in degrees."""
    corners = points[cells] - points[cells[:, :1]]
    # Products of the smallest and the largest lengths are none of doubles.
    corners /= np.abs(corners).max(axis=(1, 2), keepdims=True, initial=0.0)
    if cells.shape[1] == 3:
        ahead = np.roll(corners, -1, axis=1) - corners
        behind = np.roll(corners, 1, axis=1) - corners
        cross = ahead[..., 0] * behind[..., 1] - ahead[..., 1] * behind[..., 0]
        angles = np.arctan2(np.abs(cross), (ahead * behind).sum(axis=-1))
    else:
        angles = np.stack([_dihedral_angle(corners, a, b) for a in range(4) for b in range(a)], axis=1)
    return np.degrees(angles.min(axis=1)) if len(cells) else np.empty(0)


def _dihedral_angle(corners: np.ndarray, a: int, b: int) -> np.ndarray:
    """Return the angle of tetrahedra at the edge between two of their vertices."""
    c, d = (i for i in range(4) if i not in (a, b))
    edge = corners[:, b] - corners[:, a]
    one = np.cross(edge, corners[:, c] - corners[:, a])
    other = np.cross(edge, corners[:, d] - corners[:, a])
    cross = np.linalg.norm(np.cross(one, other), axis=1)
    return np.arctan2(cross, (one * other).sum(axis=1))


def shortest_edges(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return the length of the shortest edge of each simplex."""
    corners = points[cells]
    pairs = [(a, b) for a in range(cells.shape[1]) for b in range(a)]
    lengths = [np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a, b in pairs]
    return np.min(lengths, axis=0)


def plot_shape(
    shape: Any, ax: Any, plotter: Any, off_screen: Optional[bool], arguments: dict
) -> Any:
    """Draw an alpha shape, its edges or triangles that are in nothing larger included."""
    mesh, filtration = shape._filtration._mesh, shape._filtration
    require_dimension(mesh._core)
    refuse_others(mesh.dim, ax=ax, plotter=plotter, off_screen=off_screen)
    lone = filtration.faces(mesh.dim - 1)[shape.classes(mesh.dim - 1) == _SINGULAR]
    if mesh.dim == 2:
        return _plot_flat_shape(shape, mesh.points[mesh.simplices[shape.simplices]], lone, ax, arguments)
    import pyvista

    triangles: Any = np.concatenate([shape.boundary, lone]).astype(np.int64)
    surface = pyvista.PolyData.from_regular_faces(shape.points, triangles)
    plotter = space_plotter(plotter, off_screen)
    plotter.add_mesh(surface.clean(), **{"show_edges": True, **in_space(arguments)})
    return plotter


def _plot_flat_shape(shape: Any, corners: Any, lone: np.ndarray, ax: Any, arguments: dict) -> Any:
    from matplotlib.collections import LineCollection, PolyCollection

    ax = plane_axes(ax)
    given = keywords(arguments)
    if "color" in given:
        given = {"facecolor": given["color"], **given}
        del given["color"]
    style = {"facecolor": "tab:blue", "edgecolor": "face", "linewidth": 0.3}
    ax.add_collection(PolyCollection(corners, **{**style, **given}))
    lines = shape.points[np.concatenate([shape.boundary, lone])]
    ax.add_collection(LineCollection(lines, colors="black", linewidths=1))
    ax.plot(*shape.points.T, "k.", markersize=2)
    ax.autoscale_view()
    ax.set_aspect("equal")
    return ax
