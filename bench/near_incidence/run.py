"""Draws inputs that lie as near to segments as rounding brings them, runs them through netmesh, and prints a
line of a table for each kind; ends with 1 if any of them fails.

    python bench/near_incidence/run.py --library target/release/libnetmesh.so

NumPy, shapely and PyPI's triangle are needed. A failure is an input that is refused, has no end, ends the
process, fails its certificate at level 3, or has a chain farther from its segment than --bound. Each input is
run with --options of the sixteen combinations of least angle (none, 30), extent and crossings, in turn.
Segments that cross and were not to, and segments that enclose nothing, are no failure.
"""

import argparse
import collections
import functools
import json
import multiprocessing
import pathlib
import random
import sys

import drawn
import maps
import trials
from library import Library

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAILURES = ("refused", "endless", "certificate", "chain", "crash")
# Outcomes that are no failures, since no mesh can answer them.
OTHERS = ("crossing", "nothing inside")
CHUNK = 25


def arguments():
    """Parses the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    add = parser.add_argument
    add("--library", type=pathlib.Path, default=ROOT / "target/release/libnetmesh.so")
    add("--header", type=pathlib.Path, default=ROOT / "include/netmesh.h")
    add("--count", type=int, default=2000, help="inputs a row")
    add("--rows", default="", help="names or parts of names, separated by commas; all if empty")
    add("--options", type=int, default=2, help="combinations of options an input, of 16")
    add("--bound", type=float, default=16, help="how far a chain may be from its segment, in units in the last\n"
        "place of the larger coordinate of the segment's ends, along each axis")
    add("--near", type=float, default=3, help="segments cross if no end is so near to the other, in these units")
    add("--seed", type=int, default=1)
    add("--vertices", type=int, default=300000, help="max_vertices, beside 100 an input point")
    add("--seconds", type=int, default=20, help="time for a run with its certificate")
    add("--jobs", type=int, default=2, help="processes at a time")
    add("--triangle", type=int, default=200, help="inputs a row for Triangle's -pq20")
    add("--shared", type=pathlib.Path, default=ROOT.parent / "shared", help="where data/airports_us_lonlat.xy is")
    add("--atlas", type=pathlib.Path, default=ROOT / "target/near_incidence", help="where npm's world-atlas is kept")
    add("--failures", type=pathlib.Path, help="a file for inputs that fail, a line of JSON each")
    add("--input", type=int, help="this input of the rows alone, with what comes of it")
    return parser.parse_args()


def input_of(row, make, number, settings):
    """Returns the points and segments of an input, and the options that it is run with."""
    points, segments = make(random.Random(f"{settings.seed} {row} {number}"))
    # The step is odd, so that each combination has its turn.
    turns = range(number * settings.options, (number + 1) * settings.options)
    chosen = [trials.OPTIONS[turn * 5 % len(trials.OPTIONS)] for turn in turns]
    return points, segments, chosen


def chunk_of(numbers, row, make, library, settings):
    """Returns the outcomes of some inputs: number, input, options and what came of it."""
    made = []
    for number in numbers:
        points, segments, chosen = input_of(row, make, number, settings)
        for options, outcome in zip(chosen, trials.netmesh_trials(library, points, segments, chosen, settings)):
            outcome |= {"row": row, "input": number, "options": options}
            if outcome["outcome"] in FAILURES:
                outcome |= {"points": points, "segments": segments}
            made.append(outcome)
        if number < settings.triangle:
            made.append({"triangle": trials.triangle_trial(points, segments)})
    return made


class Row:
    """The figures of a row."""

    def __init__(self):
        self.counts, self.triangle = collections.Counter(), collections.Counter()
        self.ulps = self.seconds = self.angle_runs = 0
        self.own, self.first = {}, {}

    def add(self, outcome):
        """Counts an outcome."""
        if "triangle" in outcome:
            self.triangle[outcome["triangle"]] += 1
            return
        self.counts[outcome["outcome"]] += 1
        self.seconds = max(self.seconds, outcome.get("seconds", 0))
        if outcome["outcome"] in ("ok", "chain"):
            self.ulps = max(self.ulps, outcome["ulps"])
        for name, value in outcome.get("own", {}).items():
            before = self.own.get(name, (0, 0))
            self.own[name] = before[0] + value, max(before[1], value)
        if outcome["outcome"] in FAILURES:
            before = self.first.get(outcome["outcome"])
            if before is None or outcome["input"] < before["input"]:
                self.first[outcome["outcome"]] = outcome

    def cells(self):
        """Returns the line's cells."""
        yield sum(self.counts.values())
        yield from (self.counts[name] for name in (*FAILURES, *OTHERS))
        yield f"{self.ulps:.2f}"
        yield f"{self.seconds:.2f}"
        yield " ".join(f"{name} {total:g} (most {most:g})" for name, (total, most) in self.own.items())
        yield ", ".join(f"{count} {name}" for name, count in sorted(self.triangle.items()))


def chosen_rows(settings):
    """Returns the makers of the rows that were asked for."""
    made = {name: make for name, make in drawn.ROWS.items()} | maps.rows(settings.shared, settings.atlas)
    wanted = [word.strip() for word in settings.rows.split(",") if word.strip()]
    return {name: make for name, make in made.items() if not wanted or any(word in name for word in wanted)}


def show(rows, library, settings):
    """Prints one input and what comes of it."""
    for row, make in rows.items():
        points, segments, chosen = input_of(row, make, settings.input, settings)
        print(json.dumps({"row": row, "points": points, "segments": segments}))
        for options, outcome in zip(chosen, trials.netmesh_trials(library, points, segments, chosen, settings)):
            print(json.dumps({**options, **outcome}))


def main():
    settings = arguments()
    library = Library(settings.library, settings.header)
    rows = chosen_rows(settings)
    if settings.input is not None:
        return show(rows, library, settings)
    names = ["row", "runs", *FAILURES, *OTHERS, "most units", "most s", "own count", "Triangle -pq20"]
    print("| " + " | ".join(names) + " |\n|" + "---|" * len(names), flush=True)
    failures = open(settings.failures, "w", encoding="utf-8") if settings.failures else None
    failed = 0
    for name, make in rows.items():
        row = Row()
        numbers = range(settings.count)
        chunks = [numbers[first : first + CHUNK] for first in numbers[::CHUNK]]
        work = functools.partial(chunk_of, row=name, make=make, library=library, settings=settings)
        for outcome in (one for chunk in mapped(work, chunks, settings.jobs) for one in chunk):
            row.add(outcome)
            if failures and outcome.get("outcome") in FAILURES:
                failures.write(json.dumps(outcome) + "\n")
        print(f"| {name} | " + " | ".join(map(str, row.cells())) + " |", flush=True)
        for outcome in row.first.values():
            print(f"{name}: input {outcome['input']} {outcome['options']}: {outcome.get('message')}",
                  file=sys.stderr)
        failed += sum(row.counts[failure] for failure in FAILURES)
    return 1 if failed else 0


def mapped(work, chunks, jobs):
    """Applies `work` to all chunks, in processes that are forked from this one."""
    global the_work
    the_work = work
    with multiprocessing.get_context("fork").Pool(jobs) as pool:
        yield from pool.imap(do_the_work, chunks)


def do_the_work(chunk):
    """Calls what `mapped` was given: libraries and functions are not sent between processes."""
    return the_work(chunk)


if __name__ == "__main__":
    sys.exit(main())
