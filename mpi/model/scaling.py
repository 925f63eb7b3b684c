#!/usr/bin/env python3
"""What a run would take on other numbers of ranks, and of other points: docs/scaling.md.

    mpirun -np 1 netmesh-mpi points.npy --work 1.csv
    mpirun -np 8 netmesh-mpi points.npy --work 8.csv
    scaling.py replay 1.csv 8.csv           # seconds on 1 to 8 ranks from those of one, beside 8.csv's
    scaling.py predict 1.csv 8.csv --points 1e9 --ranks 1024 [--bandwidth 1e9]

Seconds are processor time. All partitions of a phase wait for the slowest rank, so a run takes the sum
over the steps of what the slowest rank takes. Partitions are the same on any number of ranks: what
those of one rank take says what any ranks take.
"""

import argparse
import collections
import csv
import math

# The rules of the program: the least number of inputs of a partition in a large mesh, and of sampled
# ones; partitions are a multiple of FEW; one input in 32 is sampled, and a million at most.
LARGE = 1 << 19
SAMPLED = 1 << 10
FEW = 8
# In so many phases after the first there are as many partitions, then half as many from phase to phase.
WHOLE = 2


def one_of(points):
    return max(32, points // (1 << 20))


def partitions_of(points):
    return FEW * max(1, int(points // (FEW * max(LARGE, SAMPLED * one_of(points)))))


class Run:
    """The table that --work writes."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        self.ranks = 1 + max(int(row["rank"]) for row in rows)
        # Phase -> partition -> (rank, inputs, simplices, seconds).
        self.phases = collections.defaultdict(dict)
        self.steps = collections.defaultdict(list)
        self.sent = collections.Counter()
        for row in rows:
            rank, seconds = int(row["rank"]), float(row["seconds"])
            self.sent[row["step"]] += int(row["sent"])
            if row["step"] == "partition":
                made = (rank, int(row["inputs"]), int(row["simplices"]), seconds)
                self.phases[int(row["phase"])][int(row["partition"])] = made
            else:
                name = row["step"] + row["phase"]
                self.steps[name].append((int(row["inputs"]), int(row["simplices"]), seconds))

    def step(self, name, column=2):
        """What all ranks took together; of the coarse mesh, which all make alike, what one did."""
        whole = sum(row[column] for row in self.steps[name])
        return whole / self.ranks if name == "coarse" else whole

    def phase(self, phase, column):
        return sum(made[column] for made in self.phases[phase].values())


def owner(partition, count, ranks):
    return partition * ranks // count


def slowest(seconds_of_rank):
    return max(seconds_of_rank.values(), default=0.0)


def replayed(run, ranks):
    """Seconds of the slowest rank in each phase, if the partitions of `run` were made on `ranks`."""
    phases = []
    for phase in sorted(run.phases):
        made = run.phases[phase]
        load = collections.Counter()
        count = 1 + max(made)
        for partition, (_, _, _, seconds) in made.items():
            load[owner(partition, count, ranks)] += seconds
        phases.append(slowest(load))
    return phases


def measured(run):
    phases = []
    for phase in sorted(run.phases):
        load = collections.Counter()
        for rank, _, _, seconds in run.phases[phase].values():
            load[rank] += seconds
        phases.append(slowest(load))
    return phases


def total(run, phases, ranks):
    """Seconds of a run: the coarse mesh on all ranks, what is divided among them, the phases."""
    shared = ["inputs", "numbers"] + [name for name in run.steps if name.startswith("seams")]
    return run.step("coarse") + sum(phases) + run.step("rest") + sum(map(run.step, shared)) / ranks


def replay(one, others):
    print("ranks  partitions s  whole run s  speed-up  partitions as measured s  error")
    alone = total(one, replayed(one, 1), 1)
    known = {run.ranks: sum(measured(run)) for run in others}
    for ranks in sorted({1, 2, 4, 8, 16} | set(known)):
        phases = replayed(one, ranks)
        whole = total(one, phases, ranks)
        line = f"{ranks:5}  {sum(phases):12.2f}  {whole:11.2f}  {alone / whole:8.2f}"
        if ranks in known:
            line += f"  {known[ranks]:24.2f}  {sum(phases) / known[ranks] - 1:+5.0%}"
        print(line)


class Laws:
    """How the figures of a run grow with points and partitions, with what a run says of them."""

    def __init__(self, one, other, dim):
        self.dim = dim
        sampled = one.step("coarse", 0)
        self.points = one.phase(0, 1) + sampled
        self.per_sampled = one.step("coarse") / sampled
        self.per_point = (one.step("inputs") + one.step("numbers")) / self.points
        phases = sorted(one.phases)
        waiting = [one.phase(phase, 1) for phase in phases] + [0]
        simplices = [one.phase(phase, 2) for phase in phases]
        done = [waiting[at] - waiting[at + 1] for at in range(len(phases))]
        # An input that is inserted, with its share of Steiner points; a simplex that comes along.
        self.per_input = one.phase(0, 3) / done[0]
        rest = sum(one.phase(phase, 3) for phase in phases[1:]) - self.per_input * sum(done[1:])
        self.per_simplex = rest / sum(simplices[1:])
        # Thicknesses of what waits, and of what a seam has, in distances between inputs; by how much
        # both fall from phase to phase.
        count = len(one.phases[0])
        self.waiting = self.thickness(waiting[1] / self.points, count) / one_of(self.points) ** (1 / dim)
        self.all_simplices = one.step("numbers", 1)
        self.seam = self.thickness(simplices[1] / self.all_simplices, count)
        self.fall = [(b / a, d / c) for a, b, c, d in zip(waiting[1:], waiting[2:-1], simplices[1:], simplices[2:])]
        spread = 1 - 1 / other.ranks
        self.sent_per_simplex = other.sent["seams"] / sum(simplices[1:]) / spread
        self.sent_per_point = other.sent["inputs"] / self.points / spread
        self.sent_numbers = other.sent["numbers"] / simplices[1] / spread

    def inner(self, count):
        """The part of the faces of partitions that are not at the hull."""
        return 1 - count ** (-1 / self.dim)

    def thickness(self, part, count):
        side = (self.points / count) ** (1 / self.dim)
        return side * (1 - (1 - part) ** (1 / self.dim)) / (2 * self.inner(count))

    def part(self, thickness, points, count):
        """How much of the inputs lies so near to the faces of partitions."""
        side = (points / count) ** (1 / self.dim)
        return 1 - max(0.0, 1 - 2 * thickness * self.inner(count) / side) ** self.dim

    def seconds(self, points, ranks, bandwidth):
        count, sampled = partitions_of(points), points / one_of(points)
        share = math.ceil(count / ranks) / count
        coarse = self.per_sampled * sampled
        located = self.per_point * points / ranks
        waits = points * self.part(self.waiting * one_of(points) ** (1 / self.dim), points, count)
        simplices = self.all_simplices / self.points * points * self.part(self.seam, points, count)
        partitions = self.per_input * (points - waits) * share
        seams, moved, busy = 0.0, simplices * self.sent_numbers, count
        for phase in range(1, 64):
            fall = self.fall[min(phase, len(self.fall)) - 1]
            left = waits * fall[0] if busy > 1 else 0
            own = math.ceil(busy / ranks) / busy
            seams += own * (self.per_input * (waits - left) + self.per_simplex * simplices)
            moved += simplices * self.sent_per_simplex
            if busy == 1:
                break
            waits, simplices = left, simplices * fall[1]
            busy = busy if phase < WHOLE else max(1, busy // 2)
        sent = sampled * 8 * (1 + self.dim) + points / ranks * self.sent_per_point + moved / ranks
        return count, coarse, located, partitions, seams, sent / bandwidth, sent


def predict(laws, points, ranks, bandwidth):
    print("ranks  partitions  coarse  inputs, numbers  partitions  seams  sent  seconds  MB sent by a rank  speed-up")
    alone = sum(laws.seconds(points, 1, math.inf)[1:6])
    for number in ranks:
        count, *parts, sent = laws.seconds(points, number, bandwidth)
        coarse, located, partitions, seams, moved = parts
        print(
            f"{number:5}  {count:10}  {coarse:6.1f}  {located:15.1f}  {partitions:10.1f}  {seams:5.1f}  "
            f"{moved:4.1f}  {sum(parts):7.1f}  {sent / 1e6:17.0f}  {alone / sum(parts):8.0f}"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["replay", "predict"])
    parser.add_argument("one", help="the table of a run on one rank")
    parser.add_argument("others", nargs="+", help="those of runs on several")
    parser.add_argument("--dim", type=int, default=3)
    parser.add_argument("--points", type=float, default=1e9)
    parser.add_argument("--ranks", type=int, nargs="+", default=[64, 256, 1024, 4096])
    parser.add_argument("--bandwidth", type=float, default=1e9, help="bytes a second and rank")
    given = parser.parse_args()
    one, others = Run(given.one), [Run(path) for path in given.others]
    if given.what == "replay":
        replay(one, others)
    else:
        predict(Laws(one, others[-1], given.dim), given.points, given.ranks, given.bandwidth)


if __name__ == "__main__":
    main()
