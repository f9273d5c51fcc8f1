"""Motions in simulation: references that are each other's derivatives, and a robot that follows them."""

from __future__ import annotations

import json

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("proxsuite")

import mcplan as mp  # noqa: E402
from command_line import one_line_error  # noqa: E402
from mcplan.cli import main  # noqa: E402
from mcplan.errors import InvalidInput  # noqa: E402
from mcplan.kinematics.rotations import rotation_vector  # noqa: E402
from mcplan.tracking.joint_references import JointReferences  # noqa: E402
from mcplan.tracking.motion_references import BEARS_N, motion_references  # noqa: E402
from motions_by_hand import LEFT, RIGHT, Talos, lifting_motion, swaying_motion  # noqa: E402

STEP_S = 0.002


@pytest.fixture(scope="module")
def talos() -> Talos:
    return Talos()


@pytest.fixture(scope="module")
def lifting(talos):
    return lifting_motion(talos)


@pytest.fixture(scope="module")
def desired(lifting):
    return motion_references(lifting, STEP_S, 0.5)


def differences(values: np.ndarray) -> np.ndarray:
    return (values[2:] - values[:-2]) / (2.0 * STEP_S)


def test_velocities_and_accelerations_are_derivatives(desired):
    references, joints, _ = desired
    inside = slice(0, int(references.duration_s / STEP_S) - 1)
    pairs = [
        (references.com_W, references.com_velocity_W),
        (references.com_velocity_W, references.com_acceleration_W),
        (references.momentum_W, references.momentum_rate_W),
        (references.end_effectors_W, references.end_effector_velocities_W),
        (references.end_effector_velocities_W, references.end_effector_accelerations_W),
        (references.sole_velocities_W, references.sole_accelerations_W),
        (references.base_velocity_W, references.base_acceleration_W),
        (joints.positions, joints.velocities),
        (joints.velocities, joints.accelerations),
    ]
    for values, rates in pairs:
        got, expected = differences(values)[inside], rates[1:-1][inside]
        # Central differences of splines of third degree are off by h times the jump of the third derivative.
        np.testing.assert_allclose(got, expected, atol=2e-3 + 2e-2 * np.abs(expected).max())
    turned = [rotation_vector(b @ a.T) for a, b in zip(references.base_WB[:-2], references.base_WB[2:], strict=True)]
    np.testing.assert_allclose(np.array(turned) / (2 * STEP_S), references.base_velocity_W[1:-1], rtol=0.05, atol=1e-3)


def test_forces_at_centres_of_pressure_carry_the_motion(desired, lifting, talos):
    """m (a + g) = sum f, and L' = sum (c - p) x f + m, up to what the motion leaves unbalanced between nodes."""
    references, _, _ = desired
    mass = sum(inertia.mass for inertia in talos.model.inertias)
    inside = slice(0, int(references.duration_s / STEP_S))
    gravity = np.array([0.0, 0.0, lifting.plan.scene.gravity])
    forces = references.forces_W.sum(axis=1)
    np.testing.assert_allclose(forces[inside], mass * (references.com_acceleration_W + gravity)[inside], atol=1.0)
    arms = references.pressure_W - references.com_W[:, None]
    moments = (np.cross(arms, references.forces_W) + references.moments_W).sum(axis=1)
    np.testing.assert_allclose(moments[inside], references.momentum_rate_W[inside], atol=1.0)
    pressed = references.forces_W[..., 2] > BEARS_N
    assert np.abs(references.moments_W[pressed][:, :2]).max() < 1e-9


def test_after_the_end_the_robot_stands_as_it_came_to_stand(desired, lifting):
    references, joints, (first, last) = desired
    after = slice(int(references.duration_s / STEP_S) + 1, None)
    for rates in (references.com_velocity_W, references.momentum_W, joints.velocities, joints.accelerations):
        assert not rates[after].any()
    np.testing.assert_array_equal(joints.positions[-1], last[7:])
    assert first.shape == (lifting.model.complete.model.nq,)
    np.testing.assert_array_equal(references.surfaces[-1], lifting.plan.final_contacts)


def test_joints_stay_after_their_last_instant():
    joints = JointReferences(np.array([[0.0], [1.0]]), np.array([[1.0], [2.0]]), np.zeros((2, 1)))
    assert joints.timed and joints.at(7)[0] == 1.0 and joints.at(0)[1] == 1.0
    posture = JointReferences.of_posture(np.arange(9.0))
    assert not posture.timed and posture.at(3)[1] == 0.0
    np.testing.assert_array_equal(posture.at(3)[0], [7.0, 8.0])


def test_a_robot_lifts_its_foot_as_the_motion_does(lifting):
    run = mp.track(lifting, hold_s=0.3)
    assert run.completed
    measures = run.measures
    assert measures.com_rms_m < 1e-3
    assert measures.swing_rms_m < 2e-3
    assert measures.slip_m < 2e-3
    assert measures.self_contacts == 0
    contacts = run.recording.contacts[1:]  # the simulator has no forces before its first step
    assert contacts[:, RIGHT].all() and not contacts[:, LEFT].all()
    np.testing.assert_allclose(run.recording.com_plan_W[0], lifting.at(0.0).com_W)


def test_the_command_tracks_motions_and_says_whether_they_are_certified(talos, capsys, tmp_path):
    motion = swaying_motion(talos, duration_s=0.5, size_m=0.002)
    path, run = tmp_path / "motion.npz", tmp_path / "run.npz"
    motion.save(path)
    assert main(["track", str(path), "--json", "--save", str(run)]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["feasible"] is True and found["verdict"].startswith("certified")
    assert found["robot"] == "talos" and not found["fell"]
    assert main(["export", str(run), "--to", "mjlab", "-o", str(tmp_path / "reference.npz")]) == 0
    capsys.readouterr()
    message = one_line_error((main(["track", str(path), "--robot", "talos"]), *capsys.readouterr()))
    assert message.startswith("--robot: must not be given with a motion")
    with pytest.raises(InvalidInput, match="must not be given with a motion"):
        mp.track(motion, "talos")
