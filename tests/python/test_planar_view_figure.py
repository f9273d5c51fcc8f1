"""What planar robots look like: limbs with colours and lanes, pieces that hold the joints and stand on the sole."""

import numpy as np
import pytest

from mcplan._core import Capsule
from mcplan.planar.view.figure import convex_hull, end_colours, limbs_of, shapes_of, size_of
from mcplan.view.colours import COOL, WARM
from reference_solutions import reference_task


def robot(name: str):
    return reference_task({"climber9": "climbing", "walker9": "walking"}[name]).robot


def test_limbs_are_the_chains_below_the_trunk():
    walker, climber = robot("walker9"), robot("climber9")
    names = {limb.bodies[0]: [walker.bodies[i].name for i in limb.bodies] for limb in limbs_of(walker)}
    assert sorted(len(bodies) for bodies in names.values()) == [1, 1, 3, 3]
    trunk = set(range(10)) - {i for limb in limbs_of(walker) for i in limb.bodies}
    assert {walker.bodies[i].name for i in trunk} == {"pelvis", "torso"}
    assert [limb.bodies for limb in limbs_of(climber)] == [(1, 2, 3), (4, 5, 6), (7, 8, 9)]


def test_left_is_cool_and_far_right_is_warm_and_near():
    walker = robot("walker9")
    lanes = {limb.name: (limb.colour, limb.lane) for limb in limbs_of(walker)}
    assert lanes["left_foot"] == (COOL[0], 1.0)
    assert lanes["right_foot"] == (WARM[0], -1.0)
    order = [shape.lane for shape in shapes_of(walker)]
    assert order == sorted(order, reverse=True)  # the last one painted is the nearest


def test_end_effectors_of_no_side_have_colours_of_their_own():
    assert len(set(end_colours(robot("climber9")))) == 3


@pytest.mark.parametrize("name", ["climber9", "walker9"])
def test_bodies_without_capsules_reach_from_joint_to_joint(name):
    machine = robot(name)
    bodies = list(machine.bodies)
    for body in bodies:
        body.capsules = []
    machine.bodies = bodies
    shapes = {shape.body: shape for shape in shapes_of(machine)}
    assert set(shapes) == set(range(len(machine.bodies)))
    for i, body in enumerate(machine.bodies[1:], start=1):
        for owner, joint in ((body.parent, body.joint_P), (i, np.zeros(2))):
            assert np.linalg.norm(shapes[owner].discs[:, :2] - joint, axis=1).min() < 1e-9


@pytest.mark.parametrize("name", ["climber9", "walker9"])
def test_feet_end_exactly_at_the_sole(name):
    machine = robot(name)
    for end in machine.end_effectors:
        foot = [shape.outline_B() for shape in shapes_of(machine) if shape.body == end.body]
        across = np.array([-np.sin(end.angle_B), np.cos(end.angle_B)])
        height = min(((outline - end.position_B) @ across).min() for outline in foot)
        assert height == pytest.approx(0.0, abs=1e-9)


def test_capsules_are_drawn_where_a_body_has_them():
    machine = robot("walker9")
    bodies = list(machine.bodies)
    bodies[1].capsules = [Capsule(from_B=(0.0, 0.0), to_B=(0.0, -0.4), radius=0.07)]
    machine.bodies = bodies
    (thigh,) = [shape for shape in shapes_of(machine) if shape.body == 1]
    assert thigh.discs == pytest.approx(np.array([[0.0, 0.0, 0.07], [0.0, -0.4, 0.07]]))
    outline = thigh.outline_B(sides=64)
    assert (outline.min(axis=0), outline.max(axis=0)) == (
        pytest.approx([-0.07, -0.47], abs=1e-3),
        pytest.approx([0.07, 0.07], abs=1e-3),
    )


def test_size_is_the_length_of_the_longest_limb():
    assert size_of(robot("walker9")) == pytest.approx(0.4 + 0.4 + 0.08)
    assert size_of(robot("climber9")) == pytest.approx(0.1 + 0.4 + 0.4 + 0.06)


def test_hulls_hold_their_points_and_turn_left():
    rng = np.random.default_rng(5)
    for _ in range(50):
        points = rng.normal(size=(30, 2))
        hull = convex_hull(points)
        edges = np.roll(hull, -1, axis=0) - hull
        away = points[:, None] - hull[None]
        assert (edges[:, 0] * away[..., 1] - edges[:, 1] * away[..., 0]).min() > -1e-6
        assert {tuple(p) for p in hull} <= {tuple(p) for p in np.round(points, 9)}
