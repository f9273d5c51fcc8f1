"""Distances between links: none that matters is overlooked, and rows are how fast they change."""

import numpy as np
import pytest

import folding
import mcplan as mp
import simulated

mujoco = pytest.importorskip("mujoco")
pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking.mujoco_model import build  # noqa: E402
from mcplan.tracking.robot_dynamics import RobotDynamics  # noqa: E402
from mcplan.tracking.separation import (  # noqa: E402
    APART_M,
    ARM_APART_M,
    ARM_NEAR_M,
    ARM_ROWS,
    KD,
    KP,
    LARGEST,
    MARGIN_RATIO,
    NEAR_M,
    ROWS,
    Separation,
    _pairs,
)
from mcplan.tracking.states import to_mujoco  # noqa: E402


def distances(model, dynamics):
    """Of every pair, worked out anew."""
    data = mujoco.MjData(model.mj)
    data.qpos[:], _ = to_mujoco(model, dynamics.configuration, dynamics.velocity)
    mujoco.mj_kinematics(model.mj, data)
    return np.array([mujoco.mj_geomDistance(model.mj, data, a, b, 1.0, None) for a, b in _pairs(model)])


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_no_near_pair_is_overlooked_on_the_way(name):
    model = build(mp.load_robot(name), simulated.level())
    dynamics, separation = RobotDynamics(model.urdf_model), Separation(model)
    rng, pin_model = np.random.default_rng(8), model.urdf_model.model
    velocity, configuration, met = np.zeros(pin_model.nv), model.urdf_model.neutral.copy(), 0
    for _ in range(60):
        velocity = 0.8 * velocity + 4.0 * rng.normal(size=pin_model.nv)
        configuration = pin.integrate(pin_model, configuration, 0.01 * velocity)
        configuration[7:] = np.clip(
            configuration[7:], pin_model.lowerPositionLimit[7:], pin_model.upperPositionLimit[7:]
        )
        dynamics.update(configuration, velocity)
        near = np.sort(separation._near(dynamics)[1])
        exact = np.sort(distances(model, dynamics))
        expected = exact[exact < NEAR_M]
        assert len(near) == len(expected)
        np.testing.assert_allclose(near, expected, atol=2e-3)  # of MuJoCo's, which depend on where its search begins
        met += len(near)
    assert met > 20


@pytest.fixture
def lowered(tmp_path):
    """A boom a little above the block below it, and what the controller knows of it."""
    model = build(folding.robot(tmp_path), simulated.level())
    configuration = folding.standing(model.urdf_model.neutral)
    index = 7 + list(model.joints).index("hinge")
    configuration[index] = 1.55
    dynamics = RobotDynamics(model.urdf_model)
    dynamics.update(configuration, np.zeros(8))
    while distances(model, dynamics).min() > 0.03:
        configuration[index] += 0.005
        dynamics.update(configuration, np.zeros(8))
    return model, configuration, dynamics


def test_rows_are_how_fast_the_distance_changes(lowered):
    model, configuration, dynamics = lowered
    rows, least = Separation(model).rows(dynamics)
    assert np.isfinite(least).tolist() == [True] + [False] * (ROWS - 1) and not rows[1:].any()
    h, moved = 1e-5, RobotDynamics(model.urdf_model)
    rates = []
    for unit in np.eye(8):
        there = []
        for side in (-h, h):
            moved.update(pin.integrate(model.urdf_model.model, configuration, side * unit), np.zeros(8))
            there.append(distances(model, moved).min())
        rates.append((there[1] - there[0]) / (2 * h))
    np.testing.assert_allclose(rows[0], rates, atol=2e-3)
    assert least[0] == pytest.approx(-KP * (distances(model, dynamics).min() - APART_M))


def test_links_that_close_are_braked_and_no_more_than_so_much(lowered):
    model, configuration, dynamics = lowered
    hinge = 6 + list(model.joints).index("hinge")
    for speed in (0.5, 20.0):
        velocity = np.zeros(8)
        velocity[hinge] = speed
        dynamics.update(configuration, velocity)
        rows, least = Separation(model).rows(dynamics)
        closing = rows[0] @ velocity
        expected = -KP * (distances(model, dynamics).min() - APART_M) - KD * closing
        assert closing < 0.0 and least[0] == pytest.approx(min(expected, LARGEST))


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_no_links_are_driven_apart_in_the_nominal_posture(name):
    """Knee and foot of G1 are 7 mm from each other there, its elbow and wrist 10 mm: that is how it is built."""
    model = build(mp.load_robot(name), simulated.level())
    dynamics = RobotDynamics(model.urdf_model)
    dynamics.update(model.urdf_model.neutral.copy(), np.zeros(model.urdf_model.model.nv))
    rows, least = Separation(model).rows(dynamics)
    assert rows.any() and np.isfinite(least).any()
    assert (least < 0.0).all()


@pytest.mark.parametrize("seed", range(4))
def test_rows_are_those_of_the_pairs_that_have_to_be_braked_first(seed):
    """Which are not the nearest ones: twice as many pairs of TALOS as there are rows are near to each other in any stance."""
    model = build(mp.load_robot("talos"), simulated.level())
    pin_model, dynamics, moved = (
        model.urdf_model.model,
        RobotDynamics(model.urdf_model),
        RobotDynamics(model.urdf_model),
    )
    configuration = model.urdf_model.neutral.copy()
    velocity = np.zeros(pin_model.nv)
    velocity[6:] = np.random.default_rng(seed).normal(size=pin_model.nv - 6)
    dynamics.update(configuration, velocity)
    _, least = Separation(model).rows(dynamics)
    h, there = 1e-5, []
    for side in (-h, h):
        moved.update(pin.integrate(pin_model, configuration, side * velocity), velocity)
        there.append(distances(model, moved))
    distance, rate = distances(model, dynamics), (there[1] - there[0]) / (2 * h)
    margins = np.minimum(APART_M, MARGIN_RATIO * distance)  # it is the nominal posture
    expected = (-KP * (distance - margins) - KD * rate)[distance < NEAR_M]
    assert len(expected) > 2 * ROWS
    desired = np.minimum(np.sort(expected)[-ROWS:], LARGEST)
    np.testing.assert_allclose(np.sort(least[:ROWS]), desired, rtol=0.02, atol=0.5)


def beside_a_wall(left_m):
    """The floor, and a wall to the left of TALOS's hand in its nominal posture."""
    scene = simulated.level()
    wall = scene.surfaces[0].__copy__()
    wall.name, wall.thickness = "wall", 1.5
    wall.vertices_W = [[-1.0, left_m, 1.5], [1.0, left_m, 1.5], [1.0, left_m + 0.2, 1.5], [-1.0, left_m + 0.2, 1.5]]
    scene.surfaces = [*scene.surfaces, wall]
    return scene


def arm_distances(model, dynamics):
    """Of the shapes of the left arm from the wall, worked out by MuJoCo one by one."""
    data = mujoco.MjData(model.mj)
    data.qpos[:], _ = to_mujoco(model, dynamics.configuration, dynamics.velocity)
    mujoco.mj_kinematics(model.mj, data)
    arm = [
        geom
        for geom, name in model.geom_names.items()
        if name.startswith(("arm_left", "wrist_left", "gripper_left", "left_hand"))
    ]
    return np.array([mujoco.mj_geomDistance(model.mj, data, geom, model.surface_geoms[1], 2.0, None) for geom in arm])


@pytest.fixture(scope="module")
def talos_at_wall():
    model = build(mp.load_robot("talos"), beside_a_wall(0.6))
    dynamics = RobotDynamics(model.urdf_model)
    configuration = model.urdf_model.neutral.copy()
    configuration[2] = 1.0
    dynamics.update(configuration, np.zeros(model.urdf_model.model.nv))
    configuration[1] += arm_distances(model, dynamics).min() - 0.5 * ARM_NEAR_M
    dynamics.update(configuration, np.zeros(model.urdf_model.model.nv))
    return model, dynamics


def test_arms_of_free_hands_keep_off_a_wall_and_those_of_others_do_not(talos_at_wall):
    model, dynamics = talos_at_wall
    names = [end.name for end in model.urdf_model.robot.end_effectors]
    near = arm_distances(model, dynamics)
    for free, expected in (("left_hand", (near < ARM_NEAR_M).sum()), ("right_hand", 0), (None, 0)):
        _, least = Separation(model).rows(dynamics, np.array([name == free for name in names]))
        assert np.isfinite(least[ROWS:]).sum() == expected
    assert 0 < (near < ARM_NEAR_M).sum() <= ARM_ROWS
    unaware = Separation(model, terrain=False).rows(dynamics, np.ones(len(names), dtype=bool))
    np.testing.assert_array_equal(unaware[1], least[:ROWS])


def test_rows_of_an_arm_are_how_fast_it_comes_nearer_to_a_wall(talos_at_wall):
    model, dynamics = talos_at_wall
    free = np.array([end.kind == "hand" for end in model.urdf_model.robot.end_effectors])
    rows, least = Separation(model).rows(dynamics, free)
    nearest = arm_distances(model, dynamics).min()
    row = ROWS  # the first one of arms
    assert least[row] == pytest.approx(-KP * (nearest - ARM_APART_M), abs=1e-3 * KP)
    # Along the world's y with the base, and as finite differences have it with the joints.
    h, pin_model, moved = 1e-4, model.urdf_model.model, RobotDynamics(model.urdf_model)
    for unit in np.eye(pin_model.nv):
        there = []
        for side in (-h, h):
            moved.update(pin.integrate(pin_model, dynamics.configuration, side * unit), np.zeros(pin_model.nv))
            there.append(arm_distances(model, moved).min())
        assert rows[row] @ unit == pytest.approx((there[1] - there[0]) / (2.0 * h), abs=2e-2)
