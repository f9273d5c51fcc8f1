"""Contact forces read from MuJoCo, against Newton-Euler of mcplan: together with the torques they explain the motion."""

from __future__ import annotations

import numpy as np
import pytest

from mcplan import _core

mujoco = pytest.importorskip("mujoco")
from mcplan.planar.tracking.mjcf import build  # noqa: E402
from mcplan.planar.tracking.simulation import PlanarSimulation  # noqa: E402
from mcplan.tracking import Options  # noqa: E402
from tracked_cartwheel import cartwheel  # noqa: E402


def configuration(simulation: PlanarSimulation) -> _core.PlanarConfiguration:
    """Of the simulated robot, with the acceleration that MuJoCo found."""
    q, v = simulation.positions, simulation.velocities
    a = simulation._data.qacc[simulation.model.dofs]
    return _core.PlanarConfiguration(
        base=q[:3], base_velocity=v[:3], base_acceleration=a[:3], q=q[3:], velocity=v[3:], acceleration=a[3:]
    )


def test_torques_and_contact_forces_explain_the_accelerations():
    plan = cartwheel()
    robot = plan.task.robot
    simulation = PlanarSimulation(build(plan.task, Options(simulation_step_s=2e-4)))
    simulation.reset(plan.at(0.0).configuration)
    touched = set()
    for t in np.arange(0.0, plan.duration(), 0.01):
        state = plan.at(float(t))
        simulation.apply(state.torque, state.configuration.q, state.configuration.velocity)
        points, forces = simulation.points_W(), simulation.forces_W()
        acting = [
            # Spheres are pressed a little into the ground, and forces act in the middle of what overlaps.
            _core.PlanarForce(body=end.body, point_W=points[e, i], force_W=forces[e, i])
            for e, end in enumerate(robot.end_effectors)
            for i in range(len(end.points))
        ]
        found = _core.planar_inverse_dynamics(robot, configuration(simulation), acting)
        size = np.abs(forces).max()
        np.testing.assert_allclose(found.base_residual[:2], 0.0, atol=1e-8 * (1 + size))
        np.testing.assert_allclose(found.base_residual[2], 0.0, atol=1e-3 * (1 + size))
        np.testing.assert_allclose(found.torque, simulation.applied_torques(), atol=1e-3 * (1 + size))
        touched |= {robot.end_effectors[e].name for e in np.flatnonzero(np.abs(forces).sum(axis=(1, 2)))}
        simulation.advance(50)
    assert touched == {"A", "B", "C"}


def test_feedback_is_what_motors_add_to_the_torques():
    plan = cartwheel()
    simulation = PlanarSimulation(build(plan.task))
    asked = plan.at(0.1)
    simulation.reset(plan.at(0.0).configuration)
    added = simulation.apply(asked.torque, asked.configuration.q, asked.configuration.velocity)
    assert np.abs(added).max() > 1e-3
    np.testing.assert_allclose(simulation.applied_torques(), asked.torque + added, atol=1e-9)


def test_time_and_warnings_begin_anew():
    simulation = PlanarSimulation(build(cartwheel().task, Options(simulation_step_s=1e-3)))
    simulation.reset(cartwheel().at(0.0).configuration)
    simulation.advance(30)
    assert simulation.time_s == pytest.approx(0.03)
    simulation.reset(cartwheel().at(0.0).configuration)
    assert simulation.time_s == 0.0
    assert simulation.warnings == 0
