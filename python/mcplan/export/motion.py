"""Joint positions and velocities at the instants of an export: recorded ones, those of a motion, or postures along a plan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, shown
from mcplan.kinematics.inverse_kinematics import follow, has_sole
from mcplan.kinematics.samples import Samples, sample_at
from mcplan.kinematics.smooth_postures import smoothed
from mcplan.kinematics.urdf_model import UrdfModel, load_model

if TYPE_CHECKING:
    from mcplan import wb
    from mcplan._core import Plan, Robot
    from mcplan.tracking import Recording

Array = NDArray[np.float64]

#: [m] by which an end-effector in contact may miss the plan: more is another motion than the one that was planned.
MAX_MISS_M = 0.01
#: Newton steps that put end-effectors in contact where the plan has them, and the error [m, rad] at which they end.
PLACING_STEPS, PLACED = 8, 1e-7
#: Postures that lead from knot to knot lie so far apart, and two so near to each knot [s].
BETWEEN_KNOTS_S, BESIDE_KNOTS_S = 0.02, 0.01
#: Damping of these steps: a stretched leg does not make them infinite.
DAMPING = 1e-9


@dataclass(frozen=True)
class Motion:
    """A motion of a URDF's joints: n instants; Pinocchio's order and conventions.

    Attributes:
        urdf_model: The robot.
        joints: Names of the nj joints, in the order of configurations[:, 7:].
        times_s: (n,).
        configurations: (n, 7 + nj) base position [m], base quaternion xyzw, joints [rad].
        velocities: (n, 6 + nj) base linear and angular in the base's axes [m/s, rad/s], joints [rad/s].
    """

    urdf_model: UrdfModel
    joints: tuple[str, ...]
    times_s: Array
    configurations: Array
    velocities: Array

    @property
    def quat_wxyz(self) -> Array:
        """(n, 4) orientation of the base."""
        return np.asarray(self.configurations[:, [6, 3, 4, 5]])

    def in_order(self, names: list[str]) -> tuple[Array, Array]:
        """Joint positions and velocities (n, nj) in the order of some names."""
        columns = [self.joints.index(name) for name in names]
        return self.configurations[:, 7:][:, columns], self.velocities[:, 6:][:, columns]


def planned_motion(robot: Robot, samples: Samples) -> Motion:
    """Postures along a plan at the instants of its samples.

    Raises:
        InvalidRobot: The robot has no URDF.
        InvalidInput: The robot cannot take up the plan's postures, or has joints that are no angles.
    """
    urdf_model, joints = _model_of(robot)
    configurations = postures(urdf_model, samples)
    velocities = _differences(urdf_model.model, configurations, samples.times_s)
    return Motion(urdf_model, joints, samples.times_s, _without_jumps(configurations), velocities)


def at_knots(robot: Robot, plan: Plan) -> Motion:
    """Postures at the knots of a plan, with velocities from postures just before and just after each.

    Raises:
        InvalidInput: As planned_motion.
    """
    knots, end = np.round(plan.knot_times(), 9), float(plan.duration())
    between = np.arange(0.0, end, BETWEEN_KNOTS_S)
    between = between[np.abs(between[:, None] - knots).min(axis=1) > 2.0 * BESIDE_KNOTS_S]
    beside = np.concatenate([knots - BESIDE_KNOTS_S, knots + BESIDE_KNOTS_S])
    times_s = np.unique(np.round(np.concatenate([between, knots, beside[(beside > 0.0) & (beside < end)]]), 9))
    motion = planned_motion(robot, sample_at(plan, plan.scene, plan.robot, np.minimum(times_s, end)))
    rows = np.searchsorted(times_s, knots)
    return replace(
        motion,
        times_s=motion.times_s[rows],
        configurations=motion.configurations[rows],
        velocities=motion.velocities[rows],
    )


def motion_along(motion: wb.Motion, times_s: Array) -> Motion:
    """A whole-body motion at some instants, the joints that it holds included.

    Raises:
        InvalidInput: The robot has joints that are no angles.
    """
    urdf_model, joints = motion.model.complete, _joints_of(motion.model.complete)
    q, v, _ = motion.trajectory(times_s)
    configurations, velocities = motion.model.complete_configurations(q), motion.model.complete_velocities(v)
    return Motion(urdf_model, joints, times_s, _without_jumps(configurations), velocities)


def recorded_motion(recording: Recording, times_s: Array, rows: NDArray[np.int64]) -> Motion:
    """What a robot did at some instants, of which `rows` are the nearest rows of the recording."""
    urdf_model, joints = _model_of(recording.simulated_robot)
    configurations, velocities = _recorded(recording, times_s, rows, urdf_model.model)
    return Motion(urdf_model, joints, times_s, _without_jumps(configurations), velocities)


def _model_of(robot: Robot) -> tuple[UrdfModel, tuple[str, ...]]:
    urdf_model = load_model(robot)
    return urdf_model, _joints_of(urdf_model)


def _joints_of(urdf_model: UrdfModel) -> tuple[str, ...]:
    if urdf_model.model.nq - urdf_model.model.nv != 1:
        raise InvalidInput("robot", "must have joints of one angle each", shown(urdf_model.robot.name))
    return tuple(list(urdf_model.model.names)[2:])


def _recorded(recording: Recording, times_s: Array, rows: NDArray[np.int64], model: Any) -> tuple[Array, Array]:
    """Rows of a recording, interpolated where an instant lies between two."""
    import pinocchio as pin  # type: ignore[import-untyped]

    columns = [recording.joints.index(name) for name in list(model.names)[2:]]
    q = np.concatenate([recording.configurations[:, :7], recording.configurations[:, 7:][:, columns]], axis=1)
    v = np.concatenate([recording.velocities[:, :6], recording.velocities[:, 6:][:, columns]], axis=1)
    times = recording.times_s - recording.times_s[0]
    configurations, velocities = q[rows].copy(), v[rows].copy()
    for n in np.flatnonzero(np.abs(times[rows] - times_s) > 1e-9):
        k = min(max(int(np.searchsorted(times, times_s[n])) - 1, 0), len(times) - 2)
        fraction = (times_s[n] - times[k]) / (times[k + 1] - times[k])
        configurations[n] = pin.interpolate(model, q[k], q[k + 1], fraction)
        velocities[n] = (1.0 - fraction) * v[k] + fraction * v[k + 1]
    return configurations, velocities


def postures(urdf_model: UrdfModel, samples: Samples) -> Array:
    """Configurations (n, nq) along a plan, without jumps, that have what is in contact where the plan has it.

    Raises:
        InvalidInput: An end-effector in contact is missed by more than MAX_MISS_M.
    """
    found = follow(urdf_model, samples)
    if samples.count > 2:
        found = smoothed(urdf_model, samples, found)
    placed = np.array([_placed(urdf_model, samples, n, q) for n, q in enumerate(found.configurations)])
    misses = np.array([_contact_error(urdf_model, samples, n, q)[0] for n, q in enumerate(placed)])
    worst = int(np.argmax(misses))
    if misses[worst] > MAX_MISS_M:
        raise InvalidInput(
            "what",
            f"must be in reach of {urdf_model.robot.name}",
            f"a contact at {samples.times_s[worst]:.2f} s is missed by {misses[worst]:.3f} m",
        )
    return placed


def _placed(urdf_model: UrdfModel, samples: Samples, n: int, start: Array) -> Array:
    """The posture nearby whose end-effectors in contact lie exactly as planned.

    Steps of least norm, dq = J^T (J J^T)^-1 e: inverse kinematics by weights alone leaves contacts millimetres off, and
    feet that should stand skate by as much.
    """
    import pinocchio as pin

    model = urdf_model.model
    low, high = model.lowerPositionLimit[7:], model.upperPositionLimit[7:]
    q, best = start, start
    least = np.inf
    for _ in range(PLACING_STEPS):
        _, error, jacobian = _contact_error(urdf_model, samples, n, q)
        size = float(np.abs(error).max(initial=0.0))
        if size < least:
            best, least = q, size
        if size < PLACED:
            break
        normal = jacobian @ jacobian.T + DAMPING * np.eye(len(error))
        q = pin.integrate(model, q, jacobian.T @ np.linalg.solve(normal, error))
        q[7:] = np.clip(q[7:], low, high)
    return best


def _contact_error(urdf_model: UrdfModel, samples: Samples, n: int, q: Array) -> tuple[float, Array, Array]:
    """Largest distance [m], errors (m,) and Jacobian (m, nv) of what is in contact, in the world's axes."""
    import pinocchio as pin

    model = urdf_model.model
    data = model.createData()
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    errors, rows, far = [np.zeros(0)], [np.zeros((0, model.nv))], 0.0
    for end, frame in enumerate(urdf_model.frames):
        if samples.surfaces[n, end] < 0:
            continue
        placement = data.oMf[frame]
        jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        off = samples.positions_W[n, end] - placement.translation
        far = max(far, float(np.linalg.norm(off)))
        errors.append(off)
        rows.append(jacobian[:3])
        if has_sole(urdf_model.robot.end_effectors[end]):
            errors.append(pin.log3(samples.rotations_W[n, end] @ placement.rotation.T))
            rows.append(jacobian[3:])
    return far, np.concatenate(errors), np.vstack(rows)


def _differences(model: Any, configurations: Array, times_s: Array) -> Array:
    """Velocities (n, nv): central differences, one-sided at the ends; zero for a single instant."""
    import pinocchio as pin

    count = len(times_s)
    velocities = np.zeros((count, model.nv))
    for n in range(count if count > 1 else 0):
        before, after = max(n - 1, 0), min(n + 1, count - 1)
        # Half a step back and half a step ahead in the axes of the instant itself.
        back = pin.difference(model, configurations[n], configurations[before])
        ahead = pin.difference(model, configurations[n], configurations[after])
        velocities[n] = (ahead - back) / (times_s[after] - times_s[before])
    return velocities


def _without_jumps(configurations: Array) -> Array:
    """The same with quaternions of unit length that do not jump between q and -q."""
    result = configurations.copy()
    result[:, 3:7] /= np.linalg.norm(result[:, 3:7], axis=1, keepdims=True)
    for n in range(1, len(result)):
        if result[n, 3:7] @ result[n - 1, 3:7] < 0.0:
            result[n, 3:7] *= -1.0
    return result
