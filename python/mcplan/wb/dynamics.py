"""Inverse dynamics of all nodes of a motion by Pinocchio, of a model whose base is six joints of one degree of freedom.

Such a model has configurations that are vectors and velocities that are their derivatives; derivatives of its inverse
dynamics are Pinocchio's own. It is singular where the base is pitched by 90 degrees.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import wb as _core

if TYPE_CHECKING:
    from .motion_model import MotionModel

Array = NDArray[np.float64]

#: Taken for limits that a URDF does not give [rad, rad/s, N m].
NO_POSITION, NO_VELOCITY, NO_TORQUE = 1e3, 1e3, 1e4


@dataclass(frozen=True)
class SplineModel:
    """A robot whose configuration is that of a motion's splines: px, py, pz, rz, ry, rx of the base, then joints.

    Attributes:
        model: Pinocchio's, without frames; joint i has velocity i - 1.
        joints: Joint that carries each end-effector.
        placements: Frame of each end-effector's sole in the frame of that joint.
        limits: (nv, 4) lowest and highest position, largest velocity and torque; zeros of the base.
    """

    model: Any
    joints: list[int]
    placements: list[Any]
    limits: Array


def spline_model(motion_model: MotionModel, gravity: float) -> SplineModel:
    """The same robot with six joints for its free-flyer, and joints without limits as angles."""
    import pinocchio as pin  # type: ignore[import-untyped]

    old, identity, joint = motion_model.model, pin.SE3.Identity(), 0
    model = pin.Model()
    for name, kind in zip(("px", "py", "pz", "rz", "ry", "rx"), ("PX", "PY", "PZ", "RZ", "RY", "RX"), strict=True):
        joint = model.addJoint(joint, getattr(pin, f"JointModel{kind}")(), identity, f"mcplan/{name}")
    model.appendBodyToJoint(joint, old.inertias[1], old.jointPlacements[1])
    number = {1: joint}
    limits = np.zeros((old.nv, 4))
    for i in range(2, old.njoints):
        kind = old.joints[i].shortname().removeprefix("JointModel")
        one = old.joints[i] if old.nqs[i] == 1 else _bounded(kind)
        number[i] = model.addJoint(number[old.parents[i]], one, old.jointPlacements[i], old.names[i])
        model.appendBodyToJoint(number[i], old.inertias[i], identity)
        at, v = old.idx_qs[i], old.idx_vs[i]
        low, high = old.lowerPositionLimit[at], old.upperPositionLimit[at]
        bounded = old.nqs[i] == 1 and high - low > 1e-6 and max(abs(low), abs(high)) < NO_POSITION
        limits[v, :2] = (low, high) if bounded else (-NO_POSITION, NO_POSITION)
    limits[6:, 2] = np.where(np.isfinite(motion_model.speed), motion_model.speed, NO_VELOCITY)
    limits[6:, 3] = np.where(np.isfinite(motion_model.effort), motion_model.effort, NO_TORQUE)
    armature = np.zeros(model.nv)
    armature[6:] = old.armature[6:]
    model.armature = armature
    model.gravity.linear = np.array([0.0, 0.0, -gravity])
    frames = [old.frames[frame] for frame in motion_model.frames]
    return SplineModel(model, [number[f.parentJoint] for f in frames], [f.placement for f in frames], limits)


def _bounded(kind: str) -> Any:
    """The joint about the same axis whose position is an angle, of one that holds cosine and sine."""
    import pinocchio as pin

    return getattr(pin, f"JointModelR{kind.removeprefix('RUB').lower().upper()}")()


def add_links(problem: _core.Problem, spline: SplineModel) -> None:
    """Give a problem the links of a robot and the frames of its soles."""
    import pinocchio as pin

    model = spline.model
    data = model.createData()
    q = np.zeros(model.nq)
    pin.computeJointJacobians(model, data, q)
    for joint in range(1, model.njoints):
        column = data.oMi[joint].actInv(pin.Motion(data.J[:, joint - 1])).vector
        prismatic = bool(np.linalg.norm(column[3:]) < 1e-9)
        placement, inertia = model.jointPlacements[joint], model.inertias[joint]
        problem.add_link(
            model.names[joint],
            int(model.parents[joint]) - 1,
            prismatic,
            column[:3] if prismatic else column[3:],
            placement.rotation,
            placement.translation,
            inertia.mass,
            inertia.lever,
            spline.limits[joint - 1],
        )


class Dynamics:
    """Fills the arrays of a solver: torques and derivatives at every node."""

    def __init__(self, spline: SplineModel) -> None:
        import pinocchio as pin

        self.pin, self.model, self.data = pin, spline.model, spline.model.createData()
        self.joints = spline.joints
        self.to_joint = [placement.toDualActionMatrix() for placement in spline.placements]
        self.forces = pin.StdVec_Force()
        for _ in range(spline.model.njoints):
            self.forces.append(pin.Force.Zero())
        self.solver: _core.Solver | None = None

    def __call__(self, derivatives: bool) -> None:
        pin, model, data, solver, forces = self.pin, self.model, self.data, self.solver, self.forces
        assert solver is not None
        q, v, a, tau, dq, dv, da = (getattr(solver, n) for n in ("q", "v", "a", "tau", "dq", "dv", "da"))
        wrenches = solver.wrenches_S.reshape(len(q), len(self.joints), 6)
        on_joints = np.stack([wrenches[:, e] @ to.T for e, to in enumerate(self.to_joint)], axis=1)
        for k in range(len(q)):
            for joint in set(self.joints):
                forces[joint] = pin.Force.Zero()
            for e, joint in enumerate(self.joints):
                forces[joint] = forces[joint] + pin.Force(on_joints[k, e])
            if derivatives:
                pin.computeRNEADerivatives(model, data, q[k], v[k], a[k], forces)
                tau[k], dq[k], dv[k], da[k] = data.tau, data.dtau_dq, data.dtau_dv, data.M
            else:
                tau[k] = pin.rnea(model, data, q[k], v[k], a[k], forces)
