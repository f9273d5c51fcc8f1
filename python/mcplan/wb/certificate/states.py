"""A motion at equally spaced instants: all that the constraints are about, worked out again from its numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidOptions

from .inputs import CertifiedMotion
from .robot import CertifiedRobot, configurations
from .spline import spline_at

Array = NDArray[np.float64]

#: Instants at most: each takes about 6 kB.
MAX_SAMPLES = 500_000


@dataclass(frozen=True)
class States:
    """States at N instants, of a robot with L end-effectors, J moving joints and B joints in all.

    World frame W; contact forces as linear between nodes in the frames S of soles.
    """

    times: Array  # (N,)
    coordinates: Array  # (N, 6 + J) base position, Z-Y-X angles, joints
    rates: Array  # (N, 6 + J)
    q: Array  # (N, nq) Pinocchio's, all joints
    v: Array  # (N, nv)
    a: Array  # (N, nv)
    contacts: NDArray[np.int64]  # (N, L) surface, -1: none
    corner_forces_S: Array  # (N, L, 4, 3)
    corner_forces_W: Array  # (N, L, 4, 3)
    corners_W: Array  # (N, L, 4, 3)
    tau: Array  # (N, J)
    residual_W: Array  # (N, 6) force and moment at the base's origin that no contact gives
    positions_W: Array  # (N, L, 3)
    rotations_W: Array  # (N, L, 3, 3)
    twists_W: Array  # (N, L, 6) velocity and angular velocity
    com_W: Array  # (N, 3)
    joint_rotations_W: Array  # (N, B, 3, 3)
    joint_positions_W: Array  # (N, B, 3)

    @property
    def base_W(self) -> Array:
        """(N, 3) position of the base."""
        return self.coordinates[:, :3]


def equally_spaced(motion: CertifiedMotion, sample_s: float) -> Array:
    """Instants from 0 to the end, at most `sample_s` apart.

    Raises:
        InvalidOptions: There would be too many.
    """
    count = max(1.0, np.ceil(motion.duration() / sample_s - 1e-9))
    if count > MAX_SAMPLES:
        raise InvalidOptions(
            "sample_s", f"must cut the motion into at most {MAX_SAMPLES} samples", f"{count:.6g} samples"
        )
    count = int(count)
    return np.linspace(0.0, motion.duration(), count + 1)


def states_of(motion: CertifiedMotion, robot: CertifiedRobot, times: Array) -> States:
    """States of a motion at some instants."""
    coordinates, rates, accelerations = spline_at(motion.times_s, motion.coefficients, times)
    q, v, a = _free_flyer(robot, coordinates, rates, accelerations)
    interval = np.clip(np.searchsorted(motion.times_s, times, side="right") - 1, 0, len(motion.times_s) - 2)
    forces_S = _between_nodes(motion, times, interval)
    wrenches_S = np.concatenate(
        [forces_S.sum(axis=2), np.cross(motion.corner_points_S[None], forces_S).sum(axis=2)], axis=2
    )
    found = _dynamics(robot, (q, v, a), wrenches_S)
    rotations_W, positions_W = found["rotations_W"], found["positions_W"]
    corners_W = positions_W[:, :, None] + np.einsum("kerc,epc->kepr", rotations_W, motion.corner_points_S)
    return States(
        times=times,
        coordinates=coordinates,
        rates=rates,
        q=q,
        v=v,
        a=a,
        contacts=motion.contacts[interval].astype(np.int64),
        corner_forces_S=forces_S,
        corner_forces_W=np.einsum("kerc,kepc->kepr", rotations_W, forces_S),
        corners_W=corners_W,
        **found,
    )


def _free_flyer(robot: CertifiedRobot, x: Array, dx: Array, ddx: Array) -> tuple[Array, Array, Array]:
    """q, v and a of Pinocchio's model: of roll, pitch, yaw r the angular velocity in the base's axes is J(r) r'."""
    import pinocchio as pin  # type: ignore[import-untyped]

    local, count = pin.ReferenceFrame.LOCAL, len(x)
    base, v, a = np.zeros((count, 7)), np.zeros((count, robot.model.nv)), np.zeros((count, robot.model.nv))
    for k in range(count):
        rpy, rate, second = x[k, 5:2:-1].copy(), dx[k, 5:2:-1].copy(), ddx[k, 5:2:-1]
        rotation = pin.rpy.rpyToMatrix(rpy)
        jacobian = pin.rpy.computeRpyJacobian(rpy, local)
        omega = jacobian @ rate
        linear = rotation.T @ dx[k, :3]
        base[k, :3], base[k, 3:] = x[k, :3], pin.Quaternion(rotation).coeffs()
        v[k, :3], v[k, 3:6] = linear, omega
        a[k, :3] = rotation.T @ ddx[k, :3]
        a[k, 3:6] = jacobian @ second + pin.rpy.computeRpyJacobianTimeDerivative(rpy, rate, local) @ rate
    a[:, :3] -= np.cross(v[:, 3:6], v[:, :3])
    v[:, robot.moving], a[:, robot.moving] = dx[:, 6:], ddx[:, 6:]
    return configurations(robot, base, x[:, 6:]), v, a


def _between_nodes(motion: CertifiedMotion, times: Array, interval: NDArray[np.int64]) -> Array:
    start, end = motion.times_s[interval], motion.times_s[interval + 1]
    ahead = ((times - start) / (end - start))[:, None, None, None]
    return motion.corner_forces_S[interval] * (1.0 - ahead) + motion.corner_forces_S[interval + 1] * ahead


class JointForces:
    """Contact wrenches as the forces on joints that Pinocchio takes, in a vector that is made once."""

    def __init__(self, robot: CertifiedRobot) -> None:
        import pinocchio as pin

        model = robot.model
        frames = [model.frames[number] for number in robot.urdf_model.frames]
        self._carriers = [(int(frame.parentJoint), frame.placement) for frame in frames]
        self._zero, self._forces = pin.Force.Zero(), pin.StdVec_Force()
        self._forces.extend([self._zero] * model.njoints)

    def __call__(self, wrenches_S: Array) -> Any:
        """Of wrenches (L, 6) in the frames of soles; until the next call."""
        import pinocchio as pin

        forces = self._forces
        for joint, _ in self._carriers:
            forces[joint] = self._zero
        for end in np.flatnonzero(wrenches_S.any(axis=1)):
            joint, placement = self._carriers[end]
            forces[joint] += placement.act(pin.Force(wrenches_S[end]))
        return forces


def _dynamics(robot: CertifiedRobot, trajectory: tuple[Array, Array, Array], wrenches_S: Array) -> dict[str, Array]:
    import pinocchio as pin

    model, data, frames = robot.model, robot.model.createData(), robot.urdf_model.frames
    count, ends, joints = len(wrenches_S), len(frames), model.njoints
    tau, residual, com = np.zeros((count, len(robot.moving))), np.zeros((count, 6)), np.zeros((count, 3))
    positions, rotations = np.zeros((count, ends, 3)), np.zeros((count, ends, 3, 3))
    twists = np.zeros((count, ends, 6))
    joint_rotations, joint_positions = np.zeros((count, joints, 3, 3)), np.zeros((count, joints, 3))
    aligned, joint_forces = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED, JointForces(robot)
    # Views of what Pinocchio's data hold: taken once, they are those of each posture in turn.
    of_joints = [place.rotation for place in data.oMi], [place.translation for place in data.oMi]
    of_ends = [data.oMf[frame].rotation for frame in frames], [data.oMf[frame].translation for frame in frames]
    for k, (q, v, a) in enumerate(zip(*trajectory, strict=True)):
        efforts = pin.rnea(model, data, q, v, a, joint_forces(wrenches_S[k]))
        pin.forwardKinematics(model, data, q, v)
        pin.updateFramePlacements(model, data)
        com[k] = pin.centerOfMass(model, data, q, False)
        tau[k] = efforts[robot.moving]
        joint_rotations[k], joint_positions[k] = of_joints
        rotations[k], positions[k] = of_ends
        residual[k, :3], residual[k, 3:] = joint_rotations[k, 1] @ efforts[:3], joint_rotations[k, 1] @ efforts[3:6]
        for end, frame in enumerate(frames):
            twists[k, end] = pin.getFrameVelocity(model, data, frame, aligned).vector
    return {
        "tau": tau,
        "residual_W": residual,
        "positions_W": positions,
        "rotations_W": rotations,
        "twists_W": twists,
        "com_W": com,
        "joint_rotations_W": joint_rotations,
        "joint_positions_W": joint_positions,
    }
