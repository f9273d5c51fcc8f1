"""Costs of small plans beside the best of many searches with other settings.

python benchmarks/optimality.py [--searches 30] [--phases 8 --phases 10] [--polish penalty] [--jobs N] [SCENE[/ROBOT] ...]

Every other search has a proximal weight and a first guess of the durations of its own, drawn from its seed; what it finds is
where a search with the default settings then begins, since the reference that a plan is drawn to, and with it its cost, depends
on that guess (how fast the CoM is to be). The ratio is the default's cost over that of the cheapest plan that any has solved.
Exit code 1 unless the median is at most 1.03 and the largest at most 1.08, and the default solves whatever any of them solves.
"""

from __future__ import annotations

import argparse
import math
import statistics
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import mcplan as mp
from mcplan_bench import records
from mcplan_bench.processes import each

SCENES = [
    "flat",
    "stairs",
    "gap",
    "gap_with_rail",
    "stepping_stones",
    "stairs_broad",
    "slope",
    "ramp",
    "short_gap",
    "turn",
    "yaw",
]
PHASES = [8, 10]
#: Ranges of the proximal weight and of the first guess of the durations over their box, both log-uniform.
PROXIMAL = (1.0, 300.0)
MEDIAN_MAX, LARGEST_MAX = 1.03, 1.08


@dataclass(frozen=True)
class Task:
    """A search; seed -1 is that with the default settings."""

    scene: str
    robot: str
    phases: int
    seed: int
    polish: str


@dataclass(frozen=True)
class Outcome:
    """What came of it."""

    solved: bool
    status: str
    cost: float
    cpu_s: float


def settings(seed: int, robot: mp.Robot) -> dict[str, Any]:
    """Options of a search, by its seed."""
    if seed < 0:
        return {}
    random = np.random.default_rng(seed)
    low, high = robot.phase_duration
    return {
        "proximal_weight": math.exp(random.uniform(*np.log(PROXIMAL))),
        "duration_initial_s": math.exp(random.uniform(*np.log((low, high)))),
    }


def solve(task: Task) -> Outcome:
    """Plan once."""
    robot = mp.load_robot(task.robot)
    begin = time.process_time()
    same = {"phases": task.phases, "polish": task.polish}
    result = mp.plan(task.scene, robot, seed=max(task.seed, 0), **same, **settings(task.seed, robot))
    if task.seed >= 0:
        result = mp.plan(task.scene, robot, warm_start=result.plan, **same)
    report = result.report
    return Outcome(str(report.status) == "solved", str(report.status), report.cost, time.process_time() - begin)


def row_of(name: str, phases: int, default: Outcome, others: list[Outcome]) -> records.Row:
    """The default beside the others; the ratio is infinite where it alone has no plan, and NaN where nobody has."""
    costs = sorted(other.cost for other in others if other.solved)
    best = costs[0] if costs else math.nan
    ratio = math.inf if costs and not default.solved else default.cost / best
    return {
        "plan": name,
        "phases": phases,
        "status": default.status,
        "cost": default.cost,
        "best": best,
        "ratio": ratio,
        "others_solved": len(costs),
        "others": len(others),
        "others_median": statistics.median(costs) if costs else math.nan,
        "cpu_s": default.cpu_s,
        "others_cpu_s": statistics.median(other.cpu_s for other in others),
    }


def print_row(row: records.Row) -> None:
    """One line of the table."""
    print(
        f"{row['plan']:28} {row['phases']:3d}  {row['status']:12} {row['cost']:9.4g} {row['best']:9.4g} "
        f"{row['ratio']:6.3f}  {row['others_solved']:2d} of {row['others']:2d}  {row['cpu_s']:6.2f} s",
        flush=True,
    )


def main() -> int:
    """Print a row for every plan, then the median and the largest ratio."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE[/ROBOT]")
    parser.add_argument("--phases", type=int, action="append", metavar="N", help="Number of phases; several.")
    parser.add_argument("--searches", type=int, default=30, metavar="N", help="Number of other searches a plan.")
    parser.add_argument(
        "--polish", choices=("penalty", "interior_point"), default="interior_point", help="What polishes plans."
    )
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    parser.add_argument("--out", type=Path, default=Path("out/optimality"), metavar="DIR", help="Folder for the CSV.")
    given = parser.parse_args()
    pairs = [(name, phases) for name in given.scenes for phases in given.phases or PHASES]
    searches = range(-1, given.searches)
    tasks = []
    for name, phases in pairs:
        scene, _, robot = name.partition("/")
        tasks += [Task(scene, robot or "humanoid44", phases, seed, given.polish) for seed in searches]
    print(f"{'plan':28} {'N':>3}  {'status':12} {'cost':>9} {'best':>9} {'ratio':>6}  {'solved':8}  {'CPU':>8}")
    outcomes: dict[int, Outcome] = {}
    rows: list[records.Row] = []
    for index, outcome in each(solve, tasks, given.jobs):
        outcomes[index] = outcome
        while len(rows) < len(pairs) and all(
            i in outcomes for i in range(len(rows) * len(searches), (len(rows) + 1) * len(searches))
        ):
            done = [outcomes[i] for i in range(len(rows) * len(searches), (len(rows) + 1) * len(searches))]
            rows.append(row_of(*pairs[len(rows)], done[0], done[1:]))
            print_row(rows[-1])
    records.write_csv(given.out / "optimality.csv", rows)
    ratios = [row["ratio"] for row in rows if not math.isnan(row["ratio"])]
    if not ratios:
        print("no plan was solved by any search")
        return 1
    median, largest = statistics.median(ratios), max(ratios)
    print(f"ratio of {len(ratios)} plans: median {median:.3f}, largest {largest:.3f}")
    return 0 if median <= MEDIAN_MAX and largest <= LARGEST_MAX else 1


if __name__ == "__main__":
    sys.exit(main())
