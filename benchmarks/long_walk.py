"""A long walk under random commands and pushes: does the robot stay up, do plans stay young, does memory stay flat?

    python benchmarks/long_walk.py [--minutes 10] [--seeds 5] [--robot talos] [--newtons 100] [--keep 10] [--jobs 2]

A floor of 200 m by 200 m. Every 4 to 8 s another velocity is asked for: up to 0.2 m/s ahead, 0.05 m/s back or to a side, 0.15
rad/s about the vertical. Every 6 to 12 s a push of up to `--newtons` for 0.2 s in any direction. Latency is fixed, so that a
seed gives the same run on every machine. The last `--keep` seconds are recorded. Printed for each seed: whether it fell and
when, age of the oldest plan, replans and how many took longer than the latency, and memory of the process at each minute. Exit
code 1 after a fall.
"""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import mcplan as mp

HALF_FLOOR = 100.0
PUSH_S = 0.2


@dataclass
class Memory:
    """Resident memory of this process at each minute of the run [MB]."""

    at_minutes: list[float] = field(default_factory=list)

    def __call__(self, time_s: float, configuration: np.ndarray, plan: mp.Plan) -> None:
        """Look once a minute."""
        if time_s >= 60.0 * len(self.at_minutes):
            pages = int(Path("/proc/self/statm").read_text().split()[1])
            self.at_minutes.append(1e-6 * pages * os.sysconf("SC_PAGE_SIZE"))


@dataclass(frozen=True)
class Case:
    """One walk."""

    seed: int
    robot: str
    minutes: float
    newtons: float
    latency_s: float
    keep_s: float


def times(random: np.random.Generator, first: float, least: float, most: float, end: float) -> list[float]:
    """Instants from `first` to `end`, each `least` to `most` after the last [s]."""
    found = [first]
    while found[-1] + most < end:
        found.append(found[-1] + random.uniform(least, most))
    return found


def walk(case: Case) -> tuple[bool, str]:
    """Whether the robot fell in a case, and a line about it."""
    random = np.random.default_rng(case.seed)
    end = 60.0 * case.minutes
    commands = [
        (t, random.uniform(-0.05, 0.2), random.uniform(-0.05, 0.05), random.uniform(-0.15, 0.15))
        for t in times(random, 0.0, 4.0, 8.0, end)
    ]
    pushes = [
        (random.uniform(0.3, 1.0) * case.newtons, PUSH_S, t, random.uniform(0.0, 360.0))
        for t in times(random, 5.0, 6.0, 12.0, end - 2.0)
    ]
    scene = mp.load_scene("flat")
    scene.surfaces[0].vertices_W = HALF_FLOOR * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    memory = Memory()
    run = mp.run(
        mp.plan(scene, case.robot).plan,
        command=commands,
        push=pushes if case.newtons > 0.0 else [],
        duration=end,
        latency=case.latency_s,
        keep=case.keep_s,
        watch=memory,
    )
    m, o = run.measures, run.online
    ended = f"fell at {m.completed_s:.2f} s" if m.fell else f"up for {m.completed_s:.0f} s"
    text = (
        f"seed {case.seed}: {ended}; oldest plan {o.oldest_plan_s:.2f} s, {o.replans_used} of {o.replans} replans, "
        f"{o.replan_ms_median:.0f} ms ({o.replan_ms_p99:.0f} ms in 99 %), {o.replans_late} late, {o.stops} stops; "
        f"memory {' '.join(f'{mb:.0f}' for mb in memory.at_minutes)} MB"
    )
    return m.fell, text


def main() -> int:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seeds", type=int, default=5, help="Number of walks.")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--robot", default="talos")
    parser.add_argument("--newtons", type=float, default=100.0, help="Largest push [N]; 0: none.")
    parser.add_argument("--latency", type=float, default=0.02, help="Time until a plan is followed [s].")
    parser.add_argument("--keep", type=float, default=10.0, help="Length of what is recorded, the end [s].")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    given = parser.parse_args()
    cases = [
        Case(seed, given.robot, given.minutes, given.newtons, given.latency, given.keep)
        for seed in range(given.first_seed, given.first_seed + given.seeds)
    ]
    fell = 0
    with ProcessPoolExecutor(given.jobs) as pool:
        for down, text in pool.map(walk, cases):
            print(text, flush=True)
            fell += down
    print(f"{len(cases) - fell} of {len(cases)} stayed up")
    return int(fell > 0)


if __name__ == "__main__":
    sys.exit(main())
