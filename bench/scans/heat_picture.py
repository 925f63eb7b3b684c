"""Draws meshes with their temperatures, cut open by a plane along their longest axis, with PyVista."""

import numpy as np
import pyvista
from PIL import Image

PANEL, COLORS, COUNT = (420, 460), "plasma", 128
# Of each scan: the way to the eye, what is up, and the normal of the plane behind which the mesh is kept.
VIEWS = {
    "3holes": ((0.3, -0.35, 1), (0, 1, 0), (0, 0, 1)),
    "quadknot": ((0.1, -0.3, 1), (0, 1, 0), (0, 0, 1)),
    "humanoid": ((0.25, 0.2, 1), (0, 1, 0), (0, 0, 1)),
    "horse": ((-1, 0.3, 0.2), (0, 0, 1), (-1, 0, 0)),
    "blub_triangulated": ((1, 0.3, 0.35), (0, 1, 0), (1, 0, 0)),
}


def panel(mesh, u, scan):
    eye, up, normal = VIEWS[scan]
    grid = mesh.to_pyvista(point_data={"temperature": u})
    grid = grid.extract_cells(grid.celltypes == pyvista.CellType.TETRA)
    middles = mesh.points[mesh.simplices].mean(axis=1) @ np.array(normal)
    kept = grid.extract_cells(middles < np.median(mesh.points @ np.array(normal)))
    plotter = pyvista.Plotter(off_screen=True, window_size=PANEL)
    plotter.set_background("white")
    plotter.add_mesh(
        kept,
        scalars="temperature",
        cmap=COLORS,
        clim=(0, 1),
        show_edges=True,
        edge_color="#30303a",
        line_width=0.5,
        show_scalar_bar=False,
        ambient=0.35,
    )
    plotter.camera_position = [tuple(np.array(kept.center) + np.array(eye)), kept.center, up]
    plotter.reset_camera()
    plotter.camera.zoom(1.15)
    plotter.enable_anti_aliasing("ssaa")
    image = plotter.screenshot(return_img=True)
    plotter.close()
    return image


def draw(shown, path):
    """Writes a panel beside another for each scan, with as few colours as make a small file."""
    row = np.concatenate([panel(mesh, u, scan) for scan, (mesh, u) in shown.items()], axis=1)
    Image.fromarray(row).quantize(COUNT).save(path, optimize=True)
