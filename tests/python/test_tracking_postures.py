"""Postures along a plan meet it, and pass through those of inverse kinematics."""

import numpy as np
import pytest

import tracked

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.kinematics.inverse_kinematics import follow  # noqa: E402
from mcplan.kinematics.samples import sample  # noqa: E402
from mcplan.kinematics.smooth_postures import running_means  # noqa: E402
from mcplan.tracking.postures import RATE, postures_along  # noqa: E402

DT = 0.01


@pytest.fixture(scope="module")
def case():
    plan, urdf_model = tracked.step_ahead(), tracked.urdf_model("talos")
    count = round(plan.duration() / DT) + 31
    return plan, urdf_model, postures_along(urdf_model, plan, count, DT)


def test_com_and_feet_are_about_where_the_plan_has_them(case):
    """They are what to stay near to: running means that need not meet the plan."""
    plan, urdf_model, found = case
    data = urdf_model.model.createData()
    for n in range(0, round(plan.duration() / DT), 7):
        state = plan.at(n * DT)
        pin.framesForwardKinematics(urdf_model.model, data, found[n])
        com = pin.centerOfMass(urdf_model.model, data, found[n])
        np.testing.assert_allclose(com, state.com_W, atol=0.05)
        for frame, end in zip(urdf_model.frames, state.end_effectors, strict=True):
            if end.surface >= 0:
                np.testing.assert_allclose(data.oMf[frame].translation, end.position_W, atol=0.10)


def test_they_are_running_means_of_those_of_inverse_kinematics(case):
    plan, urdf_model, found = case
    samples = sample(plan, plan.scene, plan.robot, RATE)
    exact = running_means(urdf_model, samples.times_s, follow(urdf_model, samples).configurations)
    step = samples.times_s[1] - samples.times_s[0]
    for k in range(0, len(exact), 5):
        n = round(k * step / DT)
        if abs(n * DT - k * step) < 1e-9:
            np.testing.assert_allclose(found[n], exact[k], atol=1e-9)


def test_between_them_nothing_jumps_and_the_last_is_held(case):
    plan, urdf_model, found = case
    moves = np.array([pin.difference(urdf_model.model, a, b) for a, b in zip(found, found[1:], strict=False)])
    assert np.abs(moves).max() < 0.15
    held = found[int(np.ceil(plan.duration() / DT)) :]
    np.testing.assert_allclose(held, [held[0]] * len(held), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(found[:, 3:7], axis=1), 1.0, atol=1e-9)


def test_more_than_the_plan_lasts_can_be_asked_for_and_less(case):
    plan, urdf_model, found = case
    np.testing.assert_array_equal(postures_along(urdf_model, plan, 5, DT), found[:5])
