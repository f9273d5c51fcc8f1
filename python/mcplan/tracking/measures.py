"""How well a plan was tracked, in numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .recording import Recording
from .touches import Touch

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Measures:
    """Numbers of one run.

    Attributes:
        fell: Whether the base came down, or the simulation broke off.
        completed_s: Time until it fell, or the whole run.
        com_rms_m, com_max_m: Distance of the CoM from the plan's.
        orientation_rms_deg: Angle of the base from the plan's.
        swing_rms_m: Distance of end-effectors in the air from the plan's.
        slip_m: Largest displacement of an end-effector along its surface during one contact.
        torque_use: Largest torque over its limit.
        assist_force_rms_N, assist_moment_rms_Nm: Wrench of the assistance; 0 without it.
        final_base_error_m: Distance of the base from where the plan ends, in the ground plane, at the end of the run.
        qp_failures: Control steps in which the quadratic program was not solved.
        simulator_warnings: Number of warnings of MuJoCo, all kinds together.
        realtime_factor: Simulated time over wall clock, control included.
        control_ms: Mean wall clock of a control step.
        velocity_use: Largest speed of a joint over its limit; NaN: the URDF has no such limits, or the file has none.
        torque_step_use: Largest change of a torque within 2 ms over its limit.
        torque_limit_ratio: Fraction of control steps in which a joint has 99.9 % of its torque limit or more.
        leg_torque_limit_ratio: The same of joints that move one foot and no other end-effector.
        self_contacts: Number of contacts of links with each other; None: they pass through each other.
        self_contact_N, self_contact_m: Largest force between them, and largest depth to which their shapes overlapped.
        terrain_contacts: Number of contacts of links other than end-effectors with the terrain; None as above.
        terrain_contact_N: Largest force there.
    """

    fell: bool
    completed_s: float
    com_rms_m: float
    com_max_m: float
    orientation_rms_deg: float
    swing_rms_m: float
    slip_m: float
    torque_use: float
    assist_force_rms_N: float
    assist_moment_rms_Nm: float
    final_base_error_m: float
    qp_failures: int
    simulator_warnings: int
    realtime_factor: float
    control_ms: float
    velocity_use: float = float("nan")
    torque_step_use: float = float("nan")
    torque_limit_ratio: float = float("nan")
    leg_torque_limit_ratio: float = float("nan")
    self_contacts: int | None = None
    self_contact_N: float | None = None
    self_contact_m: float | None = None
    terrain_contacts: int | None = None
    terrain_contact_N: float | None = None

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON."""
        return asdict(self)


#: A torque of this ratio to its limit is at it.
AT_LIMIT = 0.999
#: After touch-down a foot settles for this long [s] before slip is measured.
SETTLE_S = 0.02
#: Time within which a torque changes by less than its limit [s], or the change is reported.
TORQUE_STEP_S = 0.002


def measure(recording: Recording, final_configuration: Array) -> Measures:
    """Measures of a recording; those of the run's cost (failures, warnings, times) are left at zero.

    Args:
        recording: What the robot did.
        final_configuration: (nq,) where the plan ends.
    """
    r = recording
    fell = bool(np.isfinite(r.fell_at_s))
    com_error = np.linalg.norm(r.com_W - r.com_plan_W, axis=1)
    final = r.configurations[-1, :2] - final_configuration[:2]
    return Measures(
        fell=fell,
        completed_s=float(r.times_s[-1]),
        com_rms_m=rms(com_error),
        com_max_m=float(com_error.max()),
        orientation_rms_deg=float(np.degrees(rms(_angles(r.configurations[:, 3:7], r.base_quat_xyzw_plan)))),
        swing_rms_m=rms(np.linalg.norm(r.end_effectors_W - r.end_effectors_plan_W, axis=2)[swinging(r.contacts_plan)]),
        slip_m=_slip(r),
        # A joint whose URDF gives it no effort has no motor to use.
        torque_use=float((np.abs(r.torques) / np.where(r.torque_limits > 0.0, r.torque_limits, np.inf)).max()),
        assist_force_rms_N=rms(np.linalg.norm(r.assist[:, :3], axis=1)),
        assist_moment_rms_Nm=rms(np.linalg.norm(r.assist[:, 3:], axis=1)),
        final_base_error_m=float(np.linalg.norm(final)),
        qp_failures=0,
        simulator_warnings=0,
        realtime_factor=0.0,
        control_ms=0.0,
        velocity_use=float(velocity_uses(r).max(initial=np.nan if not r.velocity_limits.any() else 0.0)),
        torque_step_use=float(torque_step_uses(r).max(initial=0.0)),
        torque_limit_ratio=float(at_torque_limit(r).any(axis=1).mean()),
    )


def with_touches(measures: Measures, touches: Sequence[Touch]) -> Measures:
    """The measures with those of contacts that were not planned, for robots whose links make contact."""
    own, on_terrain = ([touch for touch in touches if touch.terrain == terrain] for terrain in (False, True))
    return replace(
        measures,
        self_contacts=len(own),
        self_contact_N=max((touch.force_N for touch in own), default=0.0),
        self_contact_m=max((touch.depth_m for touch in own), default=0.0),
        terrain_contacts=len(on_terrain),
        terrain_contact_N=max((touch.force_N for touch in on_terrain), default=0.0),
    )


def at_torque_limit(r: Recording) -> NDArray[np.bool_]:
    """(n, nj) whether a torque is at its limit; joints without effort in the URDF have no motor."""
    return (np.abs(r.torques) >= AT_LIMIT * r.torque_limits) & (r.torque_limits > 0.0)


def velocity_uses(r: Recording) -> Array:
    """(n, nj) speeds of joints over their limits; 0 where the URDF has none."""
    if not len(r.velocity_limits):
        return np.zeros(r.torques.shape)
    return np.abs(r.velocities[:, 6:]) / np.where(r.velocity_limits > 0.0, r.velocity_limits, np.inf)


def torque_step_uses(r: Recording) -> Array:
    """(n, nj) changes of torques within TORQUE_STEP_S before an instant, over their limits."""
    changes = np.zeros(r.torques.shape)
    if len(r.times_s) > 1:
        back = max(1, round(TORQUE_STEP_S / (r.times_s[1] - r.times_s[0])))
        changes[back:] = np.abs(r.torques[back:] - r.torques[:-back])
    return changes / np.where(r.torque_limits > 0.0, r.torque_limits, np.inf)


def swinging(contacts_plan: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(n, e) whether an end-effector is free now and in contact later."""
    later = np.flip(np.logical_or.accumulate(np.flip(contacts_plan >= 0, axis=0), axis=0), axis=0)
    return (contacts_plan < 0) & later


def rms(values: Array) -> float:
    """Root of the mean square; 0 of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values.size else 0.0


def _angles(a_xyzw: Array, b_xyzw: Array) -> Array:
    """Angles between rotations [rad]."""
    return np.asarray(2.0 * np.arccos(np.clip(np.abs(np.sum(a_xyzw * b_xyzw, axis=1)), 0.0, 1.0)))


def _slip(r: Recording) -> float:
    normals = [polygon_normal(np.asarray(s.vertices_W)) for s in r.plan.scene.surfaces]
    settle = round(SETTLE_S / (r.times_s[1] - r.times_s[0])) if len(r.times_s) > 1 else 0
    worst = 0.0
    for end in range(r.contacts.shape[1]):
        surfaces = np.where(r.contacts[:, end], r.contacts_plan[:, end], -1)
        for run in np.split(np.arange(len(surfaces)), np.flatnonzero(np.diff(surfaces)) + 1):
            if surfaces[run[0]] < 0 or len(run) <= settle + 1:
                continue
            displacement = r.end_effectors_W[run[settle:], end] - r.end_effectors_W[run[settle], end]
            displacement = displacement - np.outer(displacement @ normals[surfaces[run[0]]], normals[surfaces[run[0]]])
            worst = max(worst, float(np.linalg.norm(displacement, axis=1).max()))
    return worst
