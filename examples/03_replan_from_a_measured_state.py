"""The robot was pushed: plan on from the state that was measured instead of the one that was planned."""

import numpy as np

import mcplan as mp

scene = mp.load_scene("gap")
robot = mp.load_robot("humanoid44")
first = mp.plan(scene, robot)

t = 1.0  # [s]
planned = first.plan.at(t)
measured = mp.model.Knot(
    com_W=planned.com_W,
    com_velocity_W=planned.com_velocity_W + [0.0, 0.03, 0.0],  # a push to the left [m/s]
    base_rpy=planned.base_rpy,
    base_rpy_rate=planned.base_rpy_rate,
    end_effectors_W=[e.position_W for e in planned.end_effectors],
    end_effector_velocities_W=[e.velocity_W for e in planned.end_effectors],
)

second = mp.replan(first.plan, t, measured)
print(first.report)
print(second.report)

jump = np.linalg.norm(second.plan.at(0.0).com_velocity_W - measured.com_velocity_W)
print(f"the new plan starts {jump:.1e} m/s from the measured velocity")
if second.report.status != mp.Status.solved:
    raise SystemExit(1)
