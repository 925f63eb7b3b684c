"""Meshes all surfaces of folders, beside TetGen, and tells what became of each.

    survey.py NETMESH FOLDER... [--peer PYTHON] [--seconds S] [--merge RATIO] [--jobs N] > table.md

NETMESH is the program: with its defaults for parts, and once more with `--min-dihedral 0`, which is
what TetGen's `-pq2` asks for. PYTHON has numpy, pillow, tetgen and trimesh of PyPI, for peer.py. A surface that
NETMESH refuses is diagnosed, and tried with `--crossings split`. Seconds are those of a processor.
N surfaces are meshed at a time. The table is docs/surfaces.md's; below it are sums, and what has no mesh.
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
    "| surface | points | vertices | forced | TetGen | beyond | not Delaunay | seconds | TetGen | MiB | TetGen "
    "| vertices, 10 degrees | below 10 | seconds |"
)
# Seconds below which a ratio of times is mostly one of starts.
SHORT = 0.05


def run(command, seconds, folder=None):
    """Runs a command, in a folder if one is given, for the files that it leaves. Returns the exit
    status (None after a time limit), the text, the seconds and MiB at the peak.
    """
    with tempfile.TemporaryFile("w+", errors="replace") as text:
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))  # noqa: E731
        child = subprocess.Popen(command, stdout=text, stderr=subprocess.STDOUT, preexec_fn=limit, cwd=folder)
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


def by_peer(arguments, path, folder):
    if not arguments.peer:
        return None, ""
    command = [arguments.peer, str(Path(__file__).parent.resolve() / "peer.py"), str(path.resolve())]
    status, text, _, _ = run(command, arguments.seconds, folder)
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


def survey(arguments, path):
    """Returns the records of the three meshes of a surface, and what keeps it from having ours."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        parts, why = mesh(arguments, path, [], folder)
        plain, why_not_plain = mesh(arguments, path, ["--min-dihedral", "0"], folder)
        if parts is None and plain is None:
            return path, None, None, None, f"{why[:90]}; {diagnosis(arguments, path, folder)}"
        peer, _ = by_peer(arguments, path, folder)
    return path, plain, parts, peer, why or why_not_plain


def row(path, plain, parts, peer):
    """Returns the line of a surface in the table."""
    inputs = (plain or parts)["counts"]["inputs"]
    own = plain and {
        "vertices": f"{plain['counts']['vertices']}{'' if plain['is_clean'] else ' **violated**'}",
        "forced": plain["quality"]["forced"],
        "seconds": f"{plain['seconds']:.2f}",
        "mib": f"{plain['mib']:.0f}",
    }
    angled = parts and {
        "vertices": f"{parts['counts']['vertices']}{'' if parts['is_clean'] else ' **violated**'}",
        "below": parts["quality"]["below_min_dihedral"],
        "seconds": f"{parts['seconds']:.2f}",
    }
    other = peer and {**peer, "seconds": f"{peer['seconds']:.2f}", "mib": f"{peer['peak_mib']:.0f}"}
    cells = [
        *((own, name) for name in ("vertices", "forced")),
        *((other, name) for name in ("vertices", "beyond_bound", "not_delaunay")),
        *((of, name) for name in ("seconds", "mib") for of in (own, other)),
        *((angled, name) for name in ("vertices", "below", "seconds")),
    ]
    return f"| {' | '.join(map(str, [path.name, inputs, *(of[name] if of else '' for of, name in cells)]))} |"


def summary(found):
    """Returns sums over the surfaces, and ratios to TetGen's where it ends and takes a while."""
    meshes = [record for _, plain, parts, _, _ in found for record in (plain, parts) if record]
    plain = [plain for _, plain, *_ in found if plain]
    angled = [parts for _, _, parts, *_ in found if parts]
    lines = [
        f"{len(found)} surfaces, of {len(meshes)} meshes {sum(m['is_clean'] for m in meshes)} with a clean certificate.",
        f"Ours with `--min-dihedral 0`: {len(plain)}, {sum(p['counts']['vertices'] for p in plain)} vertices, "
        f"{sum(p['quality']['forced'] for p in plain)} cells forced; with 10 degrees: {len(angled)}.",
    ]
    both = [one for one in found if one[1] and one[3]]
    if not both:
        return "\n".join(lines)
    own, given = (sum(of(one) for one in both) for of in (lambda b: b[1]["counts"]["vertices"], lambda b: b[3]["vertices"]))
    lines.append(
        f"TetGen ends on {len(both)}, with {given} vertices where ours have {own}, "
        f"{sum(t['beyond_bound'] for *_, t, _ in both)} cells beyond the bound and "
        f"{sum(t['not_delaunay'] for *_, t, _ in both)} faces that are not Delaunay."
    )
    long = [one for one in both if one[3]["seconds"] >= SHORT]
    ratios = {
        "vertices over TetGen's": [(p["counts"]["vertices"] / t["vertices"], path) for path, p, _, t, _ in both],
        "the same where TetGen keeps the bound": [
            (p["counts"]["vertices"] / t["vertices"], path) for path, p, _, t, _ in both if t["beyond_bound"] == 0
        ],
        f"seconds over TetGen's of {SHORT} and more": [(p["seconds"] / t["seconds"], path) for path, p, _, t, _ in long],
        "the same with 10 degrees": [(r["seconds"] / t["seconds"], path) for path, _, r, t, _ in long if r],
    }
    for name, values in ratios.items():
        if values:
            worst, path = max(values)
            median = statistics.median(value for value, _ in values)
            most = sum(value > 1 for value, _ in values)
            lines.append(f"{name}: median {median:.2f}, above 1 on {most} of {len(values)}, worst {worst:.2f} ({path.name}).")
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
    print(HEAD + "\n" + "|---" * 14 + "|", flush=True)
    found, refused = [], []
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for one in pool.map(lambda path: survey(arguments, path), files):
            path, plain, parts, peer, why = one
            if plain or parts:
                found.append(one)
                print(row(path, plain, parts, peer), flush=True)
            if not (plain and parts):
                refused.append(f"- {path.name}: {why}")
    print("\n" + summary(found) + "\n\nWithout one or both of ours:\n\n" + "\n".join(refused))


if __name__ == "__main__":
    main()
