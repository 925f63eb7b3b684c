"""The time that meshes and triangulations take against the number of points."""

import csv

from look import COLORS, MARKERS, legend, panels, save, scale

MESHES = {
    ("2", "uniform"): "2D, uniform, 20.7 degrees",
    ("2", "sphere"): "2D, circle, 20.7 degrees",
    ("3", "uniform"): "3D, uniform, radius-edge 2",
    ("3", "sphere"): "3D, sphere, radius-edge 2",
}
MESHERS = ["netmesh", "TetGen", "Triangle", "CGAL Mesh_2", "CGAL Delaunay"]
TRIANGULATIONS = {
    ("2", "uniform"): "2D, uniform",
    ("2", "sphere"): "2D, circle",
    ("3", "uniform"): "3D, uniform",
    ("3", "sphere"): "3D, sphere",
}
TRIANGULATORS = ["netmesh", "CGAL Delaunay", "SciPy"]


def draw_meshes(times, out):
    """Draws what `mesh_times` and triangle_times.py print."""
    draw(times, out, MESHES, MESHERS)


def draw_triangulations(times, out):
    """Draws what triangulation_times.py prints."""
    draw(times, out, TRIANGULATIONS, TRIANGULATORS)


def draw(times, out, titles, meshers):
    """Draws microseconds a point, a panel for each dimension and distribution."""
    with open(times, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    figure, axes = panels(len(titles), columns=2)
    handles = {}
    for ax, (key, title) in zip(axes, titles.items(), strict=True):
        for mesher, marker in zip(meshers, MARKERS, strict=False):
            curve = sorted(
                (int(row["points"]), 1e6 * float(row["seconds"]) / int(row["points"]))
                for row in rows
                if (row["dim"], row["distribution"], row["mesher"]) == (*key, mesher)
            )
            if curve:
                x, y = zip(*curve, strict=True)
                (handles[mesher],) = ax.plot(x, y, color=COLORS[mesher], marker=marker)
        ax.set_title(title)
        ax.set_xlabel("points")
        ax.set_ylabel("microseconds a point, one thread")
        scale(ax.xaxis, "log")
        scale(ax.yaxis, "log")
    legend(figure, {mesher: handles[mesher] for mesher in meshers if mesher in handles}, 5)
    save(figure, out)
