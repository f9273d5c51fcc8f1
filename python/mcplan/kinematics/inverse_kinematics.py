"""Postures of a URDF's model that follow a plan: damped least squares over CoM, base and end-effectors.

Each sample starts from the posture of the one before, so that the motion stays on one branch. Why pink does not do
this: docs/architecture.md, "Libraries that are not used".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .rotations import quat_xyzw

if TYPE_CHECKING:
    from mcplan._core import EndEffector

    from .samples import Samples
    from .urdf_model import UrdfModel

Array = NDArray[np.float64]

# Weights: 1 m of position, 1 rad of rotation.
COM, BASE, CONTACT, SWING, HAND = 10.0, 2.0, 20.0, 10.0, 3.0
SOLE = 3.0
#: Weights of the base, and of soles in the air, in plans with forces at points: they say nothing of how those rotate,
#: and keep the CoM so low that ankles come to their limits.
FREE_BASE, FREE_SOLE = 0.2, 0.2
POSTURE = 0.05
#: Against a given motion: of joints of legs, and of all that the plan leaves open (rotation of the base, torso, arms).
NEAR_LEG, NEAR = 0.3, 2.0
#: Damping of a step, and the minimum for a step that has to be shortened.
DAMPING, MIN_DAMPING = 1e-6, 1e-2
#: Largest change of a joint in one iteration [rad].
STEP = 0.4
#: A joint so near to its limit is at it [rad].
EDGE = 1e-4


@dataclass(frozen=True)
class Postures:
    """Configurations that follow a plan.

    Attributes:
        configurations: (n, nq), Pinocchio's order, free-flyer first.
        residual: Largest distance by which CoM or an end-effector in contact misses the plan [m].
        where: Sample and name of that residual, for messages.
        com_misses: (n,) distance of the CoM from the plan's [m].
        end_misses: (n, e) distances of the end-effectors, free ones too [m].
        tilts: (n, e) angle between a sole and the plan's [rad]; 0 for end-effectors without a sole.
    """

    configurations: Array
    residual: float
    where: str
    com_misses: Array
    end_misses: Array
    tilts: Array

    @staticmethod
    def of(
        urdf_model: UrdfModel,
        samples: Samples,
        configurations: Array,
        com_misses: Array,
        end_misses: Array,
        tilts: Array,
    ) -> Postures:
        """Postures with the largest of the misses that count, and its name."""
        counted = np.column_stack([com_misses, np.where(samples.surfaces >= 0, end_misses, 0.0)])
        at, which = np.unravel_index(np.argmax(counted), counted.shape)
        name = "the CoM" if which == 0 else urdf_model.robot.end_effectors[which - 1].name
        where = f"{name} at {samples.times_s[at]:.2f} s"
        return Postures(configurations, float(counted.max()), where, com_misses, end_misses, tilts)


def follow(
    urdf_model: UrdfModel, samples: Samples, near: Array | None = None, in_time: Callable[[], None] = lambda: None
) -> Postures:
    """Find a posture for every sample, near to the robot's own or to given ones.

    Args:
        urdf_model: The robot's model.
        samples: The plan.
        near: (n, nq) configurations to stay near to in whatever the plan leaves open; None: the robot's posture.
        in_time: Called before each sample; what it raises ends this.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    q = urdf_model.neutral.copy()
    q[3:7] = quat_xyzw(samples.rotation_WB[:1])[0]
    q[:3] += samples.com_W[0] - pin.centerOfMass(urdf_model.model, urdf_model.model.createData(), q)
    solver = _Solver(pin, urdf_model)
    if near is not None:
        solver.posture[3:] = NEAR**2
        solver.posture[_legs(urdf_model)] = NEAR_LEG**2
    configurations, com_misses = [], np.zeros(samples.count)
    shape = (samples.count, len(urdf_model.frames))
    end_misses, tilts = np.zeros(shape), np.zeros(shape)
    for n in range(samples.count):
        in_time()
        if near is not None:
            q = solver.home = near[n]
        q = solver.solve(q, samples, n, iterations=80 if n == 0 else 12)
        configurations.append(q.copy())
        com_misses[n], end_misses[n], tilts[n] = solver.misses(q, samples, n)
    return Postures.of(urdf_model, samples, np.array(configurations), com_misses, end_misses, tilts)


def _legs(urdf_model: UrdfModel) -> list[int]:
    """Indices of velocity of the joints between base and feet."""
    model = urdf_model.model
    feet = [f for end, f in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True) if end.kind == "foot"]
    joints = {joint for frame in feet for joint in model.supports[model.frames[frame].parentJoint]}
    return sorted(model.joints[joint].idx_v for joint in joints if joint > 1)


def has_sole(end: EndEffector) -> bool:
    """Whether an end-effector has a sole, which is rotated to lie flat on the ground."""
    return bool(end.kind == "foot" and np.asarray(end.half_size).all())


class _Solver:
    def __init__(self, pin: Any, urdf_model: UrdfModel) -> None:
        self.pin, self.model, self.data = pin, urdf_model.model, urdf_model.model.createData()
        self.frames, self.home = urdf_model.frames, urdf_model.neutral
        ends = urdf_model.robot.end_effectors  # a copy, which takes longer than a task
        self.soles, self.feet = [has_sole(end) for end in ends], [end.kind == "foot" for end in ends]
        model = urdf_model.model
        self.posture = np.full(model.nv, POSTURE**2)
        self.posture[:6] = 0.0
        low, high = model.lowerPositionLimit.copy(), model.upperPositionLimit.copy()
        low[:7], high[:7] = -np.inf, np.inf
        self.low, self.high = low, high

    def solve(self, q: Array, samples: Samples, n: int, iterations: int) -> Array:
        pin, model = self.pin, self.model
        damping = DAMPING
        error, jacobian, home = self._problem(q, samples, n)
        for _ in range(iterations):
            hessian = jacobian.T @ jacobian + np.diag(self.posture + damping)
            step = self._within_limits(q, hessian, jacobian.T @ error + self.posture * home)
            step *= min(1.0, STEP / max(float(np.abs(step).max()), 1e-12))
            moved = pin.integrate(model, q, step)
            moved[7:] = np.clip(moved[7:], self.low[7:], self.high[7:])
            problem = self._problem(moved, samples, n)
            # Beside a stretched knee the step is far too long.
            if self._cost(problem[0], problem[2]) > self._cost(error, home):
                damping = max(10.0 * damping, MIN_DAMPING)
                continue
            q, (error, jacobian, home), damping = moved, problem, max(0.1 * damping, DAMPING)
            if np.abs(step).max() < 1e-5:
                break
        return np.asarray(q)

    def _problem(self, q: Array, samples: Samples, n: int) -> tuple[Array, Array, Array]:
        """Weighted errors, their Jacobian, and the displacement to the home posture in the tangent space."""
        errors, jacobians = self._tasks(q, samples, n)
        return np.concatenate(errors), np.vstack(jacobians), self.pin.difference(self.model, q, self.home)

    def _cost(self, error: Array, home: Array) -> float:
        return float(error @ error + self.posture @ home**2)

    def _within_limits(self, q: Array, hessian: Array, gradient: Array) -> Array:
        """Newton step in which joints that would leave their range stay, so that the others do the work."""
        free, step = np.ones(self.model.nv, dtype=bool), np.zeros(self.model.nv)
        for _ in range(4):
            if free.all():
                step = np.linalg.solve(hessian, gradient)
            else:
                step[:] = 0.0
                step[free] = np.linalg.solve(hessian[np.ix_(free, free)], gradient[free])
            out = np.zeros_like(free)
            out[6:] = (step[6:] < self.low[7:] - q[7:] + EDGE) & (step[6:] < 0.0) & (q[7:] < self.low[7:] + EDGE)
            out[6:] |= (step[6:] > self.high[7:] - q[7:] - EDGE) & (step[6:] > 0.0) & (q[7:] > self.high[7:] - EDGE)
            if not (out & free).any():
                break
            free &= ~out
        return step

    def misses(self, q: Array, samples: Samples, n: int) -> tuple[float, Array, Array]:
        """Of the CoM, of the end-effectors [m], and the tilts of soles [rad]."""
        pin, data = self.pin, self.data
        pin.framesForwardKinematics(self.model, data, q)
        com = float(np.linalg.norm(samples.com_W[n] - pin.centerOfMass(self.model, data, q)))
        positions, tilts = np.zeros(len(self.frames)), np.zeros(len(self.frames))
        for end, frame in enumerate(self.frames):
            positions[end] = np.linalg.norm(samples.positions_W[n, end] - data.oMf[frame].translation)
            if self.soles[end]:
                tilts[end] = np.linalg.norm(pin.log3(samples.rotations_W[n, end] @ data.oMf[frame].rotation.T))
        return com, positions, tilts

    def _tasks(self, q: Array, samples: Samples, n: int) -> tuple[list[Array], list[Array]]:
        """Weighted errors and Jacobians, in the world's axes."""
        pin, model, data = self.pin, self.model, self.data
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        com_jacobian = pin.jacobianCenterOfMass(model, data, q)
        errors = [COM * (samples.com_W[n] - data.com[0])]
        jacobians = [COM * com_jacobian]
        rotation = pin.log3(samples.rotation_WB[n] @ data.oMi[1].rotation.T)
        base = FREE_BASE if samples.has_points else BASE
        errors.append(base * rotation)
        jacobians.append(base * pin.getJointJacobian(model, data, 1, world)[3:])
        for end, frame in enumerate(self.frames):
            placement = data.oMf[frame]
            jacobian = pin.getFrameJacobian(model, data, frame, world)
            weight = CONTACT if samples.surfaces[n, end] >= 0 else SWING if self.feet[end] else HAND
            errors.append(weight * (samples.positions_W[n, end] - placement.translation))
            jacobians.append(weight * jacobian[:3])
            if self.soles[end]:
                desired = samples.rotations_W[n, end]
                weight = FREE_SOLE if samples.has_points and samples.surfaces[n, end] < 0 else SOLE
                errors.append(weight * pin.log3(desired @ placement.rotation.T))
                jacobians.append(weight * jacobian[3:])
        return errors, jacobians
