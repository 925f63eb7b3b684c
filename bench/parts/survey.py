"""Meshes all surfaces of folders, beside TetGen, and tells what became of each.

    survey.py NETMESH FOLDER... [--peer PYTHON] [--seconds S] [--merge RATIO] [--jobs N] > table.md

NETMESH is the program: with its defaults for parts, and once more with `--min-dihedral 0`, which is
what TetGen's `-pq2` asks for. PYTHON has numpy, trimesh and PyPI's tetgen, for peer.py. A surface that
NETMESH refuses is diagnosed, and tried with `--crossings split`. Seconds are those of a processor.
N surfaces are meshed at a time.
"""
import argparse
import json
import os
import re
import resource
import signal
import statistics
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SURFACES = {".stl", ".off", ".obj", ".ply", ".poly", ".smesh"}
HEAD = (
    "| surface | points | vertices | below 10 | forced | limited | least angle | seconds | MiB "
    "| vertices (0) | forced (0) | seconds (0) | TetGen | seconds | MiB | beyond | not Delaunay | least angle |"
)


def run(command, seconds):
    """Returns the exit status (None after a time limit), the text, the seconds and MiB at the peak."""
    with tempfile.TemporaryFile("w+", errors="replace") as text:
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))  # noqa: E731
        child = subprocess.Popen(command, stdout=text, stderr=subprocess.STDOUT, preexec_fn=limit)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        text.seek(0)
        told = text.read()
    took = used.ru_utime + used.ru_stime
    is_ended = child.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return None if is_ended else child.returncode, told, took, used.ru_maxrss / 1024


def mesh(arguments, path, options, folder):
    """Returns the record of a run with its seconds and MiB; without one the message."""
    file = folder / "record.json"
    file.unlink(missing_ok=True)
    command = [arguments.netmesh, str(path), *options]
    if arguments.merge:
        command += ["--merge", arguments.merge]
    status, text, _, _ = run([*command, "--json", str(file), "--validate"], arguments.seconds)
    if status is None:
        return None, f"no end in {arguments.seconds} s"
    if not file.exists():
        return None, (text.strip().splitlines() or [f"status {status}"])[-1]
    record = json.loads(file.read_text())
    record["is_clean"] = status == 0 and record["report"]["violations"] == 0
    # Once more without the certificate and the quality, which take time and memory of their own.
    _, _, record["seconds"], record["mib"] = run([*command, "-q"], arguments.seconds)
    return record, ""


def by_peer(arguments, path):
    if not arguments.peer:
        return None, ""
    command = [arguments.peer, str(Path(__file__).parent / "peer.py"), str(path)]
    status, text, _, _ = run(command, arguments.seconds)
    if status is None:
        return None, "no end"
    if status != 0:
        last = text.strip().splitlines()[-1:] or [""]
        return None, f"fails: {last[0][:60]}"
    return json.loads(text.strip().splitlines()[-1]), ""


def diagnosis(arguments, path, folder):
    """Returns the figures of a diagnosis that are not 0, and what splitting makes of the surface."""
    _, text, _, _ = run([arguments.netmesh, str(path), "--diagnose", str(folder / "bad.vtu")], arguments.seconds)
    lines = re.findall(r"^(?:points|edges|faults)?\s+(\d[\d ]* (?:corner|edge|pair|triangle|facet)[^\n;]*)", text, re.M)
    told = [line for line in lines if not line.startswith("0 ")]
    split, why = mesh(arguments, path, ["--crossings", "split"], folder)
    if split is None:
        became = f"split: {why[:100]}"
    else:
        became = f"split: {split['counts']['vertices']} vertices, {'clean' if split['is_clean'] else '**violated**'}"
    return f"{'; '.join(told)}; {became}"


def row(arguments, path):
    """Returns the line of a surface, and what was found if it was meshed."""
    with tempfile.TemporaryDirectory() as folder:
        return row_in(arguments, path, Path(folder))


def row_in(arguments, path, folder):
    name = f"{path.parent.name}/{path.name}"
    record, why = mesh(arguments, path, [], folder)
    if record is None:
        return f"| {name} | {why[:90]}; {diagnosis(arguments, path, folder)} |", None
    plain, _ = mesh(arguments, path, ["--min-dihedral", "0"], folder)
    quality = record["quality"]
    own = [
        record["counts"]["inputs"],
        f"{record['counts']['vertices']}{'' if record['is_clean'] else ' **violated**'}",
        quality["below_min_dihedral"],
        quality["forced"],
        quality["precision_limited"],
        f"{quality['min_angle_degrees']:.3g}",
        f"{record['seconds']:.2f}",
        f"{record['mib']:.0f}",
        plain["counts"]["vertices"] if plain else "",
        plain["quality"]["forced"] if plain else "",
        f"{plain['seconds']:.2f}" if plain else "",
    ]
    peer, why = by_peer(arguments, path)
    found = (name, record, plain, peer)
    if peer is None:
        return f"| {name} | {' | '.join(map(str, own))} | {why} |", found
    others = [
        peer["vertices"],
        f"{peer['seconds']:.2f}",
        f"{peer['peak_mib']:.0f}",
        peer["beyond_bound"],
        peer["not_delaunay"],
        f"{peer['min_angle_degrees']:.3g}",
    ]
    return f"| {name} | {' | '.join(map(str, own))} | {' | '.join(map(str, others))} |", found


def summary(found):
    both = [(name, record, plain, peer) for name, record, plain, peer in found if plain and peer]
    clean = sum(record["is_clean"] for _, record, _, _ in found)
    lines = [f"{len(found)} were meshed, {clean} of these with a clean certificate."]
    plain = [plain for _, _, plain, _ in found if plain]
    lines.append(
        f"With `--min-dihedral 0` {len(plain)} have {sum(p['counts']['vertices'] for p in plain)} vertices, and "
        f"{sum(p['quality']['forced'] for p in plain)} cells that small angles excuse."
    )
    if both:
        ratios = {
            "vertices (0) over TetGen's": [p["counts"]["vertices"] / t["vertices"] for _, _, p, t in both],
            "vertices over TetGen's": [r["counts"]["vertices"] / t["vertices"] for _, r, _, t in both],
            "seconds (0) over TetGen's": [p["seconds"] / max(t["seconds"], 1e-3) for _, _, p, t in both],
            "seconds over TetGen's": [r["seconds"] / max(t["seconds"], 1e-3) for _, r, _, t in both],
        }
        for what, values in ratios.items():
            worst = both[values.index(max(values))][0]
            lines.append(f"{what}: median {statistics.median(values):.2f}, worst {max(values):.2f} ({worst}).")
        beyond = sum(t["beyond_bound"] > 0 for *_, t in both)
        not_delaunay = sum(t["not_delaunay"] > 0 for *_, t in both)
        own, given = (sum(of(one) for one in both) for of in (lambda b: b[2]["counts"]["vertices"], lambda b: b[3]["vertices"]))
        lines.append(f"Where TetGen ends: {own} vertices (0), and {given} of TetGen's.")
        lines.append(f"Of TetGen's {len(both)}, {beyond} have cells beyond the bound, {not_delaunay} are not Delaunay inside.")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("netmesh")
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--peer")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--merge")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    paths = (path for folder in arguments.folders for path in folder.rglob("*"))
    files = sorted(path for path in paths if path.suffix.lower() in SURFACES)
    print(HEAD + "\n" + "|---" * 18 + "|", flush=True)
    found = []
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for line, one in pool.map(lambda path: row(arguments, path), files):
            print(line, flush=True)
            if one is not None:
                found.append(one)
    print("\n" + summary(found))


if __name__ == "__main__":
    main()
