"""How long `mp.replan` takes, from the planned state at several times of a plan; processor time, one thread.

python benchmarks/replanning.py [SCENE ...]
"""

from __future__ import annotations

import sys
import time

import mcplan as mp

TIMES_S = (0.5, 1.0, 1.5, 2.0, 3.0)


def measured(plan: mp.Plan, t: float) -> mp.model.Knot:
    """The state that is planned at a time, as if it had been measured."""
    state = plan.at(t)
    knot = mp.model.Knot(
        com_W=state.com_W,
        com_velocity_W=state.com_velocity_W,
        base_rpy=state.base_rpy,
        base_rpy_rate=state.base_rpy_rate,
        end_effectors_W=[end.position_W for end in state.end_effectors],
        end_effector_velocities_W=[end.velocity_W for end in state.end_effectors],
    )
    knot.angular_momentum_W = state.angular_momentum_W
    return knot


def main(scenes: list[str]) -> None:
    """Print a line for each scene and model."""
    for model in ("wrench", "lipm"):
        for name in scenes:
            begin = time.process_time()
            first = mp.plan(mp.load_scene(name), mp.load_robot("humanoid44"), model=model).plan
            planned_ms = 1e3 * (time.process_time() - begin)
            words = []
            for t in TIMES_S:
                begin = time.process_time()
                report = mp.replan(first, t, measured(first, t), model=model).report
                words.append(f"{1e3 * (time.process_time() - begin):.0f} ({report.status})")
            print(
                f"{name}, {model}: plan {planned_ms:.0f} ms; replanned at {', '.join(map(str, TIMES_S))} s: {', '.join(words)} ms"
            )


if __name__ == "__main__":
    main(sys.argv[1:] or ["flat", "stairs", "gap"])
