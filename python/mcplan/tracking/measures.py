"""How well a plan was tracked, in numbers."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .recording import Recording

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

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON."""
        return asdict(self)


#: After touch-down a foot settles for this long [s] before slip is measured.
SETTLE_S = 0.02


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
    )


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
