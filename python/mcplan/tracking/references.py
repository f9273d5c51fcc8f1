"""A plan as a tracker needs it: at every control step, with accelerations, and with the soles' directions."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import rotations_of
from mcplan.kinematics.samples import Samples, sample_at

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot

Array = NDArray[np.float64]

#: Swings have kinks where they are kept at a limit of reach: differences of their velocity are cut off here [m/s^2].
LARGEST_SWING_ACCELERATION = 60.0


@dataclass(frozen=True)
class References:
    """Desired motion and forces at n instants, dt apart, world frame W, SI; e end-effectors.

    Attributes:
        dt_s: Time between instants.
        duration_s: Duration of the plan; later instants have its last state.
        com_W, com_velocity_W, com_acceleration_W: (n, 3).
        momentum_W, momentum_rate_W: (n, 3) angular, about the CoM.
        base_WB: (n, 3, 3); base_velocity_W: (n, 3) angular.
        end_effectors_W, end_effector_velocities_W, end_effector_accelerations_W: (n, e, 3).
        soles_W: (n, e, 3, 3): z the normal of the ground, x ahead; sole_velocities_W: (n, e, 3) angular.
        forces_W: (n, e, 3), and pressure_W (n, e, 3): where they act; moments_W (n, e, 3): about there.
        surfaces: (n, e) surface in contact or -1.
        swing_fraction: (n, e) fraction of the swing that has passed, 0 to 1; 1 in contact.
        returns: (n, e) whether a free end-effector will be in contact later.
        base_acceleration_W: (n, 3) angular; sole_accelerations_W: (n, e, 3) angular. None: not known, taken as zero.
        next_surfaces: (n, e) surface in contact or in contact next, -1: none; None: these instants are all that there are.
    """

    dt_s: float
    duration_s: float
    com_W: Array
    com_velocity_W: Array
    com_acceleration_W: Array
    momentum_W: Array
    momentum_rate_W: Array
    base_WB: Array
    base_velocity_W: Array
    end_effectors_W: Array
    end_effector_velocities_W: Array
    end_effector_accelerations_W: Array
    soles_W: Array
    sole_velocities_W: Array
    forces_W: Array
    pressure_W: Array
    moments_W: Array
    surfaces: NDArray[np.int64]
    swing_fraction: Array
    returns: NDArray[np.bool_]
    base_acceleration_W: Array | None = None
    sole_accelerations_W: Array | None = None
    next_surfaces: NDArray[np.int64] | None = None

    @property
    def count(self) -> int:
        return len(self.com_W)

    def with_base(self, quats_xyzw: Array) -> References:
        """The same with other orientations of the base, (n, 4)."""
        base_WB = rotations_of(quats_xyzw)
        return replace(self, base_WB=base_WB, base_velocity_W=angular_velocity(base_WB, self.dt_s))


def references(plan: Plan, robot: Robot, dt_s: float, hold_s: float) -> References:
    """Sample a plan at control steps.

    Args:
        plan: The plan; its end-effectors are those of `robot`, in the same order.
        robot: The robot whose mass scales the plan's forces and angular momentum.
        dt_s: Control step [s].
        hold_s: Time for which the last state is kept [s].
    """
    duration = float(plan.duration())
    count = int(np.ceil((duration + hold_s) / dt_s)) + 1
    times = np.minimum(np.arange(count) * dt_s, duration)
    samples = sample_at(plan, plan.scene, plan.robot, times)
    over = np.arange(count) * dt_s > duration
    surfaces = samples.surfaces.copy()
    surfaces[over] = list(plan.final_contacts)
    com_velocity, velocities = samples.com_velocity_W.copy(), samples.velocities_W.copy()
    com_velocity[over], velocities[over] = 0.0, 0.0
    acceleration = samples.com_acceleration_W.copy()
    acceleration[over] = 0.0
    scale = robot.mass / plan.robot.mass
    momentum = samples.angular_momentum_W * scale
    momentum[over] = 0.0
    momentum_rate = np.gradient(momentum, dt_s, axis=0)
    if all(phase.has_wrenches for phase in plan.phases):
        momentum_rate = scale * moment_about_com(samples)
        momentum_rate[over] = 0.0
    forces, moments = samples.forces_W * scale, samples.moments_W * scale
    forces[over], moments[over] = standing_forces(plan, robot), 0.0
    end_acceleration = np.gradient(velocities, dt_s, axis=0)
    size = np.linalg.norm(end_acceleration, axis=2, keepdims=True)
    end_acceleration *= np.minimum(1.0, LARGEST_SWING_ACCELERATION / np.maximum(size, 1e-9))
    end_acceleration[surfaces >= 0] = 0.0
    fraction, returns = swings(surfaces)
    return References(
        dt_s=dt_s,
        duration_s=duration,
        com_W=samples.com_W,
        com_velocity_W=com_velocity,
        com_acceleration_W=acceleration,
        momentum_W=momentum,
        momentum_rate_W=momentum_rate,
        base_WB=samples.rotation_WB,
        base_velocity_W=angular_velocity(samples.rotation_WB, dt_s),
        end_effectors_W=samples.positions_W,
        end_effector_velocities_W=velocities,
        end_effector_accelerations_W=end_acceleration,
        soles_W=samples.rotations_W,
        sole_velocities_W=angular_velocity(samples.rotations_W, dt_s),
        forces_W=forces,
        pressure_W=samples.pressure_W,
        moments_W=moments,
        surfaces=surfaces,
        swing_fraction=fraction,
        returns=returns,
    )


def moment_about_com(samples: Samples) -> Array:
    """(n, 3) what the contacts add to the angular momentum: sum (a - p) x f + tau [N m]."""
    arms = samples.pressure_W - samples.com_W[:, None]
    return np.asarray((np.cross(arms, samples.forces_W) + samples.moments_W).sum(axis=1))


def standing_forces(plan: Plan, robot: Robot) -> Array:
    """(e, 3) the weight, distributed to the end-effectors in contact at the end [N]."""
    down = [surface >= 0 for surface in plan.final_contacts]
    forces = np.zeros((len(down), 3))
    forces[down, 2] = robot.mass * plan.scene.gravity / max(sum(down), 1)
    return forces


def angular_velocity(rotations: Array, dt_s: float) -> Array:
    """World-frame rates (n, ..., 3) of rotations (n, ..., 3, 3), by central differences: vee(dR R^T)."""
    rate = np.gradient(rotations, dt_s, axis=0) @ np.swapaxes(rotations, -1, -2)
    skew = 0.5 * (rate - np.swapaxes(rate, -1, -2))
    return np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)


def swings(surfaces: NDArray[np.int64]) -> tuple[Array, NDArray[np.bool_]]:
    """``swing_fraction`` and ``returns`` of References."""
    fraction = np.ones(surfaces.shape)
    returns = np.zeros(surfaces.shape, dtype=bool)
    for end in range(surfaces.shape[1]):
        free = np.flatnonzero(surfaces[:, end] < 0)
        for run in np.split(free, np.flatnonzero(np.diff(free) > 1) + 1):
            if len(run):
                fraction[run, end] = np.linspace(0.0, 1.0, len(run))
                returns[run, end] = run[-1] + 1 < len(surfaces)
    return fraction, returns
