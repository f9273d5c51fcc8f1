"""Run a whole-body plan in MuJoCo: the plan's torques and weak feedback on the joints, nothing on the base."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..options import Options
from .measures import PlanarMeasures, measure
from .mjcf import Array, ContactSettings, Feedback, build
from .recording import PlanarRecording
from .simulation import PlanarSimulation

if TYPE_CHECKING:
    from mcplan._core import WholeBodyPlan, WholeBodyState

#: A robot that is further than this from its plan has left it: base [m], [rad].
LEFT_PLAN_M = 0.1
LEFT_PLAN_RAD = 0.3


@dataclass(frozen=True)
class PlanarResult:
    """What came of tracking a whole-body plan.

    Attributes:
        recording: What the robot did.
        measures: How well, and how near its contact forces were to the planned ones.
        options: What was asked for.
    """

    recording: PlanarRecording
    measures: PlanarMeasures
    options: Options


def track_whole_body(
    plan: WholeBodyPlan,
    options: Options | None = None,
    feedback: Feedback | None = None,
    contacts: ContactSettings | None = None,
) -> PlanarResult:
    options = options or Options()
    plan.validate()
    model = build(
        plan.motion,
        step_s=options.simulation_step_s,
        contacts=contacts,
        feedback=feedback,
        mass_scale=options.mass_scale,
        friction_scale=options.friction_scale,
        ground_shift_m=options.ground_shift_m,
    )
    simulation = PlanarSimulation(model)
    simulation.reset(plan.at(0.0).configuration)
    steps = round(options.control_step_s / options.simulation_step_s)
    rows = []
    left = float("inf")
    start = time.perf_counter()
    count = round((plan.duration() + options.hold_s) / options.control_step_s)
    for k in range(count + 1):
        now = k * options.control_step_s
        state = plan.at(min(now, plan.duration()))
        row = _control(simulation, state)
        rows.append(row | {"times_s": now, "phases": state.phase})
        if _has_left(row):
            left = now
            break
        simulation.advance(steps)
    wall = time.perf_counter() - start
    recording = _recording(plan, rows, left)
    return PlanarResult(recording, measure(recording, simulation.warnings, wall), options)


def _control(simulation: PlanarSimulation, state: WholeBodyState) -> dict[str, Any]:
    """Apply the torques of an instant; what is to be recorded of it."""
    asked = state.configuration
    at, velocity = simulation.positions, simulation.velocities
    back = simulation.apply(state.torque, asked.q, asked.velocity)
    points, forces = simulation.points_W(), simulation.forces_W()
    forces_plan, contact_points, surfaces = _planned(simulation, state, np.isnan(points))
    return {
        "base": at[:3],
        "base_plan": asked.base,
        "base_velocity": velocity[:3],
        "base_velocity_plan": asked.base_velocity,
        "q": at[3:],
        "q_plan": asked.q,
        "velocity": velocity[3:],
        "velocity_plan": asked.velocity,
        "torques": simulation.applied_torques(),
        "feedforward": state.torque,
        "feedback": back,
        "points_W": points,
        "points_contact_W": contact_points,
        "forces_W": forces,
        "forces_plan_W": forces_plan,
        "surfaces_plan": surfaces,
    }


def _planned(simulation: PlanarSimulation, state: WholeBodyState, absent: Any) -> tuple[Array, Array, Any]:
    """Of the plan at an instant: forces (e, p, 2), points where contacts put them (e, p, 2), surfaces (e,)."""
    motion = simulation.model.motion
    forces = np.where(absent, np.nan, 0.0)
    for force in state.forces:
        forces[force.end_effector, force.point] = force.force_W
    points = np.full(absent.shape, np.nan)
    surfaces = np.full(len(absent), -1)
    for contact in motion.phases[state.phase].contacts:
        e = contact.end_effector
        along = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        for i, point in enumerate(motion.robot.end_effectors[e].points):
            points[e, i] = contact.position_W + point * along
        surfaces[e] = contact.surface
    return forces, points, surfaces


def _has_left(row: dict[str, Any]) -> bool:
    off = np.abs(row["base"] - row["base_plan"])
    joints = np.abs(row["q"] - row["q_plan"])
    stays = np.hypot(off[0], off[1]) < LEFT_PLAN_M and max(off[2], joints.max()) < LEFT_PLAN_RAD
    return not stays  # what is not a number has left, too


def _recording(plan: WholeBodyPlan, rows: list[dict[str, Any]], left_plan_at_s: float) -> PlanarRecording:
    robot = plan.motion.robot
    return PlanarRecording(
        plan=plan,
        joints=tuple(body.name for body in robot.bodies[1:]),
        ends=tuple(end.name for end in robot.end_effectors),
        torque_limits=np.array([body.torque_max for body in robot.bodies[1:]]),
        left_plan_at_s=left_plan_at_s,
        **{name: np.array([row[name] for row in rows]) for name in rows[0]},
    )
