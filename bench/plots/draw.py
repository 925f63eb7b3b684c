"""Draws the pictures of the documents with Matplotlib, as SVG.

    draw.py experiments FOLDER [OUT]    from the tables in FOLDER, which bench/experiments/run.sh writes
    draw.py times TIMES.csv OUT.svg     from what `mesh_times` and triangle_times.py print
    draw.py triangulations TIMES.csv OUT.svg    from what triangulation_times.py prints
    draw.py solid OUT.svg MESH.node NX NY NZ OFFSET CAPTION [MESH.node ...]
                                        meshes of TetGen's files, cut open by planes

These need the Python package netmesh as well:

    draw.py angles OUT.svg              dihedral angles of three meshes of the same points
    draw.py barcodes PROTEIN.xyz OUT.svg    persistence of three inputs (needs gudhi)
    draw.py scales OUT.svg              a mesh of three scales, a panel for each
    draw.py cage OUT.svg                the middle one of these and its cage
    draw.py points FILE OUT.svg X Y HALF-WIDTH [X Y HALF-WIDTH] ...
                                        the mesh of a file of points in the plane, a window each
"""

import sys
from pathlib import Path


def main(words):
    match words:
        case ["experiments", folder, *rest] if len(rest) <= 1:
            import experiments

            out = Path(*rest) if rest else Path(folder)
            experiments.draw_all(Path(folder), out)
        case ["times", times, out]:
            import speed

            speed.draw_meshes(times, out)
        case ["triangulations", times, out]:
            import speed

            speed.draw_triangulations(times, out)
        case ["solid", out, *rest] if rest and len(rest) % 6 == 0:
            import solid

            rows = [rest[at : at + 6] for at in range(0, len(rest), 6)]
            cuts = [(row[0], [float(x) for x in row[1:4]], float(row[4]), row[5]) for row in rows]
            solid.draw(out, cuts)
        case ["angles", out]:
            import angles

            angles.draw(out)
        case ["barcodes", protein, out]:
            import barcodes

            barcodes.draw(protein, out)
        case ["scales" | "cage" as name, out]:
            import plane

            plane.draw_sample(name, out)
        case ["points", file, out, *windows] if windows and len(windows) % 3 == 0:
            import plane

            plane.draw_file(file, out, [float(word) for word in windows])
        case _:
            sys.exit(__doc__)


main(sys.argv[1:])
