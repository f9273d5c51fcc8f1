"""Whole plans of the contact-sequence search with one thread and with several: wall clock, and whether they are the same.

python benchmarks/threads.py [--threads N] [SCENE[/ROBOT] ...]

The fastest of some runs by turns. Two threads gain nothing while something else has the second core.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np

import mcplan as mp

SCENES = ["flat", "stairs", "gap", "gap_with_rail", "slope", "gap_with_wall", "chimney", "turn", "flat/talos"]
REPEATS = 3


def timed(scene: str, robot: str, threads: int) -> tuple[float, mp.PlanResult]:
    """Wall clock of a plan [s], and the plan."""
    begin = time.perf_counter()
    result = mp.plan(scene, robot, threads=threads)
    return time.perf_counter() - begin, result


def same(one: mp.PlanResult, other: mp.PlanResult) -> bool:
    """Whether two plans and what was done for them are the same to the last bit."""
    rows = [[(row.index, row.merit, row.switches) for row in each.report.history] for each in (one, other)]
    states = [np.array([knot.com_W for knot in each.plan.knots]).tobytes() for each in (one, other)]
    sequences = [each.plan.contact_sequence() for each in (one, other)]
    return rows[0] == rows[1] and states[0] == states[1] and bool(np.array_equal(sequences[0], sequences[1]))


def main() -> int:
    """Print a row for every scene; 1 if any plan hangs on the number of threads."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE[/ROBOT]")
    parser.add_argument("--threads", type=int, default=2, metavar="N")
    given = parser.parse_args()
    print(f"{'plan':24} {'1 thread':>10} {given.threads:>2} threads  ratio  same")
    differ = False
    for name in given.scenes:
        scene, _, robot = name.partition("/")
        robot = robot or "humanoid44"
        runs = [(timed(scene, robot, 1), timed(scene, robot, given.threads)) for _ in range(REPEATS)]
        one, several = (min(run[side][0] for run in runs) for side in (0, 1))
        equal = all(same(runs[0][0][1], run[1][1]) for run in runs)
        differ = differ or not equal
        print(f"{name:24} {one:8.3f} s {several:8.3f} s  {several / one:5.2f}  {'yes' if equal else 'NO'}", flush=True)
    return int(differ)


if __name__ == "__main__":
    sys.exit(main())
