"""How `mp.replan` does from states that are not the planned ones; processor time, one thread.

python benchmarks/replanning.py [--draws 200] [--seed 0] [SCENE/ROBOT ...]

Every draw takes a random time of a plan and a random push (the CoM's velocity off by up to 0.3 m/s, its place by up to
3 cm, both level), and lets contacts that change within 50 ms be early or late by as much.
"""

from __future__ import annotations

import argparse
import random
import statistics
import time
from collections import Counter

import numpy as np

import mcplan as mp

CASES = [
    "flat/humanoid44",
    "stairs/humanoid44",
    "gap/humanoid44",
    "stepping_stones/humanoid44",
    "flat/talos",
    "flat/g1",
]
DV, DP, LATE_S = 0.3, 0.03, 0.05


def planned_state(plan: mp.Plan, t: float) -> tuple[mp.model.Knot, list[int]]:
    """The planned state at a time, and its contacts."""
    state = plan.at(t)
    knot = mp.model.Knot(
        com_W=state.com_W,
        com_velocity_W=state.com_velocity_W,
        base_rpy=state.base_rpy,
        base_rpy_rate=state.base_rpy_rate,
        end_effectors_W=[end.position_W for end in state.end_effectors],
        end_effector_velocities_W=[end.velocity_W for end in state.end_effectors],
        end_effector_yaw=[end.yaw for end in state.end_effectors],
    )
    knot.angular_momentum_W = state.angular_momentum_W
    return knot, [end.surface for end in state.end_effectors]


def draw(plan: mp.Plan, rng: random.Random) -> tuple[float, mp.model.Knot, list[int], str]:
    """A time, the state and the contacts measured then, and what is off."""
    t = rng.uniform(0.0, plan.duration())
    knot, contacts = planned_state(plan, t)
    angle, size = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.0, DV)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + size * np.array([np.cos(angle), np.sin(angle), 0.0])
    angle, size = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.0, DP)
    knot.com_W = np.array(knot.com_W) + size * np.array([np.cos(angle), np.sin(angle), 0.0])
    kind = "on time"
    other = t + rng.choice([-1.0, 1.0]) * LATE_S * rng.random()
    if 0.0 <= other <= plan.duration():
        ends = np.array(knot.end_effectors_W)
        velocities = np.array(knot.end_effector_velocities_W)
        for e, (now, then) in enumerate(zip(contacts, plan.at(other).end_effectors, strict=False)):
            if (now < 0) == (then.surface < 0):
                continue
            kind = "early" if other > t else "late"
            contacts[e] = then.surface
            ends[e] = then.position_W
            velocities[e] = then.velocity_W
        knot.end_effectors_W, knot.end_effector_velocities_W = ends, velocities
    return t, knot, contacts, kind


def undisturbed(plan: mp.Plan, times: int = 15) -> float:
    """How far footholds move where the state is the planned one [m]."""
    worst = 0.0
    for t in np.linspace(0.0, plan.duration(), times, endpoint=False):
        knot, contacts = planned_state(plan, t)
        new, first = mp.replan(plan, t, knot, contacts=contacts).plan, plan.at(t).phase
        for k in range(1, min(len(new.phases), len(plan.phases) - first)):
            for e, contact in enumerate(plan.phases[first + k].contacts):
                if contact.surface != new.phases[k].contacts[e].surface:
                    return float("inf")
                if contact.surface >= 0:
                    off = np.array(new.knots[k].end_effectors_W[e]) - plan.knots[first + k].end_effectors_W[e]
                    worst = max(worst, float(np.linalg.norm(off)))
    return worst


def run(case: str, draws: int, seed: int, options: dict) -> None:
    """Print what came of the draws of a case."""
    scene, robot = case.split("/")
    plan = mp.plan(scene, robot).plan
    rng = random.Random(seed)
    statuses: Counter[str] = Counter()
    worst: Counter[str] = Counter()
    times = []
    for _ in range(draws):
        t, knot, contacts, kind = draw(plan, rng)
        begin = time.process_time()
        result = mp.replan(plan, t, knot, contacts=contacts, **options)
        times.append(1e3 * (time.process_time() - begin))
        statuses[str(result.report.status)] += 1
        if result.report.status != mp.Status.solved:
            worst[f"{result.report.worst_violation.name} ({kind})"] += 1
    times.sort()
    solved = statuses["solved"] / draws
    print(
        f"{case:28} {len(plan.phases)} phases: {100 * solved:5.1f} % solved; "
        f"{statistics.median(times):5.1f} ms median, {times[int(0.99 * draws)]:5.1f} p99, {times[-1]:5.1f} max; "
        f"undisturbed: footholds {1e3 * undisturbed(plan):.2f} mm; {dict(statuses)} {dict(worst.most_common(6))}"
    )


def main() -> None:
    """Run the cases."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", default=CASES)
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--time-limit", type=float, default=None, help="Wall clock of each replan [s].")
    arguments = parser.parse_args()
    options = {} if arguments.time_limit is None else {"time_limit": arguments.time_limit}
    for case in arguments.cases:
        run(case, arguments.draws, arguments.seed, options)


if __name__ == "__main__":
    main()
