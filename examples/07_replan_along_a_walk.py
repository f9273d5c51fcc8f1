"""Replan 100 times along a walk, every time from a state that is off, and draw all plans into one page."""

import random
import statistics
import time
from collections import Counter
from pathlib import Path

import numpy as np

import mcplan as mp

REPLANS, SEED = 100, 1
COM_NOISE_M, VELOCITY_NOISE_M_S = 0.005, 0.03  # standard deviations


def measure(plan: mp.Plan, t: float, noise: random.Random) -> tuple[mp.model.Knot, list[int]]:
    """What a state estimator would say: the planned state with noise, and what each end-effector touches."""
    now = plan.at(t)
    off = [noise.gauss(0.0, 1.0) for _ in range(4)]
    knot = mp.model.Knot(
        com_W=now.com_W + COM_NOISE_M * np.array([off[0], off[1], 0.0]),
        com_velocity_W=now.com_velocity_W + VELOCITY_NOISE_M_S * np.array([off[2], off[3], 0.0]),
        base_rpy=now.base_rpy,
        base_rpy_rate=now.base_rpy_rate,
        angular_momentum_W=now.angular_momentum_W,
        end_effectors_W=[end.position_W for end in now.end_effectors],
        end_effector_velocities_W=[end.velocity_W for end in now.end_effectors],
        end_effector_yaw=[end.yaw for end in now.end_effectors],
    )
    return knot, [end.surface for end in now.end_effectors]


def page_of(plans: list[mp.Plan]) -> str:
    """The CoM of every plan from above, from blue (first) to red (last), and where the feet stand."""

    def place(point_W: np.ndarray) -> str:
        return f"{60 + 300 * point_W[0]:.1f},{200 - 300 * point_W[1]:.1f}"

    lines = []
    for i, plan in enumerate(plans):
        hue = 240 - 240 * i // (len(plans) - 1)
        com = " ".join(place(plan.at(t).com_W) for t in np.linspace(0.0, plan.duration(), 60))
        lines.append(f'<polyline points="{com}" fill="none" stroke="hsl({hue},80%,45%)" stroke-opacity="0.5"/>')
        for knot, phase in zip(plan.knots, plan.phases, strict=False):
            for foot, contact in zip(knot.end_effectors_W, phase.contacts, strict=False):
                if contact.surface >= 0:
                    x, y = place(foot).split(",")
                    lines.append(f'<circle cx="{x}" cy="{y}" r="2" fill="hsl({hue},80%,45%)" fill-opacity="0.4"/>')
    return (
        "<!doctype html><meta charset='utf-8'><title>100 replans of a walk</title>"
        "<p>CoM (lines) and footholds (dots) of every plan from above, from the first (blue) to the last (red).</p>"
        f"<svg viewBox='40 130 720 140' width='100%'>{''.join(lines)}</svg>"
    )


first = mp.plan("flat", "humanoid44").plan
plan, noise = first, random.Random(SEED)
plans, times, statuses = [first], [], Counter()
period = first.duration() / REPLANS
for _ in range(REPLANS):
    knot, contacts = measure(plan, min(period, plan.duration()), noise)
    begin = time.process_time()
    result = mp.replan(plan, min(period, plan.duration()), knot, contacts=contacts)
    times.append(1e3 * (time.process_time() - begin))
    statuses[result.report.status.name] += 1
    if result.report.kept_until_s > period:  # otherwise the plan under way goes on
        plan = result.plan
    plans.append(plan)

Path("replans.html").write_text(page_of(plans), encoding="utf-8")
print(
    f"seed {SEED}: {dict(statuses)}, {statistics.median(times):.1f} ms of processor time in the median, {max(times):.1f} at most"
)
print("all plans are drawn in replans.html")
if statuses["solved"] < 0.97 * REPLANS:
    raise SystemExit(1)
