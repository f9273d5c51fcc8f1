"""Recordings of planar robots made without a simulator: a plan's motion, off by a known amount."""

from __future__ import annotations

import functools

import numpy as np

from mcplan._core import PlanarPlan
from mcplan.planar.tracking import PlanarRecording
from mcplan.planar.view.samples import body_frames, rotated, sample_whole_body
from reference_solutions import reference_plan

#: [m], [rad] by which base and first joint are off the plan; factor on the contact forces; share of the feedback.
OFFSET, TURN = np.array([0.004, -0.003, 0.0]), 0.01
SCALE, FEEDBACK = 1.05, 0.1


def recorded(plan: PlanarPlan, rate_hz: float = 200.0) -> PlanarRecording:
    """A run in which the base is off by OFFSET, the first joint by TURN, forces and torques by their factors."""
    times = np.arange(0.0, plan.duration(), 1.0 / rate_hz)
    samples = sample_whole_body(plan, times)
    robot = plan.task.robot
    base, q = samples.base + OFFSET, samples.q.copy()
    q[:, 0] += TURN
    positions, angles = body_frames(robot, base, q)
    points = np.full(samples.points_W.shape, np.nan)
    for e, end in enumerate(robot.end_effectors):
        along = np.array([np.cos(end.angle_B), np.sin(end.angle_B)])
        for p, at in enumerate(end.points):
            where_B = np.asarray(end.position_B) + float(at) * along
            points[:, e, p] = positions[:, end.body] + rotated(angles[:, end.body], where_B)
    known = np.isfinite(points)
    forces_plan = np.where(known, np.nan_to_num(samples.forces_W), np.nan)
    limits = np.array([b.torque_max for b in robot.bodies[1:]])
    return PlanarRecording(
        plan=plan,
        joints=tuple(b.name for b in robot.bodies[1:]),
        end_effectors=tuple(e.name for e in robot.end_effectors),
        times_s=times,
        phases=samples.phases,
        base=base,
        base_plan=samples.base,
        base_velocity=np.gradient(base, times, axis=0),
        base_velocity_plan=np.gradient(samples.base, times, axis=0),
        q=q,
        q_plan=samples.q,
        velocity=samples.velocity,
        velocity_plan=samples.velocity,
        torques=samples.torque * (1.0 + FEEDBACK),
        feedforward=samples.torque,
        feedback=samples.torque * FEEDBACK,
        torque_limits=limits,
        points_W=points,
        points_contact_W=samples.points_W,
        forces_W=forces_plan * SCALE,
        forces_plan_W=forces_plan,
        surfaces_plan=samples.surfaces,
        left_plan_at_s=np.inf,
    )


@functools.cache
def walking() -> PlanarRecording:
    """Of the optimised walk."""
    return recorded(reference_plan("walking", "optimised_per_point"))
