"""Flights: the joints move as the motion says, and the base as its dynamics say, integrated from take-off to landing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .inputs import CertifiedMotion
from .result import MotionViolation, worse
from .robot import CertifiedRobot
from .states import States, states_of
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: Step of the integration [s], at most.
STEP_S = 1e-3


def flights(motion: CertifiedMotion) -> list[tuple[float, float]]:
    """Begin and end of each stretch without any contact [s]."""
    free = (motion.contacts < 0).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(int)))
    return [(float(motion.times_s[i]), float(motion.times_s[j])) for i, j in zip(edges[::2], edges[1::2], strict=True)]


def landings(motion: CertifiedMotion, robot: CertifiedRobot, tolerances: MotionTolerances) -> list[MotionViolation]:
    """How far base and landing feet of the motion are, at the end of each flight, from where exact dynamics take them."""
    off = MotionViolation("landing", 0.0, tolerances.landing_m, "m")
    angle = MotionViolation("landing_angle", 0.0, tolerances.landing_deg, "deg")
    speed = MotionViolation("landing_speed", 0.0, tolerances.landing_speed, "m/s")
    ends = motion.plan.robot.end_effectors
    for start, end in flights(motion):
        position, rotation, velocity_W, planned = _fly(motion, robot, start, end)
        away = MotionViolation("landing", float(np.linalg.norm(position - planned.base_W[-1])), off.limit, "m", end)
        off = worse(off, away)
        was = planned.joint_rotations_W[-1, 1]
        turned = np.degrees(np.linalg.norm(_log(was.T @ rotation)))
        angle = worse(angle, replace(angle, value=float(turned), time_s=end))
        moves = planned.rates[-1, :3]
        speed = worse(speed, replace(speed, value=float(np.linalg.norm(velocity_W - moves)), time_s=end))
        for e in np.flatnonzero(planned.contacts[-1] >= 0):
            lever = was.T @ (planned.positions_W[-1, e] - planned.base_W[-1])
            missed = position + rotation @ lever - planned.positions_W[-1, e]
            value = float(np.linalg.norm(missed))
            off = worse(off, replace(off, value=value, time_s=end, end_effector=ends[e].name))
    return [off, angle, speed]


def _fly(
    motion: CertifiedMotion, robot: CertifiedRobot, start: float, end: float
) -> tuple[Array, Array, Array, States]:
    """Position, rotation and velocity of the base at landing by Runge and Kutta's method of fourth order; what the motion says.

    The rotation advances by the exponential of the step's mean angular velocity in the classical Runge-Kutta-Munthe-Kaas
    form, so that it stays one.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    steps = max(1, int(np.ceil((end - start) / STEP_S)))
    times = np.linspace(start, end, 2 * steps + 1)  # with the middles
    states, data, model = states_of(motion, robot, times), robot.model.createData(), robot.model
    q, v = states.q[0].copy(), states.v[0].copy()
    base = slice(0, 6)

    def slope(k: int, configuration: Array, velocity: Array) -> Array:
        """Acceleration (6,) of the base: M_bb a_b = -h_b, h_b that of the joints' accelerations alone."""
        here_q, here_v, here_a = states.q[k].copy(), states.v[k].copy(), states.a[k].copy()
        here_q[:7], here_v[base], here_a[base] = configuration, velocity, 0.0
        bias = pin.rnea(model, data, here_q, here_v, here_a)[base].copy()
        inertia = pin.crba(model, data, here_q)[base, base]
        inertia = np.triu(inertia) + np.triu(inertia, 1).T
        return np.asarray(np.linalg.solve(inertia, -bias))

    flyer = pin.SE3(pin.Quaternion(q[3:7]), q[:3])
    twist = v[base].copy()
    for i in range(steps):
        k, h = 2 * i, times[2 * i + 2] - times[2 * i]
        # Of the pose the increment u in exp6(u) is integrated, u' = v + [u, v] / 2 + ...: enough for fourth order.
        u, w = np.zeros((4, 6)), np.zeros((4, 6))
        ahead, then = np.zeros(6), twist
        for stage, (at, part) in enumerate(((k, 0.0), (k + 1, 0.5), (k + 1, 0.5), (k + 2, 1.0))):
            if stage:
                ahead, then = part * h * u[stage - 1], twist + part * h * w[stage - 1]
            pose = flyer * pin.exp6(pin.Motion(ahead))
            configuration = np.concatenate([pose.translation, pin.Quaternion(pose.rotation).coeffs()])
            bracket = pin.Motion(ahead).cross(pin.Motion(then)).vector
            u[stage] = then + 0.5 * bracket + pin.Motion(ahead).cross(pin.Motion(bracket)).vector / 12.0
            w[stage] = slope(at, configuration, then)
        mean = np.array([1.0, 2.0, 2.0, 1.0]) / 6.0
        flyer, twist = flyer * pin.exp6(pin.Motion(h * (mean @ u))), twist + h * (mean @ w)
    return flyer.translation.copy(), flyer.rotation.copy(), flyer.rotation @ twist[:3], states


def _log(rotation: Array) -> Array:
    import pinocchio as pin

    return np.asarray(pin.log3(rotation))
