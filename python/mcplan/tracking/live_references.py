"""References of plans that follow each other while a robot walks: sampled some way ahead, without jumps at a swap."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, shown
from mcplan.kinematics.rotations import about_z, from_rpy, rotation_vector
from mcplan.kinematics.samples import Interval, contact_intervals

from .options import Gains
from .references import LARGEST_SWING_ACCELERATION, References, angular_velocity, standing_forces

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot
    from mcplan.samples import PlanSamples

Array = NDArray[np.float64]

#: Duration of a window [s]: sampling it is what a swap costs.
WINDOW_S = 0.5


@dataclass(frozen=True)
class Lifted:
    """Where a free end-effector left the ground: time on the controller's clock [s], frame of its sole (3, 3)."""

    time_s: float
    rotation_W: Array


class LiveReferences:
    """Desired motion and forces at control steps 0, 1, ... of whatever plan is under way.

    Args:
        plan: The plan; None: `whole` is all there is.
        robot: The robot whose mass scales the plan's forces and angular momentum.
        dt_s: Control step [s].
        t0: Time of the controller's clock at which the plan begins [s].
        com_shift_W: (3,) by which the plan's CoM is beside the one to be followed [m]; None: it is not.

    Attributes:
        lifted: By end-effector that was free when the plan was taken over.

    Raises:
        InvalidInput: The shift is none.
    """

    def __init__(
        self, plan: Plan | None, robot: Robot | None, dt_s: float, t0: float, com_shift_W: Array | None = None
    ) -> None:
        self.plan, self.robot, self.dt_s, self.t0 = plan, robot, dt_s, t0
        self._com_shift_W = _shift(com_shift_W)
        self.lifted: dict[int, Lifted] = {}
        self._first = 0
        self._window: References | None = None
        self._intervals: list[list[Interval]] = []
        self._blend: _Blend | None = None
        if plan is not None and robot is not None:
            intervals = contact_intervals(plan, plan.scene, plan.robot)
            ends = range(len(plan.robot.end_effectors))
            self._intervals = [[i for i in intervals if i.end_effector == end] for end in ends]
            self._standing_W = standing_forces(plan, robot)
            self._wrenches = all(phase.has_wrenches for phase in plan.phases)
            self._yaws = all(len(knot.end_effector_yaw) == len(ends) for knot in plan.knots)

    @classmethod
    def of(cls, whole: References) -> LiveReferences:
        """Those of a plan that is sampled as a whole; after its last step the last one is kept."""
        live = cls(None, None, whole.dt_s, 0.0)
        live._window = whole
        return live

    def taken_over(self, before: LiveReferences, step: int, gains: Gains) -> LiveReferences:
        """These, followed from a control step on instead of those before, without a jump."""
        self.lifted = before.lifted_at(step)
        old, k = before.window(step)
        new, j = self.window(step)
        self._blend = _Blend.between(step, old, k, new, j, gains)
        self._window = self._blend.applied(new, self._first)
        return self

    def window(self, step: int) -> tuple[References, int]:
        """References that contain a control step, and its index there."""
        if self.plan is None:
            whole = self._window
            assert whole is not None
            return whole, min(step, whole.count - 1)
        if self._window is None or not 0 <= step - self._first < self._window.count:
            self._first = step
            self._window = self._sampled(step, round(WINDOW_S / self.dt_s))
            if self._blend is not None:
                self._window = self._blend.applied(self._window, step)
        return self._window, step - self._first

    def lifted_at(self, step: int) -> dict[int, Lifted]:
        """Where each end-effector that is free at a control step left the ground, as far as it is known."""
        window, k = self.window(step)
        now_s, found = step * self.dt_s, {}
        for end in np.flatnonzero(window.surfaces[k] < 0):
            if self.plan is None:
                down = np.flatnonzero(window.surfaces[: k + 1, end] >= 0)
                if len(down):
                    found[int(end)] = Lifted(int(down[-1]) * self.dt_s, window.soles_W[down[-1], end])
                continue
            before = [i for i in self._intervals[end] if i.end_s <= now_s - self.t0]
            if before:
                found[int(end)] = Lifted(before[-1].end_s + self.t0, before[-1].rotation_W)
            elif int(end) in self.lifted:
                found[int(end)] = self.lifted[int(end)]
        return found

    def _sampled(self, step: int, count: int) -> References:
        """References of `count` control steps; a neighbour on either side for differences is cut off again."""
        plan, robot, dt = self.plan, self.robot, self.dt_s
        assert plan is not None and robot is not None
        duration = float(plan.duration())
        ahead = np.arange(step, step + count + 1) * dt - self.t0
        lead = 1 if ahead[0] >= dt else 0
        clock = np.concatenate([[ahead[0] - dt], ahead]) if lead else ahead
        times = np.clip(clock, 0.0, duration)
        over = clock > duration
        found: PlanSamples = plan.sample(times)  # type: ignore[attr-defined]
        surfaces = found.surfaces.astype(np.int64)
        surfaces[over] = list(plan.final_contacts)
        still = np.where(over, 0.0, 1.0)
        scale = robot.mass / plan.robot.mass
        forces, moments = found.forces_W * scale, found.moments_W * scale
        pressure = found.end_effectors_W
        if self._wrenches:
            pressure = found.centers_of_pressure_W
            moments = moments - np.cross(pressure - found.end_effectors_W, forces)
        momentum = found.angular_momentum_W * scale * still[:, None]
        arms = pressure - found.com_W[:, None]
        rate = (np.cross(arms, forces) + moments).sum(axis=1) if self._wrenches else np.gradient(momentum, dt, axis=0)
        rate *= still[:, None]
        forces[over], moments[over] = self._standing_W, 0.0
        velocities = found.end_effector_velocities_W * still[:, None, None]
        acceleration = np.gradient(velocities, dt, axis=0)
        size = np.linalg.norm(acceleration, axis=2, keepdims=True)
        acceleration *= np.minimum(1.0, LARGEST_SWING_ACCELERATION / np.maximum(size, 1e-9))
        acceleration[surfaces >= 0] = 0.0
        base_WB = from_rpy(found.base_rpy)
        soles_W, fraction, returns, following = self._soles(found, surfaces, base_WB)
        kept = slice(lead, lead + count)
        return References(
            dt_s=dt,
            duration_s=duration,
            com_W=found.com_W[kept] - self._com_shift_W,
            com_velocity_W=(found.com_velocity_W * still[:, None])[kept],
            com_acceleration_W=(found.com_acceleration_W * still[:, None])[kept],
            momentum_W=momentum[kept],
            momentum_rate_W=rate[kept],
            base_WB=base_WB[kept],
            base_velocity_W=angular_velocity(base_WB, dt)[kept],
            end_effectors_W=found.end_effectors_W[kept],
            end_effector_velocities_W=velocities[kept],
            end_effector_accelerations_W=acceleration[kept],
            soles_W=soles_W[kept],
            sole_velocities_W=angular_velocity(soles_W, dt)[kept],
            forces_W=forces[kept],
            pressure_W=pressure[kept],
            moments_W=moments[kept],
            surfaces=surfaces[kept],
            swing_fraction=fraction[kept],
            returns=returns[kept],
            next_surfaces=following[kept],
        )

    def _soles(
        self, found: PlanSamples, surfaces: NDArray[np.int64], base_WB: Array
    ) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.int64]]:
        """Soles' directions, fractions of swings, whether they end, and the surface of this or the next contact.

        A sole in the air turns from how it stood to how it will, as kinematics.samples has it for whole plans; how it
        stood under the plan before is remembered.
        """
        soles_W = np.repeat(base_WB[:, None], surfaces.shape[1], axis=1)
        fraction, returns = np.ones(surfaces.shape), np.zeros(surfaces.shape, dtype=bool)
        following = surfaces.copy()
        for end, own in enumerate(self._intervals):
            lifted = self.lifted.get(end)
            known: list[tuple[float, Array]] = (
                [(lifted.time_s - self.t0, lifted.rotation_W)] if lifted is not None else []
            )
            known += [(i.end_s, i.rotation_W) for i in own]
            if not own:
                continue
            t = found.times
            for interval in own:
                inside = (interval.start_s <= t) & (t <= interval.end_s)
                soles_W[inside, end] = interval.rotation_W
            for n_gap in range(len(own) + 1):
                begin = own[n_gap - 1].end_s if n_gap else -np.inf
                until = own[n_gap].start_s if n_gap < len(own) else np.inf
                free = (surfaces[:, end] < 0) & (t >= begin) & (t < until)
                if not free.any():
                    continue
                before = [at for at in known if at[0] <= begin + 1e-12] if n_gap else known[:1]
                before = before if n_gap or lifted is not None else []
                since = before[-1][0] if before else 0.0
                after = own[n_gap] if n_gap < len(own) else None
                lands = after.start_s if after else found.times[-1]
                share = np.clip((t[free] - since) / max(lands - since, 1e-9), 0.0, 1.0)
                fraction[free, end], returns[free, end] = share, after is not None
                following[free, end] = after.surface if after else -1
                start = before[-1][1] if before else base_WB[free][0]
                goal = after.rotation_W if after else base_WB[free][-1]
                # A plan turns what is in the air from rest; made anew all the time, that would land ahead of its goal.
                goes_on = lifted is not None and not n_gap
                yaws = found.end_effector_yaw[free, end] if self._yaws and not goes_on else None
                soles_W[free, end] = _turning(start, goal, share * share * (3.0 - 2.0 * share), yaws)
        return soles_W, fraction, returns, following


def _shift(com_shift_W: Array | None) -> Array:
    """(3,) as given [m]."""
    if com_shift_W is None:
        return np.zeros(3)
    try:
        found = np.asarray(com_shift_W, float)
    except (TypeError, ValueError):
        found = np.empty(0)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise InvalidInput("com_shift_W", "must be three finite numbers", shown(com_shift_W))
    return found


def _turning(start: Array, goal: Array, fraction: Array, yaws: Array | None) -> Array:
    """(n, 3, 3) frames at fractions of the way from one to the other, headed as `yaws` says [rad]."""
    if yaws is not None:
        start, goal = (about_z(np.array(-np.arctan2(r[1, 0], r[0, 0]))) @ r for r in (start, goal))
    vector = rotation_vector(start.T @ goal)
    way = start @ _rotations(fraction[:, None] * vector)
    return way if yaws is None else about_z(yaws) @ way


def _rotations(vectors: Array) -> Array:
    """Rotations (n, 3, 3) of rotation vectors (n, 3) [rad], by Rodrigues' formula."""
    angles = np.linalg.norm(vectors, axis=1)
    axes = vectors / np.maximum(angles, 1e-12)[:, None]
    x, y, z = axes.T
    zero = np.zeros_like(x)
    skew = np.stack([np.stack(r, axis=-1) for r in ((zero, -z, y), (z, zero, -x), (-y, x, zero))], axis=-2)
    sine, versine = np.sin(angles)[:, None, None], (1.0 - np.cos(angles))[:, None, None]
    return np.eye(3) + sine * skew + versine * (skew @ skew)


@dataclass(frozen=True)
class _Decay:
    """x(t) = (d + (v + w d) t) exp(-w t): from d with rate v to nothing, critically damped."""

    d: Array
    v: Array
    w: Array

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """Value, rate and acceleration at times (n,), each (n, ...)."""
        t = t.reshape(-1, *([1] * self.d.ndim))
        slope = self.v + self.w * self.d
        damp = np.exp(-self.w * t)
        value = (self.d + slope * t) * damp
        rate = (self.v - self.w * slope * t) * damp
        return value, rate, -self.w * (2.0 * rate + self.w * value)


@dataclass(frozen=True)
class _Blend:
    """What the references before a swap have more than those after it, and how it decays."""

    step: int
    com: _Decay
    base: _Decay
    ends: _Decay
    soles: _Decay

    @classmethod
    def between(cls, step: int, old: References, k: int, new: References, j: int, gains: Gains) -> _Blend:
        free = ((old.surfaces[k] < 0) & (new.surfaces[j] < 0))[:, None]

        def decay(d: Array, v: Array, kp: object) -> _Decay:
            return _Decay(d, v, np.sqrt(np.asarray(kp, float)))

        turned = np.array([rotation_vector(a @ b.T) for a, b in zip(old.soles_W[k], new.soles_W[j], strict=True)])
        return cls(
            step,
            decay(old.com_W[k] - new.com_W[j], old.com_velocity_W[k] - new.com_velocity_W[j], gains.com_kp),
            decay(
                rotation_vector(old.base_WB[k] @ new.base_WB[j].T),
                old.base_velocity_W[k] - new.base_velocity_W[j],
                gains.base_kp,
            ),
            decay(
                free * (old.end_effectors_W[k] - new.end_effectors_W[j]),
                free * (old.end_effector_velocities_W[k] - new.end_effector_velocities_W[j]),
                gains.swing_kp,
            ),
            decay(free * turned, free * (old.sole_velocities_W[k] - new.sole_velocities_W[j]), gains.swing_kp),
        )

    def applied(self, window: References, first: int) -> References:
        """A window of the new references, which begins at a control step, with what is left of the old ones."""
        t = np.asarray((first - self.step + np.arange(window.count)) * window.dt_s, float)
        com, com_rate, com_acceleration = self.com.at(t)
        base, base_rate, _ = self.base.at(t)
        ends, end_rate, end_acceleration = self.ends.at(t)
        soles, sole_rate, _ = self.soles.at(t)
        shape = soles.shape
        return replace(
            window,
            com_W=window.com_W + com,
            com_velocity_W=window.com_velocity_W + com_rate,
            com_acceleration_W=window.com_acceleration_W + com_acceleration,
            base_WB=_rotations(base) @ window.base_WB,
            base_velocity_W=window.base_velocity_W + base_rate,
            end_effectors_W=window.end_effectors_W + ends,
            end_effector_velocities_W=window.end_effector_velocities_W + end_rate,
            end_effector_accelerations_W=window.end_effector_accelerations_W + end_acceleration,
            soles_W=_rotations(soles.reshape(-1, 3)).reshape(*shape[:2], 3, 3) @ window.soles_W,
            sole_velocities_W=window.sole_velocities_W + sole_rate,
        )
