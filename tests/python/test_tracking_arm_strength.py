"""What an arm can push, against the closed form of two links in a vertical plane."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking.arm_strength import DIRECTIONS, largest_force_N, random_strengths
from two_link_arm import LENGTHS, LIMITS, MASSES, arm_robot

pytest.importorskip("pinocchio")
G = 9.81


@pytest.fixture
def arm(tmp_path):
    return load_model(arm_robot(tmp_path))


def closed_form(shoulder: float, elbow: float, direction: np.ndarray) -> float:
    """Largest F with |lever arms x (F d + weights)| <= limits; angles from x downwards, y axis to the left."""
    a = np.array([LENGTHS[0] * np.cos(shoulder), -LENGTHS[0] * np.sin(shoulder)])  # x, z of the elbow
    b = a + [LENGTHS[1] * np.cos(shoulder + elbow), -LENGTHS[1] * np.sin(shoulder + elbow)]

    def moment(arm: np.ndarray, force: np.ndarray) -> float:
        return arm[1] * force[0] - arm[0] * force[1]  # about y

    weights = [np.array([0.0, -G * mass]) for mass in MASSES]
    # The joints bear the weights, which pull down, and the reaction of the push, which pulls back.
    hanging = [moment(a, weights[0]) + moment(b, weights[1]), moment(b - a, weights[1])]
    reaction = -np.array([direction[0], direction[2]])
    slope = [moment(b, reaction), moment(b - a, reaction)]
    forces = np.linspace(0.0, 2000.0, 40_001)
    held = np.ones_like(forces, dtype=bool)
    for m, s, limit in zip(hanging, slope, LIMITS, strict=True):
        held &= np.abs(m + s * forces) <= limit
    return float(forces[held].max()) if held.any() else 0.0


@pytest.mark.parametrize("direction", ["down", "up", "forward", "backward"])
def test_a_two_link_arm_pushes_what_statics_allow(arm, direction):
    rng = np.random.default_rng(3)
    for _ in range(25):
        angles = rng.uniform(-1.4, 1.4, 2) + [0.0, 0.2]
        q = np.concatenate([arm.neutral[:7], angles])
        force, joint = largest_force_N(arm, 0, q, np.array(DIRECTIONS[direction]))
        if force < 1900.0:
            assert force == pytest.approx(closed_form(*angles, np.array(DIRECTIONS[direction])), abs=0.051), angles
        assert joint in ("shoulder", "elbow")


def test_a_stretched_arm_pushes_down_with_its_limits_and_weight(arm):
    """Horizontal: the elbow bears (10 + 1 g 0.3) / 0.3, the shoulder (40 + 2 g 0.4 + 1 g 0.7) / 0.7."""
    elbow, shoulder = (10.0 + G * 0.3) / 0.3, (40.0 + G * (0.8 + 0.7)) / 0.7
    force, joint = largest_force_N(arm, 0, arm.neutral, np.array([0.0, 0.0, -2.0]))
    assert force == pytest.approx(min(elbow, shoulder)) and joint == "elbow"


def test_no_joint_bears_a_push_across_the_plane_or_along_straight_links(arm):
    force, joint = largest_force_N(arm, 0, arm.neutral, np.array([1.0, 0.0, 0.0]))
    assert (force, joint) == (np.inf, "")
    assert largest_force_N(arm, 0, arm.neutral, np.array([0.0, 1.0, 0.0]))[0] == np.inf


def test_an_arm_too_weak_for_its_weight_pushes_nothing_up(arm):
    arm.model.effortLimit[6:] = [10.0, 10.0]  # its weight asks the shoulder for 14.7 N m
    assert largest_force_N(arm, 0, arm.neutral, np.array([0.0, 0.0, 1.0]))[0] == 0.0
    # Leaning on a rail it may: the reaction holds it up.
    assert largest_force_N(arm, 0, arm.neutral, np.array([0.0, 0.0, -1.0]))[0] == pytest.approx((10.0 + G * 1.5) / 0.7)


def test_random_postures_repeat_with_their_seed(arm):
    one, again, other = (random_strengths(arm, 0, 50, seed)[0] for seed in (1, 1, 2))
    assert (one.forces_N == again.forces_N).all() and not (one.forces_N == other.forces_N).all()
    assert (np.diff(one.forces_N) >= 0.0).all() and len(one.forces_N) == 50
    with pytest.raises(mp.errors.InvalidOptions, match="samples: must be at least 1, got 0"):
        random_strengths(arm, 0, 0)


def test_talos_pushes_far_less_than_half_its_weight():
    pytest.importorskip("example_robot_data")
    urdf_model = load_model(mp.load_robot("talos"))
    hand = urdf_model.robot.end_effector_index("right_hand")
    down = random_strengths(urdf_model, hand, 500)[0]
    assert down.direction == "down"
    assert 70.0 < down.quantile_N(0.5) < 110.0 and 110.0 < down.quantile_N(0.9) < 150.0
    half = 0.5 * G * sum(inertia.mass for inertia in urdf_model.model.inertias)
    assert down.quantile_N(0.9) < 0.5 * half
