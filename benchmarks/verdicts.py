"""Is what `mcplan check --robot` says of a plan what a simulation shows?

    python benchmarks/verdicts.py [--jobs 2] [--out verdicts.csv]

Plans of TALOS and the G1 over built-in scenes at several scales, with and without joint limits of the legs, so that there are
walks and leaps. Each solved plan is held against the robot's joints (`mcplan check --robot`) and followed in simulation,
unassisted, with limits of torque and speed. A verdict `cannot` is right if the robot falls, or a joint is beyond its limit of
speed, or one of a leg at that of torque for 20 ms without a break; a verdict `can` is right if the robot comes to the end of its
plan. Printed: a line for each plan, and how many of each verdict are right. Exit code 1 if fewer than 90 % of those
called `cannot` are.
"""

from __future__ import annotations

import argparse
import csv
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, fields
from itertools import product
from pathlib import Path

import numpy as np

import mcplan as mp
from mcplan.files.scenes import scaled
from mcplan.kinematics.urdf_model import leg_velocities, load_model
from mcplan.tracking.feasibility import assess
from mcplan.tracking.measures import at_torque_limit
from mcplan.tracking.recording import Recording
from mcplan.tracking.runner import track

SCENES = ("flat", "stairs", "stairs_broad", "stairs_up", "short_gap", "gap", "stepping_stones", "turn_jump")
#: Factors on the lengths of scenes, which are drawn for TALOS: the G1 is 0.8 as tall.
SCALES = {"talos": (0.8, 1.0, 1.2), "g1": (0.6, 0.8, 1.0)}
RIGHT = 0.9
#: A joint that is at its limit of torque for longer lacks it [s].
LACKING = 0.02


@dataclass(frozen=True)
class Case:
    """What is planned."""

    robot: str
    scene: str
    scale: float
    joint_limits: bool


@dataclass(frozen=True)
class Outcome:
    """What a plan is called, by which limit, and what its simulation came to. Uses are ratios to limits."""

    robot: str
    scene: str
    scale: float
    joint_limits: bool
    status: str
    cost: float = float("nan")
    can: bool = False
    limits: str = ""
    worst_use: float = float("nan")
    fell: bool = False
    completed_s: float = float("nan")
    saturated_s: float = float("nan")
    velocity_use: float = float("nan")

    @property
    def exceeds(self) -> bool:
        """A joint of the simulated robot lacked torque, or was faster than it can be."""
        return self.saturated_s > LACKING or self.velocity_use > 1.0


def longest_saturation_s(run: Recording, robot: mp.Robot) -> float:
    """The longest time for which one joint of a leg stays at its limit of torque [s]; arms balance with what they have."""
    longest = 0
    for joint in at_torque_limit(run)[:, leg_velocities(load_model(robot))].T.astype(int):
        changes = np.flatnonzero(np.diff(joint, prepend=0, append=0))
        longest = max(longest, int((changes[1::2] - changes[::2]).max(initial=0)))
    return longest * float(np.median(np.diff(run.times_s)))


def measure(case: Case) -> Outcome:
    """Plan, assess, simulate."""
    scene, robot = scaled(mp.load_scene(case.scene), case.scale), mp.load_robot(case.robot)
    options = mp.ddp.Options(joint_limits=case.joint_limits, threads=1)
    planned = mp.plan(scene, robot, options)
    status = str(planned.report.status)
    if status != "solved":
        return Outcome(**asdict(case), status=status)
    found = assess(planned.plan, robot)
    result = track(planned.plan, robot)
    run = result.measures
    return Outcome(
        **asdict(case),
        status=status,
        cost=planned.report.cost,
        can=found.ok(),
        limits=" ".join(dict.fromkeys(f.name for f in found.violations())),
        worst_use=found.worst().use,
        fell=run.fell,
        completed_s=run.completed_s,
        saturated_s=longest_saturation_s(result.recording, robot),
        velocity_use=run.velocity_use,
    )


def line(o: Outcome) -> str:
    """One outcome."""
    limits = "limits" if o.joint_limits else "free"
    head = f"{o.robot:6} {o.scene:16} {o.scale:3.1f} {limits:6} {o.status:10}"
    if o.status != "solved":
        return head
    end = f"fell at {o.completed_s:.2f} s" if o.fell else "followed"
    called = "can" if o.can else f"cannot ({o.limits}, {o.worst_use:.2f})"
    return f"{head} J {o.cost:.3f} {called}: {end}, at torque limit {1e3 * o.saturated_s:.0f} ms, speed {o.velocity_use:.2f}"


def main() -> int:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    parser.add_argument("--out", type=Path, help="File for a table of all plans (.csv).")
    given = parser.parse_args()
    cases = [
        Case(robot, scene, scale, limits)
        for robot, scene, limits in product(SCALES, SCENES, (True, False))
        for scale in SCALES[robot]
    ]
    outcomes = []
    with ProcessPoolExecutor(given.jobs) as pool:
        for outcome in pool.map(measure, cases):
            outcomes.append(outcome)
            print(line(outcome), flush=True)
    if given.out:
        with given.out.open("w", newline="") as file:
            table = csv.DictWriter(file, [f.name for f in fields(Outcome)])
            table.writeheader()
            table.writerows(asdict(o) for o in outcomes)
    solved = [o for o in outcomes if o.status == "solved"]
    cannot = [o for o in solved if not o.can]
    can = [o for o in solved if o.can]
    right = [o for o in cannot if o.fell or o.exceeds]
    print(f"{len(solved)} of {len(outcomes)} solved")
    print(f"cannot: {len(right)} of {len(cannot)} right, {sum(o.fell for o in cannot)} of them fell")
    print(f"can: {sum(not o.fell for o in can)} of {len(can)} followed, {sum(o.exceeds for o in can)} at a limit")
    return int(len(right) < RIGHT * len(cannot))


if __name__ == "__main__":
    sys.exit(main())
