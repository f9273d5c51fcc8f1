"""Let a simulated robot follow a plan, push it, and see when it falls. In Python alone: the simulation is MuJoCo's.

Needs ``pip install 'mcplan[sim]'``.
"""

import mcplan as mp
from mcplan.tracking import Push
from mcplan.tracking.feasibility import assess

scene = mp.load_scene("flat")
scene.goal.position_W = [0.2, 0.0, 0.0]  # [m] one step of each foot, to be quick
result = mp.plan(scene, "talos", phases=6, sole_inside=1.0, time_limit=20.0)
if result.report.status != mp.Status.solved:
    raise SystemExit(result.report.message)
plan = result.plan

# Held against the robot's joints, before anything is simulated.
print(assess(plan).verdict)

# As planned, then with what the controller does not know of: a heavier robot, a lower ground, pushes to the left.
as_planned = mp.track(plan, hold_s=0.5)
print(as_planned)
disturbed = mp.track(plan, hold_s=0.5, mass_scale=1.05, ground_shift_m=-0.005, pushes=[(30.0, 0.2, 1.0, 90.0)])
pushed = mp.track(plan, pushes=[Push(force_N=400.0, duration_s=0.3, at_s=1.0)])
for name, run in (("disturbed", disturbed), ("pushed hard", pushed)):
    end = "fell" if run.measures.fell else "walked"
    print(
        f"{name}: {end}, CoM off by {1e3 * run.measures.com_max_m:.0f} mm at most after {run.measures.completed_s:.1f} s"
    )

recording = as_planned.recording  # what the robot did, sampled at each control step
left = [end.name for end in recording.simulated_robot.end_effectors].index("left_foot")
print(f"the left foot bears {recording.forces_W[:, left, 2].max():.0f} N at most")
as_planned.save("run.npz")  # for a report; mcplan.tracking.TrackingResult.load reads it
if as_planned.measures.fell or disturbed.measures.fell:
    raise SystemExit(1)
