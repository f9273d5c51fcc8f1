"""Velocities, contact forces and joint torques of postures that follow a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .contact_wrenches import Contact, balanced_wrenches

if TYPE_CHECKING:
    from mcplan._core import Scene
    from mcplan.kinematics.inverse_kinematics import Postures
    from mcplan.kinematics.samples import Samples
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: [s] on either side of a posture, over which a parabola is fitted for its velocity and acceleration: shorter than a
#: swing, longer than the kinks where a joint comes to its limit.
HALF_WINDOW = 0.06


@dataclass(frozen=True)
class PostureTorques:
    """Estimates along a plan: n instants, nj joints, e end-effectors.

    Attributes:
        velocities, accelerations: (n, 6 + nj) Pinocchio's order and axes.
        planned: (n, nj) whether a joint carries a contact or moves a foot, so that its motion is the plan's.
        torques: (n, nj) [N m].
        residuals: (n, 6) wrench that the contacts cannot balance, in the base's axes: force [N], moment [N m].
        forces_W: (n, e, 3) contact forces that balance the postures [N].
    """

    velocities: Array
    accelerations: Array
    planned: NDArray[np.bool_]
    torques: Array
    residuals: Array
    forces_W: Array


@dataclass(frozen=True)
class _Case:
    """The robot's model and its data, on what it stands, the plan, and the model's mass over the plan's."""

    urdf_model: UrdfModel
    data: Any
    scene: Scene
    samples: Samples
    force_scale: float


def posture_torques(
    urdf_model: UrdfModel,
    scene: Scene,
    samples: Samples,
    postures: Postures,
    com_acceleration_W: Array,
    force_scale: float,
) -> PostureTorques:
    """Torques by inverse dynamics, tau = rnea(q, v, a) - sum J^T w, with contact wrenches w near to the plan's.

    Velocities and accelerations come from parabolas through neighbouring postures. The acceleration of the CoM is the
    plan's: it jumps where contacts change, and a parabola would smear that. Joints that neither carry a contact nor
    swing a foot are not the plan's: their torques are those that keep them at rest.

    Args:
        urdf_model: The robot's model; its end-effectors are those of the samples.
        scene: What the plan's surface indices mean.
        samples: The plan.
        postures: Postures that follow the plan.
        com_acceleration_W: (n, 3) the plan's [m/s^2].
        force_scale: The model's mass over the plan's.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    model = urdf_model.model
    data, count = model.createData(), samples.count
    result = PostureTorques(
        velocities=np.zeros((count, model.nv)),
        accelerations=np.zeros((count, model.nv)),
        planned=np.zeros((count, model.nv - 6), dtype=bool),
        torques=np.zeros((count, model.nv - 6)),
        residuals=np.zeros((count, 6)),
        forces_W=np.zeros((count, len(urdf_model.frames), 3)),
    )
    case = _Case(urdf_model, data, scene, samples, force_scale)
    height = float(np.ptp(np.append(samples.positions_W[0, :, 2], samples.com_W[0, 2]))) or 1.0
    for n, q in enumerate(postures.configurations):
        v, a = motion(pin, model, samples.times_s, postures.configurations, n)
        # What the base's acceleration lacks, in its axes, for the CoM to accelerate as the plan's does.
        pin.centerOfMass(model, data, q, v, a)
        a[:3] += data.oMi[1].rotation.T @ (com_acceleration_W[n] - data.acom[0])
        needed = pin.rnea(model, data, q, v, a)
        planned = result.planned[n] = _planned(urdf_model, samples, n)
        at_rest = np.zeros(model.nv)
        at_rest[:3] = data.oMi[1].rotation.T @ com_acceleration_W[n]
        needed[6:][~planned] = pin.rnea(model, data, q, np.zeros(model.nv), at_rest)[6:][~planned]
        in_contact = [end for end in range(len(urdf_model.frames)) if samples.surfaces[n, end] >= 0]
        contacts = [_contact(case, n, end, q) for end in in_contact]
        wrenches, residual = balanced_wrenches(contacts, needed[:6], height)
        torques = needed[6:].copy()
        for end, contact, wrench in zip(in_contact, contacts, wrenches, strict=True):
            torques -= contact.jacobian[:, 6:].T @ wrench
            result.forces_W[n, end] = wrench[:3]
        result.velocities[n], result.accelerations[n] = v, a
        result.torques[n], result.residuals[n] = torques, residual
    return result


def motion(pin: Any, model: Any, times: Array, configurations: Array, n: int) -> tuple[Array, Array]:
    """Velocity and acceleration (nv,) at a sample, of the least-squares parabola through it and its neighbours."""
    near = np.flatnonzero(np.abs(times - times[n]) <= HALF_WINDOW)
    if len(near) < 3:
        near = np.arange(max(0, min(n - 1, len(times) - 3)), min(len(times), max(n + 2, 3)))
    if len(near) < 3:
        return np.zeros(model.nv), np.zeros(model.nv)
    since = times[near] - times[n]
    away = np.array([pin.difference(model, configurations[n], configurations[k]) for k in near])
    fit = np.linalg.lstsq(np.column_stack([np.ones_like(since), since, 0.5 * since**2]), away, rcond=None)[0]
    return fit[1], fit[2]


def _planned(urdf_model: UrdfModel, samples: Samples, n: int) -> NDArray[np.bool_]:
    """Joints between the base and every foot, and every end-effector in contact."""
    model = urdf_model.model
    result = np.zeros(model.nv - 6, dtype=bool)
    for end, frame in enumerate(urdf_model.frames):
        if urdf_model.robot.end_effectors[end].kind == "foot" or samples.surfaces[n, end] >= 0:
            joints = [joint for joint in model.supports[model.frames[frame].parentJoint] if joint > 1]
            result[[model.joints[joint].idx_v - 6 for joint in joints]] = True
    return result


def _contact(case: _Case, n: int, end: int, q: Array) -> Contact:
    """The contact of an end-effector at a sample, in a posture (nq,)."""
    import pinocchio as pin

    urdf_model, data, samples, scale = case.urdf_model, case.data, case.samples, case.force_scale
    pin.computeJointJacobians(urdf_model.model, data, q)
    pin.updateFramePlacements(urdf_model.model, data)
    frame = urdf_model.frames[end]
    jacobian = pin.getFrameJacobian(urdf_model.model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
    surface = case.scene.surfaces[samples.surfaces[n, end]]
    position = data.oMf[frame].translation.copy()
    half = np.asarray(urdf_model.robot.end_effectors[end].half_size, float)
    corners = np.array([[x, y, 0.0] for x in {-half[0], half[0]} for y in {-half[1], half[1]}])
    return Contact(
        points_W=position + corners @ data.oMf[frame].rotation.T,
        normal_W=polygon_normal(np.asarray(surface.vertices_W)),
        friction=np.inf if surface.grasp else float(surface.friction),
        force_W=scale * samples.forces_W[n, end],
        moment_W=scale * _moment_about_end(samples, n, end) if samples.has_wrenches else None,
        position_W=position,
        jacobian=jacobian,
    )


def _moment_about_end(samples: Samples, n: int, end: int) -> Array:
    """(3,) the plan's contact moment about the end-effector [N m]."""
    arm = samples.pressure_W[n, end] - samples.positions_W[n, end]
    return np.asarray(samples.moments_W[n, end] + np.cross(arm, samples.forces_W[n, end]))
