"""Walking with replanning, beside the same walk without: undisturbed scenes, and pushes over the gait.

python benchmarks/online.py [--robot talos] [--scenes flat stairs_broad ...] [--newtons 250] [--instants 12] [--directions 8]

Pushes act for 0.2 s on the base, at equally spaced instants of the third and fourth step. Every run is made with
and without replanning, in one process; a run ends a given time after its push. Latency is fixed, so that the outcome is the
same on every machine; how long replans took is printed beside it.
"""

from __future__ import annotations

import argparse
import json
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np

import mcplan as mp

PUSH_S = 0.2


@dataclass(frozen=True)
class Case:
    """One push; no newtons: none."""

    scene: str
    robot: str
    newtons: float
    at_s: float
    direction_deg: float
    latency_s: float
    after_s: float
    open_loop: bool


def first_plan(scene: str, robot: str) -> mp.Plan:
    """The plan that every run of a scene begins with."""
    return mp.plan(scene, robot).plan


def instants(plan: mp.Plan, count: int) -> list[float]:
    """Equally spaced times over two steps (four phases) in the middle of a walk, or its third and fourth [s]."""
    knots, middle = list(plan.knot_times()), min(len(plan.phases) // 2, 7)
    return [float(t) for t in np.linspace(knots[middle - 2], knots[middle + 2], count, endpoint=False)]


def run(case: Case) -> dict:
    """One case, with and without replanning."""
    plan = first_plan(case.scene, case.robot)
    told: dict = {"latency": case.latency_s}
    if case.newtons > 0.0:
        told["push"] = (case.newtons, PUSH_S, case.at_s, case.direction_deg)
        told["duration"] = min(case.at_s + case.after_s, plan.duration() + 1.0)
    row = {"scene": case.scene, "newtons": case.newtons, "at_s": case.at_s, "direction_deg": case.direction_deg}
    began = time.process_time()
    closed = mp.run(plan, **told)
    row["cpu_s"] = time.process_time() - began
    m, o = closed.measures, closed.online
    row |= {
        "up": not m.fell,
        "until_s": m.completed_s,
        "com_max_mm": 1e3 * m.com_max_m,
        "com_rms_mm": 1e3 * m.com_rms_m,
    }
    row |= {"replans": o.replans, "used": o.replans_used, "ms_median": o.replan_ms_median, "ms_p99": o.replan_ms_p99}
    row |= {"late": o.replans_late, "oldest_s": o.oldest_plan_s, "changes": o.contact_changes, "statuses": o.statuses}
    row |= {"self_contacts": m.self_contacts, "terrain_contacts": m.terrain_contacts}
    if case.open_loop:
        followed = mp.run(plan, replanning=False, **told)
        row |= {"open_up": not followed.measures.fell, "open_com_max_mm": 1e3 * followed.measures.com_max_m}
    return row


def main() -> None:
    """Run the cases."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="talos")
    parser.add_argument("--scenes", nargs="*", default=["flat", "stairs_broad", "stepping_stones"])
    parser.add_argument("--newtons", type=float, nargs="*", default=[250.0])
    parser.add_argument("--instants", type=int, default=12)
    parser.add_argument("--directions", type=int, default=8)
    parser.add_argument("--latency", type=float, default=0.02)
    parser.add_argument("--after", type=float, default=3.0, help="Length of a run after its push [s].")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--open-loop", action=argparse.BooleanOptionalAction, default=True)
    parser.add_argument("--json", default=None, help="File for the rows, one JSON object a line.")
    arguments = parser.parse_args()
    cases = [
        Case(scene, arguments.robot, 0.0, 0.0, 0.0, arguments.latency, 0.0, arguments.open_loop)
        for scene in arguments.scenes
    ]
    times = instants(first_plan("flat", arguments.robot), arguments.instants) if arguments.newtons else []
    for newtons in arguments.newtons:
        for at_s in times:
            for i in range(arguments.directions):
                direction = 360.0 * i / arguments.directions
                cases.append(
                    Case(
                        "flat",
                        arguments.robot,
                        newtons,
                        at_s,
                        direction,
                        arguments.latency,
                        arguments.after,
                        arguments.open_loop,
                    )
                )
    with ProcessPoolExecutor(arguments.jobs) as pool:
        rows = []
        for row in pool.map(run, cases):
            rows.append(row)
            print(json.dumps(row), flush=True)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            file.writelines(json.dumps(row) + "\n" for row in rows)
    for newtons in arguments.newtons:
        pushed = [row for row in rows if row["newtons"] == newtons]
        text = f"{newtons:.0f} N: {sum(r['up'] for r in pushed)} of {len(pushed)} up with replanning"
        if arguments.open_loop:
            text += f", {sum(r['open_up'] for r in pushed)} without"
        print(text)


if __name__ == "__main__":
    main()
