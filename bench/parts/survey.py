"""Meshes all surfaces of a folder with the defaults of parts, and tells what became of each.

    survey.py NETMESH FOLDER [--tetgen TETGEN] [--seconds S] [--jobs N] [--merge RATIO] > table.md

NETMESH and TETGEN are programs; TetGen gets `-pq2` and the same files, as far as it reads them. A
surface that NETMESH refuses is diagnosed. Times are those of the machine as it is: compare their
quotients.
"""
import argparse
import json
import re
import resource
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SURFACES = {".stl", ".off", ".obj", ".ply", ".poly"}


def run(command, seconds):
    """Return the exit status (None after a time limit), the text, the seconds and MiB at the peak."""
    before = time.perf_counter()
    limit = f"/usr/bin/time -f PEAK%M timeout {seconds} ".split()
    done = subprocess.run([*limit, *command], capture_output=True, text=True, errors="replace")
    taken = time.perf_counter() - before
    peak = re.search(r"PEAK(\d+)", done.stderr)
    status = None if done.returncode == 124 else done.returncode
    return status, done.stdout + done.stderr, taken, int(peak[1]) / 1024 if peak else 0.0


def meshed(arguments, path, folder):
    record = folder / "record.json"
    command = [arguments.netmesh, str(path), "--validate", "--json", str(record)]
    if arguments.merge:
        command += ["--merge", arguments.merge]
    status, text, taken, peak = run(command, arguments.seconds)
    if status is None:
        return f"no end in {arguments.seconds} s"
    if status in (0, 5) or record.exists():
        found = json.loads(record.read_text())
        certificate = "clean" if status == 0 else "**violated**"
        quality = found["quality"]
        left = {"below 10 degrees": quality["below_min_dihedral"], "forced": quality["forced"],
                "limited": quality["precision_limited"]}
        told = ", ".join(f"{count} {name}" for name, count in left.items() if count)
        return (f"{found['counts']['vertices']} vertices of {found['counts']['inputs']} points, "
                f"{taken:.2f} s, {peak:.0f} MiB, certificate {certificate}{told and '; ' + told}")
    diagnosis = run([arguments.netmesh, str(path), "--diagnose", str(folder / "bad.vtu")], arguments.seconds)[1]
    counts = re.findall(r"^(?:points|edges|faults)?\s+([\d ]+) (corner|edge|pair|triangle|facet)s? ([^\n;]*)", diagnosis, re.M)
    told = [f"{count} {thing}s {rest}" for count, thing, rest in counts if count.strip() != "0"]
    return "refused: " + ("; ".join(told) or text.strip().splitlines()[-1][:160])


def by_tetgen(arguments, path, folder):
    if not arguments.tetgen:
        return ""
    copy = folder / ("surface" + path.suffix.lower())
    copy.write_bytes(path.read_bytes())
    status, text, taken, peak = run([arguments.tetgen, "-pq2", str(copy)], arguments.seconds)
    nodes = folder / "surface.1.node"
    if status != 0 or not nodes.exists():
        return "no end" if status is None else f"fails ({status})"
    return f"{nodes.read_text().split()[0]} vertices, {taken:.2f} s, {peak:.0f} MiB"


def row(arguments, path):
    with tempfile.TemporaryDirectory() as own:
        folder = Path(own)
        return f"| {path.parent.name}/{path.name} | {meshed(arguments, path, folder)} | {by_tetgen(arguments, path, folder)} |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("netmesh")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--tetgen")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--merge")
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    files = sorted(path for path in arguments.folder.rglob("*") if path.suffix.lower() in SURFACES)
    print("| surface | netmesh | TetGen `-pq2` |\n|---|---|---|", flush=True)
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for line in pool.map(lambda path: row(arguments, path), files):
            print(line, flush=True)


if __name__ == "__main__":
    main()
