"""A motion at a frame rate, in the form in which plans are drawn: its own CoM, feet and forces, not the plan's."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import rotations_of
from mcplan.kinematics.samples import Samples, contact_intervals

if TYPE_CHECKING:
    from mcplan.wb import Motion

Array = NDArray[np.float64]

#: A contact with less normal force has no centre of pressure to speak of [N].
BEARS_N = 1.0


def motion_frames(motion: Motion, rate_hz: float) -> tuple[Samples, Array]:
    """Samples of a motion at about a rate [1/s], start and end included, and configurations (n, nq) of the complete robot."""
    plan, duration = motion.plan, motion.duration()
    times = np.linspace(0.0, duration, max(2, round(duration * rate_hz) + 1))
    states = motion.sample(times)
    forces_W, moments_W = states.wrenches_W[..., :3], states.wrenches_W[..., 3:]
    normals = states.rotations_W[..., 2]
    along = np.einsum("nei,nei->ne", normals, forces_W)[..., None]
    # n x (m) / (n . f): the point of the sole's plane about which no moment but one along the normal is left.
    offset = np.cross(normals, moments_W) / np.where(along > BEARS_N, along, np.inf)
    velocity_W, ends_W = np.gradient(states.com_W, times, axis=0), states.end_effectors_W
    count, ends = ends_W.shape[:2]
    samples = Samples(
        times_s=times,
        com_W=states.com_W,
        com_velocity_W=velocity_W,
        com_acceleration_W=np.gradient(velocity_W, times, axis=0),
        rotation_WB=rotations_of(states.q[:, 3:7]),
        positions_W=ends_W,
        velocities_W=np.gradient(ends_W, times, axis=0),
        rotations_W=states.rotations_W,
        forces_W=forces_W,
        pressure_W=ends_W + offset,
        moments_W=np.zeros((count, ends, 3)),
        points_W=np.zeros((count, ends, 0, 3)),
        point_forces_W=np.zeros((count, ends, 0, 3)),
        angular_momentum_W=np.zeros((count, 3)),
        surfaces=states.surfaces.astype(np.int64),
        intervals=contact_intervals(plan, plan.scene, plan.robot),
        has_wrenches=True,
    )
    return samples, motion.model.complete_configurations(states.q)
