"""A control loop of 500 Hz with a planner in a thread of its own: states in ten times a second, plans out."""

import time

import numpy as np

import mcplan as mp
from mcplan.online import MeasuredState, Planner

CONTROL_S, REPLAN_S = 0.002, 0.1
PUSH_S, PUSH_M_S = 1.0, 0.05  # to the left, at that time


def estimate(plan: mp.Plan, began_s: float, now_s: float, push_m_s: float) -> MeasuredState:
    """What a state estimator would say; here the robot does what is planned, but for a push."""
    now = plan.at(now_s - began_s)
    knot = mp.model.Knot(
        com_W=now.com_W,
        com_velocity_W=now.com_velocity_W + np.array([0.0, push_m_s, 0.0]),
        base_rpy=now.base_rpy,
        base_rpy_rate=now.base_rpy_rate,
        angular_momentum_W=now.angular_momentum_W,
        end_effectors_W=[end.position_W for end in now.end_effectors],
        end_effector_velocities_W=[end.velocity_W for end in now.end_effectors],
        end_effector_yaw=[end.yaw for end in now.end_effectors],
    )
    return MeasuredState(now_s, knot, tuple(end.surface for end in now.end_effectors))


plan, began_s = mp.plan("flat", "humanoid44").plan, 0.0
replan_s, used, unusable, pushed = 0.0, 0, 0, False
with Planner(plan, began_s, time_limit=0.08) as planner:
    start = time.perf_counter()
    for tick in range(1500):
        now_s = tick * CONTROL_S
        update = planner.poll()
        if update is not None:
            if update.usable:
                planner.take_over(update)  # the next plans are made from this one
                plan, began_s = update.plan, update.begins_s
            used, unusable = used + update.usable, unusable + (not update.usable)
        if now_s >= replan_s:
            push = not pushed and now_s >= PUSH_S
            planner.submit(estimate(plan, began_s, now_s, PUSH_M_S if push else 0.0))
            pushed |= push
            replan_s += REPLAN_S
        plan.at(now_s - began_s)  # the references of this instant, for the controller
        time.sleep(max(start + (tick + 1) * CONTROL_S - time.perf_counter(), 0.0))

print(f"3 s of control: {used} plans followed, {unusable} not; the plan under way began at {began_s:.1f} s")
if not used:
    raise SystemExit(1)
