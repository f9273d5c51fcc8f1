"""Build a scene in code: up a platform, with a turn of 30 degrees on the way. Then see what a mistake looks like."""

import math

import mcplan as mp


def rectangle(name: str, x: tuple[float, float], y: tuple[float, float], z: float) -> mp.model.Surface:
    """Rectangle at height z [m] with sides along x and y."""
    corners = [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
    return mp.model.Surface(name=name, vertices_W=corners)


scene = mp.Scene(
    name="platform",
    surfaces=[
        rectangle("ground", (-1.0, 0.5), (-1.0, 1.0), 0.0),
        rectangle("platform", (0.5, 2.0), (-1.0, 1.0), 0.10),
    ],
    start=mp.model.Stance(contacts={"foot": "ground"}),
    goal=mp.model.Stance(position_W=[1.2, 0.0, 0.10], yaw=math.radians(30.0), contacts={"foot": "platform"}),
)
robot = mp.load_robot("humanoid44")

result = mp.plan(scene, robot)
end = result.plan.at(result.plan.duration())
print(result.report)
print(f"heading at the end: {math.degrees(end.base_rpy[2]):.1f} degrees")
mp.check(result.plan, scene, robot).raise_if_violated()

try:
    mp.Scene(surfaces=[mp.model.Surface(name="line", vertices_W=[[0, 0, 0], [1, 0, 0]])]).validate()
except mp.errors.InvalidScene as error:
    print(f"as expected: {error}")
else:
    raise SystemExit("a surface of two points was accepted")
