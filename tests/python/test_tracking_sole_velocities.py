"""Velocities of soles' corners as the controller says them, against differences of the corners' places."""

import numpy as np
import pytest

import tracked

pin = pytest.importorskip("pinocchio")
pytest.importorskip("proxsuite")
pytest.importorskip("example_robot_data")

from mcplan.kinematics.inverse_kinematics import follow  # noqa: E402
from mcplan.kinematics.samples import sample_at  # noqa: E402
from mcplan.tracking import Gains  # noqa: E402
from mcplan.tracking.controller import Controller  # noqa: E402


def test_corners_move_as_the_links_of_the_feet_do_and_hands_as_points():
    urdf_model = tracked.urdf_model("talos")
    plan, desired = tracked.still("talos")
    start = follow(urdf_model, sample_at(plan, plan.scene, plan.robot, np.zeros(1))).configurations[0]
    controller = Controller(urdf_model, plan.scene, desired, start, Gains())
    velocity, h = np.random.default_rng(3).uniform(-1.0, 1.0, urdf_model.model.nv), 1e-6
    controller.step(0, start, velocity, np.array([end.kind == "foot" for end in urdf_model.robot.end_effectors]))
    places = []
    for sign in (-1.0, 1.0):
        data = urdf_model.model.createData()
        pin.framesForwardKinematics(urdf_model.model, data, pin.integrate(urdf_model.model, start, sign * h * velocity))
        places.append([data.oMf[frame] for frame in urdf_model.frames])
    for end, before, after, found in zip(
        urdf_model.robot.end_effectors, *places, controller.sole_velocities_W(), strict=True
    ):
        x, y = end.half_size
        corners = [(a * x, b * y, 0.0) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))] if x > 0 else [(0.0, 0.0, 0.0)]
        expected = [(after.act(np.array(c)) - before.act(np.array(c))) / (2.0 * h) for c in corners]
        np.testing.assert_allclose(found, expected, atol=1e-6)
