"""Plan the jump over a gap, and ask the plan where the robot is and what carries it."""

import mcplan as mp

scene = mp.load_scene("gap")
robot = mp.load_robot("humanoid44")

result = mp.plan(scene, robot)
print(result.report)

plan = result.plan
for k, (time, phase) in enumerate(zip(plan.knot_times(), plan.phases, strict=False)):
    contacts = [scene.surfaces[c.surface].name if c.surface >= 0 else "-" for c in phase.contacts]
    print(f"phase {k:2d}  {time:5.2f} s  CoM height {plan.at(time).com_W[2]:.3f} m  {contacts}")

mp.check(plan, scene, robot).raise_if_violated()
