"""Prints parents, centres, the bits of radii and of centres' points, and the cage of each vertex; checks
children. Argument: the path, the number of vertices."""
import json
import sys

import numpy

with open(sys.argv[1]) as file:
    hierarchy = json.load(file)
domains, none = hierarchy["domains"], 4294967295
assert (hierarchy["format"], hierarchy["version"]) == ("netmesh domains", 1)
assert [domain["domain"] for domain in domains] == list(range(len(domains)))
for domain in domains:
    below = [other["domain"] for other in domains if other["parent"] == domain["domain"]]
    assert domain["children"] == below
print([none if domain["parent"] is None else domain["parent"] for domain in domains])
print([domain["center"] for domain in domains])
print(numpy.array([domain["radius"] for domain in domains], "<f8").view("<u8").tolist())
print(numpy.array([domain["point"] for domain in domains], "<f8").view("<u8").ravel().tolist())
cages = [none] * int(sys.argv[2])
for domain in domains:
    for vertex in domain["cage"]:
        assert cages[vertex] == none
        cages[vertex] = domain["domain"]
print(cages)
