"""A motion as a tracker needs it: at every control step, joints included, with all velocities and accelerations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .joint_references import JointReferences
from .references import References, swings

if TYPE_CHECKING:
    from mcplan.wb import Motion, MotionSamples

Array = NDArray[np.float64]

#: A contact with less normal force has no centre of pressure to speak of [N].
BEARS_N = 1.0


def motion_references(motion: Motion, dt_s: float, hold_s: float) -> tuple[References, JointReferences, Array]:
    """Sample a motion at control steps.

    Args:
        motion: The motion.
        dt_s: Control step [s].
        hold_s: Time for which the last state is kept [s].

    Returns:
        References, those of the joints, and the first and last configuration (2, nq) of the robot with all its joints.
    """
    plan, duration = motion.plan, motion.duration()
    count = int(np.ceil((duration + hold_s) / dt_s)) + 1
    times = np.arange(count) * dt_s
    over = times > duration
    samples = motion.sample(np.minimum(times, duration))
    samples.v[over], samples.a[over] = 0.0, 0.0
    surfaces = samples.surfaces.astype(np.int64)
    surfaces[over] = list(plan.final_contacts)
    forces_W, pressure_W, moments_W = _about_pressure(samples)
    moving = _moving(motion, samples)
    fraction, returns = swings(surfaces)
    desired = References(
        dt_s=dt_s,
        duration_s=duration,
        com_W=samples.com_W,
        com_velocity_W=moving["com_velocity_W"],
        com_acceleration_W=moving["com_acceleration_W"],
        momentum_W=moving["momentum_W"],
        momentum_rate_W=moving["momentum_rate_W"],
        base_WB=moving["base_WB"],
        base_velocity_W=moving["base_velocity_W"],
        base_acceleration_W=moving["base_acceleration_W"],
        end_effectors_W=samples.end_effectors_W,
        end_effector_velocities_W=moving["velocities_W"][..., :3],
        end_effector_accelerations_W=moving["accelerations_W"][..., :3],
        soles_W=samples.rotations_W,
        sole_velocities_W=moving["velocities_W"][..., 3:],
        sole_accelerations_W=moving["accelerations_W"][..., 3:],
        forces_W=forces_W,
        pressure_W=pressure_W,
        moments_W=moments_W,
        surfaces=surfaces,
        swing_fraction=fraction,
        returns=returns,
    )
    configurations = motion.model.complete_configurations(samples.q)
    rates, accelerations = (motion.model.complete_velocities(each)[:, 6:] for each in (samples.v, samples.a))
    joints = JointReferences(configurations[:, 7:], rates, accelerations)
    return desired, joints, configurations[[0, -1]]


def _about_pressure(samples: MotionSamples) -> tuple[Array, Array, Array]:
    """Forces, centres of pressure, and the moments about these: n x m / (n f) beside the end-effector no tilting moment is
    left."""
    forces, moments = samples.wrenches_W[..., :3], samples.wrenches_W[..., 3:]
    normals = samples.rotations_W[..., 2]
    along = np.einsum("nei,nei->ne", normals, forces)[..., None]
    offset = np.cross(normals, moments) / np.where(along > BEARS_N, along, np.inf)
    return forces, samples.end_effectors_W + offset, moments - np.cross(offset, forces)


def _moving(motion: Motion, samples: MotionSamples) -> dict[str, Array]:
    """Rates of CoM, angular momentum, base and end-effectors, by Pinocchio."""
    import pinocchio as pin  # type: ignore[import-untyped]

    model, data, frames = motion.model.model, motion.model.model.createData(), motion.model.frames
    count, ends, axes = len(samples), len(frames), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    shapes = {"com_velocity_W": (3,), "com_acceleration_W": (3,), "momentum_W": (3,), "momentum_rate_W": (3,)}
    shapes |= {"base_WB": (3, 3), "base_velocity_W": (3,), "base_acceleration_W": (3,)}  # type: ignore[dict-item]
    shapes |= {"velocities_W": (ends, 6), "accelerations_W": (ends, 6)}  # type: ignore[dict-item]
    found = {name: np.zeros((count, *shape)) for name, shape in shapes.items()}
    for n in range(count):
        q, v, a = samples.q[n], samples.v[n], samples.a[n]
        pin.centerOfMass(model, data, q, v, a)
        found["com_velocity_W"][n], found["com_acceleration_W"][n] = data.vcom[0], data.acom[0]
        pin.computeCentroidalMomentumTimeVariation(model, data, q, v, a)
        found["momentum_W"][n], found["momentum_rate_W"][n] = data.hg.angular, data.dhg.angular
        rotation = data.oMi[1].rotation
        found["base_WB"][n] = rotation
        found["base_velocity_W"][n], found["base_acceleration_W"][n] = rotation @ v[3:6], rotation @ a[3:6]
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        for end, frame in enumerate(frames):
            found["velocities_W"][n, end] = pin.getFrameVelocity(model, data, frame, axes).vector
            found["accelerations_W"][n, end] = pin.getFrameClassicalAcceleration(model, data, frame, axes).vector
    return found
