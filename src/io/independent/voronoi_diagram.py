"""Prints the bits of the sites and the input of each, and checks the diagram against its definition.
Argument: the path."""
import json
import sys

import numpy

with open(sys.argv[1]) as file:
    diagram = json.load(file)
sites, corners = numpy.array(diagram["sites"]), numpy.array(diagram["corners"])
cells, dim = diagram["cells"], diagram["dim"]
assert (diagram["format"], diagram["version"]) == ("netmesh voronoi", 1)
assert sites.shape[1] == corners.shape[1] == dim
assert [cell["site"] for cell in cells] == list(range(len(sites)))
owners = [[] for _ in corners]
for cell in cells:
    for corner in cell["corners"]:
        owners[corner].append(cell["site"])
neighbors = [set() for _ in cells]
for corner, owning in zip(corners, owners):
    # A corner is as far from its cells' sites as from the nearest of all sites.
    distances = numpy.sqrt(((sites - corner) ** 2).sum(axis=1))
    assert len(owning) == dim + 1
    assert distances[owning].max() <= distances.min() * (1 + 1e-6)
    for site in owning:
        neighbors[site] |= set(owning) - {site}
assert [sorted(known) for known in neighbors] == [cell["neighbors"] for cell in cells]
# A cell is unbounded if its site is farther out than all others in some direction.
directions = numpy.random.default_rng(1).normal(size=(20000, dim))
outermost = set((directions @ sites.T).argmax(axis=1).tolist())
unbounded = {cell["site"] for cell in cells if cell["unbounded"]}
assert outermost <= unbounded if dim > 3 else outermost == unbounded
print(sites.astype("<f8").view("<u8").ravel().tolist())
print([4294967295 if cell["input"] is None else cell["input"] for cell in cells])
