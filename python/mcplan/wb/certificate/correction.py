"""Contact forces changed as little as needed for the base to balance, within cones and torque limits.

Corner forces f give the base the wrench G f. What is missing, r, is made up for by d with G d = r, of least
sum_c |d_c|^2 / w_c^2: corners with a large normal force change by more. Where that leaves a cone, takes a torque over its
limit, or does not balance since corners that matter do not press, the problem is solved with the edges of a pyramid within
the cone, lambda >= 0, and with slacks s >= 0 of torques:

    min |G E lambda - b|^2 + eps |lambda - lambda_0|^2    s.t.  lambda >= 0,  |tau| <= limit

as a non-negative least-squares problem (Lawson and Hanson).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .footholds import normal_of
from .inputs import CertifiedMotion
from .robot import CertifiedRobot
from .states import JointForces, States

Array = NDArray[np.float64]

#: Edges of the pyramid; weights of the balance, the torque limits and the change, for forces in weights of the robot.
EDGES, BALANCE, TORQUE, CHANGE = 12, 1e4, 1e4, 1e-2
#: Singular values below this ratio of the largest are directions in which the contacts give no wrench.
RANK = 1e-9
#: Instants, the worst first, whose problem with inequalities is solved: of a motion with more of them much else is wrong.
MAX_SOLVED = 4000
#: Of which so many may leave more than is accepted before no more are.
MAX_FAILED = 100
#: Slack of a cone [N] and of a torque limit (ratio) within which the linear correction counts as admissible.
SLACK_N, SLACK_RATIO = 1e-6, 1e-9
#: What a linear correction may leave of a force or moment [N, N m].
LEFT = 1e-4


@dataclass(frozen=True)
class Correction:
    """What correcting the contact forces of N instants gives.

    Attributes:
        left_W: (N, 6) wrench on the base that is still missing; NaN where nothing is in contact.
        change_N: (N,) largest change of a corner's force.
        torque_use: (N,) largest torque over its limit.
        solved: Number of instants at which the problem with inequalities was solved.
    """

    left_W: Array
    change_N: Array
    torque_use: Array
    solved: int


def corrected(
    motion: CertifiedMotion, robot: CertifiedRobot, states: States, missing_W: Array, accepted: float
) -> Correction:
    """Correct the shipped forces of each instant with contacts, where they leave (N, 6) on the base.

    What is left is `accepted` up to that force or moment [N, N m]. Once a hundred instants are beyond it, others that would
    have to be solved are left out, as if nothing was left there.
    """
    cones = _cones(motion, states)
    changes, left = _least(states, cones, missing_W)
    instants, forces_W = _Instants(motion, robot, states, cones, missing_W), states.corner_forces_W + changes
    uses, wrenches_S = np.full(len(states.times), np.nan), instants.wrenches(np.arange(len(states.times)), forces_W)
    supported = np.flatnonzero(cones.in_contact.any(axis=(1, 2)))
    if supported.size:
        efforts = np.array([instants.efforts(k, wrenches_S[k]) for k in supported.tolist()])
        uses[supported] = (np.abs(efforts) / robot.effort).max(axis=1, initial=0.0)
    shipped = (np.abs(states.tau) / robot.effort).max(axis=1, initial=0.0)
    balanced = np.abs(left).max(axis=1) <= LEFT
    admissible = balanced & cones.hold(forces_W) & ~(uses > np.maximum(1.0, shipped) + SLACK_RATIO)
    inadmissible = supported[~admissible[supported]].tolist()
    inadmissible.sort(key=lambda k: -float(np.abs(missing_W[k]).max()))
    failed = 0
    for k in inadmissible[:MAX_SOLVED]:
        if failed == MAX_FAILED:
            left[k] = 0.0
            continue
        found = instants.solve(k)
        changes[k] = found - states.corner_forces_W[k]
        left[k] = missing_W[k] - _sum(instants.grasp(k), changes[k])
        uses[k] = instants.use(k, instants.wrenches([k], found[None])[0])
        failed += bool(np.abs(left[k]).max() > accepted)
    return Correction(left, np.linalg.norm(changes, axis=3).max(axis=(1, 2)), uses, len(inadmissible))


@dataclass(frozen=True)
class _Cones:
    """Of N instants, L end-effectors and 4 corners: normals (N, L, 3), friction (N, L), inf of what is grasped, and which
    corners are in contact (N, L, 4); of corners at one point only the first."""

    normals: Array
    frictions: Array
    in_contact: NDArray[np.bool_]

    def hold(self, forces_W: Array) -> NDArray[np.bool_]:
        """(N,) whether the forces (N, L, 4, 3) lie in their cones."""
        along = np.einsum("kecj,kej->kec", forces_W, self.normals)
        across = np.linalg.norm(forces_W - along[..., None] * self.normals[:, :, None], axis=3)
        limited = self.in_contact & np.isfinite(self.frictions)[:, :, None]
        bound = np.where(limited, self.frictions[:, :, None], 0.0) * along
        inside = (along >= -SLACK_N) & (across <= bound + SLACK_N)
        return np.asarray((inside | ~limited).all(axis=(1, 2)))


def _cones(motion: CertifiedMotion, states: States) -> _Cones:
    scene, shape = motion.plan.scene, states.contacts.shape
    normals, frictions = np.zeros((*shape, 3)), np.zeros(shape)
    for surface in np.unique(states.contacts[states.contacts >= 0]):
        here = states.contacts == surface
        normals[here] = normal_of(scene, int(surface))
        frictions[here] = np.inf if scene.surfaces[surface].grasp else scene.surfaces[surface].friction
    points = motion.corner_points_S
    new = np.ones(points.shape[:2], bool)
    for e, corners in enumerate(points):
        for c in range(1, len(corners)):
            new[e, c] = (np.linalg.norm(corners[:c] - corners[c], axis=1) > 1e-9).all()
    return _Cones(normals, frictions, (states.contacts >= 0)[:, :, None] & new)


def _least(states: States, cones: _Cones, missing_W: Array) -> tuple[Array, Array]:
    """Changes (N, L, 4, 3) of least weighted norm, and what they leave (N, 6), NaN without contacts."""
    count = len(states.times)
    grasp = grasp_of(states.corners_W - states.base_W[:, None, None]).reshape(count, -1, 6, 3)
    pushes = np.maximum(np.einsum("kecj,kej->kec", states.corner_forces_W, cones.normals), 0.0)
    scale = np.maximum(pushes.max(axis=(1, 2)), 1e-9)[:, None, None]
    weights = np.where(cones.in_contact, (pushes / scale) ** 2, 0.0).reshape(count, -1)
    gram = np.einsum("kc,kcij,kclj->kil", weights, grasp, grasp)
    inverse = np.linalg.pinv(gram, rcond=RANK, hermitian=True)
    multipliers = np.einsum("kij,kj->ki", inverse, missing_W)
    changes = weights[:, :, None] * np.einsum("kcij,ki->kcj", grasp, multipliers)
    left = missing_W - np.einsum("kcij,kcj->ki", grasp, changes)
    left[~cones.in_contact.any(axis=(1, 2))] = np.nan
    return changes.reshape(states.corner_forces_W.shape), left


def grasp_of(levers: Array) -> Array:
    """(..., 6, 3) which take forces at levers (..., 3) to the wrenches that they give."""
    x, y, z = np.moveaxis(levers, -1, 0)
    zero, one = np.zeros_like(x), np.ones_like(x)
    rows = [[one, zero, zero], [zero, one, zero], [zero, zero, one], [zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _sum(grasp: Array, forces_W: Array) -> Array:
    """(6,) wrench of all corners' forces."""
    return np.asarray(np.einsum("cij,cj->i", grasp, forces_W.reshape(-1, 3)))


class _Instants:
    """Torques and balance as functions of the corner forces at an instant."""

    def __init__(
        self, motion: CertifiedMotion, robot: CertifiedRobot, states: States, cones: _Cones, missing_W: Array
    ) -> None:
        self._motion, self._robot, self._states, self._cones = motion, robot, states, cones
        self._missing_W = missing_W
        self._data, self._joint_forces = robot.model.createData(), JointForces(robot)

    def grasp(self, k: int) -> Array:
        """(C, 6, 3) of all corners."""
        return grasp_of(self._states.corners_W[k] - self._states.base_W[k]).reshape(-1, 6, 3)

    def wrenches(self, at: Any, forces_W: Array) -> Array:
        """(k, L, 6) in the frames of soles, of forces (k, L, 4, 3) at some instants."""
        forces_S = np.einsum("kerc,kepr->kepc", self._states.rotations_W[at], forces_W)
        moments_S = np.cross(self._motion.corner_points_S, forces_S).sum(axis=2)
        return np.concatenate([forces_S.sum(axis=2), moments_S], axis=2)

    def efforts(self, k: int, wrenches_S: Array) -> Array:
        """(J,) torques under wrenches (L, 6)."""
        import pinocchio as pin  # type: ignore[import-untyped]

        states, robot = self._states, self._robot
        external = self._joint_forces(wrenches_S)
        found = pin.rnea(robot.model, self._data, states.q[k], states.v[k], states.a[k], external)
        return np.asarray(found[robot.moving])

    def use(self, k: int, wrenches_S: Array) -> float:
        """Largest torque over its limit."""
        return float((np.abs(self.efforts(k, wrenches_S)) / self._robot.effort).max(initial=0.0))

    def torques_per_force(self, k: int) -> Array:
        """(J, 3 C) torques that corner forces in the world add [N m/N]: -J' w of the wrench w in the sole's frame."""
        import pinocchio as pin

        model, states = self._robot.model, self._states
        pin.computeJointJacobians(model, self._data, states.q[k])
        pin.updateFramePlacements(model, self._data)
        found = np.zeros((len(self._robot.moving), *states.corner_forces_W[k].shape))
        for e in np.flatnonzero(self._cones.in_contact[k].any(axis=1)):
            frame = self._robot.urdf_model.frames[e]
            jacobian = pin.getFrameJacobian(model, self._data, frame, pin.ReferenceFrame.LOCAL)[:, self._robot.moving]
            wrenches = grasp_of(self._motion.corner_points_S[e]) @ states.rotations_W[k, e].T
            found[:, e] = -np.einsum("ij,cik->jck", jacobian, wrenches)
        return found.reshape(len(found), -1)

    def solve(self, k: int) -> Array:
        """Forces (L, 4, 3) nearest to the shipped ones within cones and torque limits, that balance if any do."""
        from scipy.optimize import nnls

        states, shape = self._states, self._states.corner_forces_W[k].shape
        rays, corners = self._rays(k)  # (3, R) each, and to which corner it belongs
        weight = max(float(np.abs(states.corner_forces_W[k]).sum()), 1.0)
        none = np.zeros(shape)
        apart = self.efforts(k, self.wrenches([k], none[None])[0])
        spread = np.zeros((none.size, len(corners)))
        for i, (ray, corner) in enumerate(zip(rays, corners, strict=True)):
            spread[3 * corner : 3 * corner + 3, i] = ray
        grasp = self.grasp(k)
        on_base = np.einsum("cij,cjr->ir", grasp, spread.reshape(-1, 3, len(corners)))
        per_ray = weight * self.torques_per_force(k) @ spread
        shipped = states.corner_forces_W[k].reshape(-1) / weight
        needed = _sum(grasp, shipped) + self._missing_W[k] / weight
        bounded = np.isfinite(self._robot.effort) & (np.abs(per_ray).max(axis=1, initial=0.0) > 1e-9)
        slope = per_ray[bounded] / self._robot.effort[bounded, None]
        start, size = apart[bounded] / self._robot.effort[bounded], int(bounded.sum())
        slack, nothing = np.eye(size), np.zeros((size, size))
        rows = np.block(
            [
                [BALANCE * on_base, np.zeros((6, 2 * size))],
                [TORQUE * slope, TORQUE * slack, nothing],
                [-TORQUE * slope, nothing, TORQUE * slack],
                [CHANGE * spread, np.zeros((len(spread), 2 * size))],
            ]
        )
        sides = [BALANCE * needed, TORQUE * (1.0 - start), TORQUE * (1.0 + start), CHANGE * shipped]
        found = nnls(rows, np.concatenate(sides))[0][: len(corners)]
        return np.asarray((spread @ found * weight).reshape(shape))

    def _rays(self, k: int) -> tuple[Array, list[int]]:
        """Edges (R, 3) of the pyramids within the cones, and the corner of each."""
        rays: list[Array] = []
        corners: list[int] = []
        angles = 2.0 * np.pi * np.arange(EDGES) / EDGES
        for e, c in np.argwhere(self._cones.in_contact[k]):
            normal, friction = self._cones.normals[k, e], self._cones.frictions[k, e]
            if np.isinf(friction):
                own = np.vstack([np.eye(3), -np.eye(3)])
            else:
                first = np.linalg.svd(normal[None])[2][1:]
                own = normal + friction * np.column_stack([np.cos(angles), np.sin(angles)]) @ first
            rays.append(own)
            corners += [int(4 * e + c)] * len(own)
        return np.vstack(rays), corners
