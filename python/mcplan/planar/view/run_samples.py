"""A run of a planar robot in the form in which whole-body plans are drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.run_samples import frame_indices

from .samples import PlanarSamples, body_frames, rotated

if TYPE_CHECKING:
    from mcplan._core import PlanarRobot
    from mcplan.planar.tracking import PlanarRecording

Array = NDArray[np.float64]

#: Ratio of force to weight below which a point does not count as in contact.
TOUCH = 0.002


def sample_planar_run(recording: PlanarRecording, rate_hz: float) -> PlanarSamples:
    """What the robot did, at a frame rate: forces are the simulator's, wherever it has some."""
    return samples_at(recording, frame_indices(recording.times_s, rate_hz))


def samples_at(recording: PlanarRecording, chosen: NDArray[np.int64]) -> PlanarSamples:
    """What the robot did at some of the recording's instants."""
    task = recording.plan.task
    robot = task.robot
    base, q = recording.base[chosen], recording.q[chosen]
    positions, angles = body_frames(robot, base, q)
    end_effectors = robot.end_effectors
    soles = [positions[:, end.body] + rotated(angles[:, end.body], end.position_B) for end in end_effectors]
    points, forces = recording.points_W[chosen].copy(), recording.forces_W[chosen].copy()
    weight = float(robot.mass()) * float(robot.gravity)
    free = ~(np.linalg.norm(forces, axis=3) > TOUCH * weight)
    points[free] = forces[free] = np.nan
    normals, tangents = axes_of(recording, chosen)
    surfaces = recording.surfaces_plan[chosen]
    friction = np.array([float(s.friction) for s in task.surfaces])
    return PlanarSamples(
        times_s=recording.times_s[chosen],
        phases=recording.phases[chosen],
        base=base,
        q=q,
        velocity=recording.velocity[chosen],
        torque=recording.torques[chosen],
        com_W=com_of(robot, positions, angles),
        positions_W=positions,
        angles=angles,
        soles_W=np.stack(soles, axis=1),
        sole_angles=np.stack([angles[:, end.body] + float(end.angle_B) for end in end_effectors], axis=1),
        surfaces=surfaces,
        points_W=points,
        forces_W=forces,
        tangential=np.einsum("nepi,nei->nep", forces, tangents),
        normal=np.einsum("nepi,nei->nep", forces, normals),
        friction=np.where(surfaces >= 0, friction[np.maximum(surfaces, 0)], np.nan),
        errors=np.full((len(chosen), len(end_effectors), 3), np.nan),
    )


def axes_of(recording: PlanarRecording, chosen: NDArray[np.int64]) -> tuple[Array, Array]:
    """Normals and tangents (n, e, 2) of the surface of an end-effector's contact, else of its next or its last one; up
    and forward if none."""
    surfaces = recording.plan.task.surfaces
    n, e = recording.surfaces_plan.shape
    normals = np.tile([0.0, 1.0], (n, e, 1))
    tangents = np.tile([1.0, 0.0], (n, e, 1))
    for end in range(e):
        known = np.flatnonzero(recording.surfaces_plan[:, end] >= 0)
        if len(known):
            after = known[np.minimum(np.searchsorted(known, np.arange(n)), len(known) - 1)]
            on = recording.surfaces_plan[after, end]
            normals[:, end] = np.array([s.normal_W for s in surfaces])[on]
            tangents[:, end] = np.array([s.tangent_W for s in surfaces])[on]
    return normals[chosen], tangents[chosen]


def com_of(robot: PlanarRobot, positions_W: Array, angles: Array) -> Array:
    """CoM (n, 2) [m] of links at (n, b, 2) [m] rotated by (n, b) [rad]."""
    masses = np.array([float(body.mass) for body in robot.bodies])
    coms = [positions_W[:, i] + rotated(angles[:, i], body.com_B) for i, body in enumerate(robot.bodies)]
    return np.asarray(np.einsum("b,bni->ni", masses, np.array(coms)) / masses.sum())
