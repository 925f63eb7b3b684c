"""One input through netmesh or Triangle, in processes of their own: what crashes or has no end ends alone."""

import ctypes
import itertools
import json
import math
import os
import re
import resource
import signal
import time
import traceback

import chains
from library import Mesh, Refusal

OPTIONS = [
    {"min_angle": angle, "extent": f"NM_EXTENT_{extent}", "crossings": f"NM_CROSSINGS_{crossings}"}
    for angle, extent, crossings in itertools.product(
        (0, 30), ("ALL", "BOX", "HULL", "BOUNDARY"), ("SPLIT", "REFUSE"))
]
# Names of fields in which a result may say how many inputs were taken as on segments, and how far they were.
OWN_FIELD = re.compile("near_input|snap|on_segment|incident|farthest|moved")
STRUCTS = ("counts", "quality", "stats")
MOST_MEMORY = 4 << 30
# Triangle meshes any of these in milliseconds, if at all.
TRIANGLES_SECONDS = 2


def outcome(library, points, segments, options, settings):
    """Runs an input and returns its outcome: a name, and what is known."""
    begun = time.perf_counter()
    with Mesh(library, points, segments) as mesh:
        try:
            mesh.run(max_vertices=settings.vertices + 100 * len(points), **options)
        except Refusal as refusal:
            name = refused(refusal, points, segments, settings.near)
            return {"outcome": name, "message": str(refusal), "seconds": time.perf_counter() - begun}
        seconds = time.perf_counter() - begun
        report = mesh.filled("validate", ctypes.c_uint32(3))
        made = {"outcome": "ok", "seconds": seconds, "own": own_fields(mesh)}
        if report.level != 3 or report.violations:
            made |= {"outcome": "certificate", "message": report.message.decode()}
        made["ulps"], broken = measured(mesh, points, segments, options, settings.bound)
        if made["outcome"] == "ok" and broken:
            made |= {"outcome": "chain", "message": f"{broken} segments have no chain"}
        elif made["outcome"] == "ok" and made["ulps"] > settings.bound:
            made |= {"outcome": "chain", "message": f"a chain is {made['ulps']} units from its segment"}
        return made


def refused(refusal, points, segments, near):
    """Returns the outcome for a refusal; what no mesh can answer is none."""
    if refusal.name == "NM_LIMIT" and "max_vertices" in refusal.message or refusal.name == "NM_OUT_OF_MEMORY":
        return "endless"
    if "enclose nothing" in refusal.message or "area" in refusal.message:
        return "nothing inside"
    crossing = re.search(r"segments\[(\d+)\] and segments\[(\d+)\] cross", refusal.message)
    numbers = [int(number) for number in crossing.groups()] if crossing else []
    # Numbers beyond them are sides of a hull or box.
    if numbers and max(numbers) < len(segments):
        pair = ([points[end] for end in segments[number]] for number in numbers)
        if chains.really_cross(*pair, near):
            return "crossing"
    return "refused"


def own_fields(mesh):
    """Returns what the result itself says of points taken as on segments: values by field."""
    made = {}
    for name in STRUCTS:
        fields = [field for field, _ in mesh.library.structs[f"nm_{name}"]._fields_ if OWN_FIELD.search(field)]
        if fields:
            filled = mesh.filled(name)
            made |= {f"{name}.{field}": getattr(filled, field) for field in fields}
    return made


def measured(mesh, points, segments, options, bound):
    """Returns how far chains are from their segments, in units, and how many segments have none."""
    flat = mesh.array("points", ctypes.c_double)
    vertices = list(zip(flat[::2], flat[1::2]))
    of_inputs = mesh.array("input_vertices", ctypes.c_uint32)
    pieces = mesh.array("segments", ctypes.c_uint32)
    parents = mesh.array("segment_parents", ctypes.c_uint32)
    near_vertex = replacements(mesh, points, vertices, of_inputs, bound)
    ends = [tuple(near_vertex.get(end, of_inputs[end]) for end in segment) for segment in segments]
    lines = [tuple(points[end] for end in segment) for segment in segments]
    pieces = list(zip(pieces[::2], pieces[1::2]))
    is_cut = options["extent"] == "NM_EXTENT_BOUNDARY"
    return chains.farthest(vertices, lines, ends, pieces, parents, is_cut)


def replacements(mesh, points, vertices, of_inputs, bound):
    """Returns for inputs that no triangle has the nearest vertex that one has, within the bound. Where both sides of a hull or box
    go through that vertex, the spike between is no part of the domain, and its edges are not listed."""
    used = set(mesh.array("simplices", ctypes.c_uint32))
    made = {}
    for number, point in enumerate(points):
        if of_inputs[number] not in used:
            steps = {vertex: max(abs(p - q) for p, q in zip(vertices[vertex], point)) for vertex in used}
            nearest = min(steps, key=steps.get)
            if steps[nearest] <= bound * math.ulp(max(map(abs, point))):
                made[number] = nearest
    return made


def limit(seconds):
    """Lets this process end after so many seconds of its processor, or, if it waits, after ten times as long."""
    signal.setitimer(signal.ITIMER_PROF, seconds)
    signal.alarm(10 * seconds)


def is_endless(status):
    """Returns true if a process' status says that its time was over."""
    return -status in (signal.SIGPROF, signal.SIGALRM)


def in_child(seconds, work):
    """Runs `work` in a process of its own, which hands over dictionaries one after the other, each within the
    time. Returns them, and the signal or status that ended it."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        status = 1
        try:
            # Triangle prints what it does not like.
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            with os.fdopen(write, "w") as file:
                limit(seconds)
                for made in work():
                    file.write(json.dumps(made) + "\n")
                    file.flush()
                    limit(seconds)
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    os.close(write)
    with os.fdopen(read) as file:
        made = [json.loads(line) for line in file if line.endswith("\n")]
    return made, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def netmesh_trials(library, points, segments, chosen, settings):
    """Returns an outcome for each of the chosen options."""
    made = []
    while len(made) < len(chosen):
        rest = chosen[len(made):]
        found, status = in_child(settings.seconds, lambda: (
            outcome(library, points, segments, options, settings) for options in rest))
        made += found
        if is_endless(status):
            made.append({"outcome": "endless", "message": f"no end in {settings.seconds} s"})
        elif status:
            made.append({"outcome": "crash", "message": f"status {status}"})
    return made


def triangle_trial(points, segments):
    """Returns what becomes of an input in Triangle."""
    def run():
        import triangle

        domain = {"vertices": points, "segments": segments}
        try:
            made = triangle.triangulate(domain, "pq20")
            yield {"outcome": "ok" if len(made.get("triangles", ())) else "nothing inside"}
        except RuntimeError:
            yield {"outcome": "fails"}

    made, status = in_child(TRIANGLES_SECONDS, run)
    if made:
        return made[0]["outcome"]
    return "endless" if is_endless(status) else "crash"
