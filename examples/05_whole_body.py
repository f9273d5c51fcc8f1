"""Wheel over one limb: joints, forces and timing of a planar robot, proved to keep its limits at every instant."""

import mcplan as mp

task = mp.load_planar_task("cartwheel")

# First with forces that share the load evenly, then with a weight for each point of contact, from where the first ends.
even = mp.whole_body(task, forces="uniform", time_limit=60.0)
result = mp.whole_body(task, forces="per_point", warm_start=even.plan, certify=True, time_limit=60.0)
for name, found in (("uniform", even), ("per point", result)):
    print(f"{name}: {found.report.status}, {found.report.iterations} iterations, {found.report.time_s:.1f} s", end="")
    print(f", {found.report.cost:.0f} N2 m2 s in {found.plan.duration():.2f} s")
if result.report.status != mp.Status.solved:
    raise SystemExit(result.report.message)
print(result.certificate)

plan = result.plan
state = plan.at(0.5)  # any instant: base, joints, torques, contact forces
torques = ", ".join(f"{torque:.0f}" for torque in state.torque)
print(f"at 0.5 s the joints need {torques} N m")
for force in state.forces:
    where = task.robot.end_effectors[force.end_effector].name
    print(f"  point {force.point} of limb {where}: {force.normal:.0f} N into the limb, {force.tangential:.0f} N along")
plan.save("cartwheel.npz")
if not result.certificate.proved():
    raise SystemExit(1)
