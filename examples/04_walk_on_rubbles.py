"""Walk over tilted patches, one step a cycle, as a robot would: each cycle starts from a measured state."""

import numpy as np

import mcplan as mp

scene = mp.load_scene("rubbles")
robot = mp.load_robot("talos_wang")
planner = mp.receding_horizon(scene, robot, fidelity="point", lookahead=3, time_limit=60.0)

noise = np.random.default_rng(0)
for _ in range(3):
    planned = planner.state()
    measured = mp.rhp.State(
        com_W=planned.com_W + noise.normal(0.0, 0.002, 3),  # [m]
        com_velocity_W=planned.com_velocity_W + noise.normal(0.0, 0.01, 3),  # [m/s]
        angular_momentum_W=planned.angular_momentum_W,
        feet_W=planned.feet_W,
        surfaces=planned.surfaces,
    )
    cycle = planner.step(measured)
    print(f"cycle {cycle.index}: {cycle.status}, {cycle.iterations} iterations, {cycle.time_s:.2f} s", end="")
    if not cycle.executed:
        raise SystemExit(f"; no step: {cycle.message}")
    step = planner.executed()  # a plan of one step, from time 0: what a controller would follow
    print(f", {step.duration():.2f} s long, {cycle.distance_m:.2f} m")

# Without measurements the whole walk is one call.
walk = mp.walk(scene, robot, cycles=2)
print(walk.report)
print(f"{walk.distance_m():.2f} m; forces replayed drift {1e3 * walk.drift_com_m():.1g} mm at most")
if not walk.success:
    raise SystemExit(1)
