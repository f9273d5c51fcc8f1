"""Robots on four point feet: what their plans leave to a controller, and that it can walk them."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest

import mcplan as mp

ROBOTS = ("anymal", "go2")
#: What plans may use of the friction of 0.7.
FRICTION_RATIO = 0.8
#: Least load of a foot in contact, of the weight.
LOAD = 0.3 / 4


def surface(name: str, x: tuple[float, float], z: tuple[float, float], thickness: float | None = None) -> mp.Surface:
    out = mp.model.Surface()
    out.name, out.end_effectors = name, ["foot"]
    out.vertices_W = [[x[0], -1.0, z[0]], [x[1], -1.0, z[1]], [x[1], 1.0, z[1]], [x[0], 1.0, z[0]]]
    if thickness is not None:
        out.thickness = thickness
    return out


def scene(name: str, surfaces: list[mp.model.Surface], goal: list[float]) -> mp.Scene:
    out = mp.Scene(name=name)
    out.surfaces = surfaces
    out.start.contacts, out.goal.contacts = {"foot": surfaces[0].name}, {"foot": surfaces[-1].name}
    out.goal.position_W = goal
    return out


def flat(robot: mp.Robot) -> mp.Scene:
    return mp.load_scene("flat")


def ramp(robot: mp.Robot) -> mp.Scene:
    """From level ground up 11 degrees, all four feet on the slope at the goal."""
    front, rear = lengths(robot)
    edge, tangent = front + 0.15, math.tan(math.radians(11.0))
    slope = surface("slope", (edge, edge + 3.0), (0.0, 3.0 * tangent))
    return scene(
        "ramp",
        [surface("ground", (-1.5, edge), (0.0, 0.0)), slope],
        [edge + rear + 0.7, 0.0, (rear + 0.7) * tangent],
    )


def stairs(robot: mp.Robot) -> mp.Scene:
    """Three treads, 0.08 m high and 0.30 m deep."""
    front, rear = lengths(robot)
    edge = front + 0.15
    treads = [
        surface(
            f"tread_{k}", (edge + 0.3 * (k - 1), edge + 0.3 * k + (2.0 if k == 3 else 0.0)), (0.08 * k, 0.08 * k), 0.08
        )
        for k in (1, 2, 3)
    ]
    return scene("stairs", [surface("ground", (-1.5, edge), (0.0, 0.0)), *treads], [edge + 0.6 + rear + 0.2, 0.0, 0.24])


def stones(robot: mp.Robot) -> mp.Scene:
    """Two columns of stones, half a stride apart, at heights within 0.06 m of each other."""
    random, (front, rear) = Random(4), lengths(robot)
    foot = robot.end_effectors[0]
    pitch, edge = 0.5 * float(foot.reach_max_B[0] - foot.reach_min_B[0]), front + 0.08
    across = abs(float(foot.nominal_B[1]))
    out = [surface("ground", (-1.5, edge), (0.0, 0.0))]
    for row in range(6):
        for side in (-1, 1):
            x = edge + (row + 0.6) * pitch + random.uniform(-0.02, 0.02)
            y, z = side * (across + random.uniform(-0.01, 0.02)), random.uniform(-0.03, 0.03)
            corners, radius = random.choice([5, 6, 7]), 0.4 * pitch
            angles = [2.0 * math.pi * (j + 0.3) / corners for j in range(corners)]
            stone = mp.model.Surface()
            stone.name, stone.end_effectors = f"stone_{len(out)}", ["foot"]
            stone.vertices_W = [[x + radius * math.cos(a), y + radius * math.sin(a), z] for a in angles]
            out.append(stone)
    end = edge + 6.1 * pitch
    return scene("stones", [*out, surface("end", (end, end + 2.5), (0.0, 0.0))], [end + rear + 0.12, 0.0, 0.0])


def lengths(robot: mp.Robot) -> tuple[float, float]:
    """How far ahead of the CoM the front feet stand, and how far behind it the rear ones."""
    along = [float(end.nominal_B[0]) for end in robot.end_effectors]
    return max(along), -min(along)


SCENES = {"flat": flat, "ramp": ramp, "stairs": stairs, "stones": stones}
PLANS: dict[tuple[str, str], mp.PlanResult] = {}


def planned(robot: str, terrain: str) -> mp.PlanResult:
    if (robot, terrain) not in PLANS:
        loaded = mp.load_robot(robot)
        PLANS[robot, terrain] = mp.plan(SCENES[terrain](loaded), loaded)
    return PLANS[robot, terrain]


@pytest.mark.parametrize("terrain", SCENES)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_walk_leaves_friction_load_and_two_feet_to_the_controller(robot, terrain):
    plan, report = planned(robot, terrain).plan, planned(robot, terrain).report
    assert str(report.status) == "solved", report.message
    assert min(sum(contact.surface >= 0 for contact in phase.contacts) for phase in plan.phases) >= 2
    assert max(report.friction_use.values()) <= FRICTION_RATIO * 0.7 + 0.02
    weight = plan.robot.mass * plan.scene.gravity
    for time in np.linspace(0.0, plan.duration(), 300, endpoint=False):
        for end in plan.at(float(time)).end_effectors:
            if end.surface >= 0:
                assert end.force_W[2] > 0.9 * LOAD * weight  # held at the knots, the CoM falls a little between them


@pytest.mark.slow
@pytest.mark.parametrize("terrain", SCENES)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_walk_is_followed_to_its_end_within_the_torque_limits(robot, terrain):
    pytest.importorskip("mujoco")
    measures = mp.track(planned(robot, terrain).plan).measures
    assert not measures.fell
    assert measures.com_rms_m < 0.02
    assert measures.qp_failures == 0


def test_the_trunk_is_parallel_to_the_slope_that_four_feet_stand_on():
    plan = planned("anymal", "ramp").plan
    assert plan.knots[0].base_rpy == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)
    assert np.degrees(plan.knots[-1].base_rpy[1]) == pytest.approx(-11.0, abs=0.7)


def test_a_room_is_crossed_by_a_door_aside_in_more_phases_than_the_way_is_long():
    walls = []
    for name, low, high in (("right", -3.0, -1.6), ("left", -0.4, 3.0)):
        wall = mp.model.Surface()
        wall.name, wall.thickness, wall.end_effectors = name, 2.0, ["right_hand"]
        wall.vertices_W = [[1.0, low, 2.0], [1.1, low, 2.0], [1.1, high, 2.0], [1.0, high, 2.0]]
        walls.append(wall)
    floor = mp.model.Surface()
    floor.name, floor.end_effectors = "floor", ["foot"]
    floor.vertices_W = [[-2.0, -3.0, 0.0], [5.0, -3.0, 0.0], [5.0, 3.0, 0.0], [-2.0, 3.0, 0.0]]
    room = scene("room", [floor, *walls], [2.0, 0.0, 0.0])
    room.goal.contacts = {"foot": "floor"}
    result = mp.plan(room, "anymal", time_limit=300.0)
    assert str(result.report.status) == "solved", result.report.message
    com = np.array([result.plan.at(t).com_W for t in np.linspace(0.0, result.plan.duration(), 500)])
    through = com[(com[:, 0] > 1.0) & (com[:, 0] < 1.1)]
    assert len(through) > 0
    assert -1.6 < through[:, 1].min() and through[:, 1].max() < -0.4


@pytest.mark.slow
def test_margins_are_options():
    slope = [mp.plan("slope", "go2", friction_ratio=ratio) for ratio in (1.0, 0.6)]
    used = [max(result.report.friction_use.values()) for result in slope]
    assert used[0] > used[1] + 0.1  # the margin is the search's, the checker asks for the cone alone
    for name in ("friction_ratio", "load_ratio"):
        with pytest.raises(mp.errors.InvalidOptions, match=name):
            mp.plan("flat", "anymal", **{name: 1.5})
