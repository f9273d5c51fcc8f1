"""A plan integrated from its contacts alone: nothing of it but durations, contacts and the state at each knot is used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput
from mcplan.kinematics.rotations import from_rpy, rotation_vector

if TYPE_CHECKING:
    from mcplan import Plan

Array = NDArray[np.float64]

#: Largest sqrt(stiffness) x step: Runge-Kutta of order 4 then errs by 1e-14 of the motion a step.
_STEP = 0.004


@dataclass(frozen=True)
class Contacts:
    """The contacts of P phases and E end-effectors; free ones have stiffness and moment as the plan says, so that leaks show.

    Without contact wrenches the force acts at its anchor.
    """

    durations_s: Array  # (P,)
    surfaces: NDArray[np.int64]  # (P, E), -1: free
    stiffness: Array  # (P, E) mu [1/s^2]
    anchors_W: Array  # (P, E, 3) s [m], through which the line of force passes
    pressure_W: Array  # (P, E, 3) a [m], where the force acts
    moments_W: Array  # (P, E, 3) tau [N m]


@dataclass(frozen=True)
class Replay:
    """P phases, each integrated from its own first knot, at S instants from its begin to its end."""

    times_s: Array  # (P, S)
    com_W: Array  # (P, S, 3)
    velocity_W: Array  # (P, S, 3)
    momentum_W: Array  # (P, S, 3) angular, about the CoM [kg m^2/s]
    rotation_WB: Array  # (P, S, 3, 3)
    forces_W: Array  # (P, S, E, 3) [N]


@dataclass(frozen=True)
class ReplayErrors:
    """Largest difference between a knot and the integration of the phase before it.

    `orientation_from_start_deg` is that of one integration over the whole plan, with the angular momentum of each phase from its
    own knot. For the CoM there is no such number: an inverted pendulum multiplies any rounding by e every 0.27 s.
    """

    com_m: float
    velocity_m_s: float
    momentum_Nms: float
    orientation_deg: float
    orientation_from_start_deg: float


def contacts(plan: Plan) -> Contacts:
    """The contacts of a plan as arrays.

    Raises:
        InvalidInput: A phase has forces at points.
    """
    for k, phase in enumerate(plan.phases):
        if phase.has_points:
            raise InvalidInput(f"phases[{k}].law", "must have no forces at points", str(phase.law))
    rows = [phase.contacts for phase in plan.phases]
    anchors = np.array([[c.anchor_W for c in row] for row in rows])
    pressure = np.array([[c.center_of_pressure_W for c in row] for row in rows])
    wrenches = np.array([phase.has_wrenches for phase in plan.phases])
    return Contacts(
        durations_s=np.array([phase.duration for phase in plan.phases]),
        surfaces=np.array([[c.surface for c in row] for row in rows]),
        stiffness=np.array([[c.stiffness for c in row] for row in rows]),
        anchors_W=anchors,
        pressure_W=np.where(wrenches[:, None, None], pressure, anchors),
        moments_W=np.array([[c.moment_W for c in row] for row in rows]),
    )


def replay(plan: Plan, sample_s: float = 1e-3) -> Replay:
    """Integrate all phases of a plan, each from its own knot.

        p'' = sum f_l / m - g,   L' = sum ((a_l - p) x f_l + tau_l),   R' = [omega]x R,   omega = R I^-1 R^T L

    with f_l = m mu_l (p - s_l), by Runge-Kutta steps of order 4, all phases side by side.

    Args:
        plan: Without forces at points.
        sample_s: Longest time between samples [s].
    """
    given = contacts(plan)
    mass, gravity = float(plan.robot.mass), np.array([0.0, 0.0, float(plan.scene.gravity)])
    inertia = np.asarray(plan.robot.inertia)
    # An even number of intervals: the rotation of the whole plan takes two at a time.
    intervals = 2 * int(np.ceil(0.5 * given.durations_s.max() / sample_s))
    steps = int(np.ceil(np.sqrt(np.abs(given.stiffness).sum(axis=1).max()) * sample_s / _STEP)) or 1
    h = (given.durations_s / (intervals * steps))[:, None]
    moments = given.moments_W.sum(axis=1)

    def slope(state: Array) -> Array:
        com, velocity, momentum = state[:, 0:3], state[:, 3:6], state[:, 6:9]
        rotation = state[:, 9:].reshape(-1, 3, 3)
        forces = _forces(given, mass, com[:, None])[:, 0]
        out = np.empty_like(state)
        out[:, 0:3] = velocity
        out[:, 3:6] = forces.sum(axis=1) / mass - gravity
        out[:, 6:9] = np.cross(given.pressure_W - com[:, None], forces).sum(axis=1) + moments
        out[:, 9:] = _turning(rotation, momentum, inertia).reshape(-1, 9)
        return out

    states = np.empty((intervals + 1, len(plan.phases), 18))
    states[0] = _knots(plan)[:-1]
    for i in range(intervals):
        state = states[i]
        for _ in range(steps):
            state = _runge_kutta(slope, state, h)
        states[i + 1] = state
    states = states.swapaxes(0, 1)
    starts = np.asarray(plan.knot_times())[:-1, None]
    com = states[..., 0:3]
    return Replay(
        times_s=starts + given.durations_s[:, None] * np.linspace(0.0, 1.0, intervals + 1),
        com_W=com,
        velocity_W=states[..., 3:6],
        momentum_W=states[..., 6:9],
        rotation_WB=states[..., 9:].reshape(*states.shape[:2], 3, 3),
        forces_W=_forces(given, mass, com),
    )


def replay_errors(plan: Plan, replayed: Replay) -> ReplayErrors:
    """Distance of the last state of each phase from the knot that follows it."""
    knots = _knots(plan)
    difference = np.linalg.norm(
        np.stack([replayed.com_W[:, -1], replayed.velocity_W[:, -1], replayed.momentum_W[:, -1]], axis=1)
        - knots[1:, :9].reshape(-1, 3, 3),
        axis=2,
    ).max(axis=0)
    said = knots[:, 9:].reshape(-1, 3, 3)
    return ReplayErrors(
        com_m=float(difference[0]),
        velocity_m_s=float(difference[1]),
        momentum_Nms=float(difference[2]),
        orientation_deg=_largest_angle_deg(replayed.rotation_WB[:, -1], said[1:]),
        orientation_from_start_deg=_largest_angle_deg(_turned_from_start(plan, replayed, said[0]), said[1:]),
    )


def _knots(plan: Plan) -> Array:
    """CoM, velocity, angular momentum and rotation of each knot in a row (N + 1, 18).

    Where the momentum is no state, the base rotates by small angles, I theta'' = sum tau_l: its momentum is I theta'.
    """
    inertia = np.asarray(plan.robot.inertia)
    rows = []
    for k, knot in enumerate(plan.knots):
        has_momentum = plan.phases[min(k, len(plan.phases) - 1)].has_momentum
        momentum = knot.angular_momentum_W if has_momentum else inertia * knot.base_rpy_rate
        rotation = from_rpy(np.asarray(knot.base_rpy)).ravel()
        rows.append(np.concatenate([knot.com_W, knot.com_velocity_W, momentum, rotation]))
    return np.array(rows)


def _forces(given: Contacts, mass: float, com_W: Array) -> Array:
    """f_l = m mu_l (p - s_l), (P, S, E, 3), of CoMs (P, S, 3)."""
    return mass * given.stiffness[:, None, :, None] * (com_W[:, :, None] - given.anchors_W[:, None])


def _turning(rotation: Array, momentum: Array, inertia: Array) -> Array:
    """R' = [omega]x R of rotations (..., 3, 3) and angular momenta (..., 3)."""
    omega = np.einsum("...ij,...j->...i", rotation, np.einsum("...ji,...j->...i", rotation, momentum) / inertia)
    return np.cross(omega[..., None], rotation, axis=-2)


def _runge_kutta(slope: Callable[[Array], Array], state: Array, h: Array) -> Array:
    a = slope(state)
    b = slope(state + 0.5 * h * a)
    c = slope(state + 0.5 * h * b)
    d = slope(state + h * c)
    return state + h / 6.0 * (a + 2.0 * (b + c) + d)


def _turned_from_start(plan: Plan, replayed: Replay, rotation: Array) -> Array:
    """Rotations at the last instants of the phases (P, 3, 3), one after the other from the first; steps of two samples."""
    inertia = np.asarray(plan.robot.inertia)
    out = []
    for times, momentum in zip(replayed.times_s, replayed.momentum_W, strict=True):
        h = times[2] - times[0]
        for i in range(0, len(times) - 2, 2):
            begin, middle, end = momentum[i], momentum[i + 1], momentum[i + 2]
            a = _turning(rotation, begin, inertia)
            b = _turning(rotation + 0.5 * h * a, middle, inertia)
            c = _turning(rotation + 0.5 * h * b, middle, inertia)
            d = _turning(rotation + h * c, end, inertia)
            rotation = rotation + h / 6.0 * (a + 2.0 * (b + c) + d)
        out.append(rotation)
    return np.array(out)


def _largest_angle_deg(a: Array, b: Array) -> float:
    return float(np.rad2deg(max(np.linalg.norm(rotation_vector(x.T @ y)) for x, y in zip(a, b, strict=True))))
