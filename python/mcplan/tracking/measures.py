"""How well a plan was tracked, in numbers."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Measures:
    """Numbers of one run.

    Attributes:
        fell: The base came down, or the simulation broke off.
        completed_s: Time until it fell, or the whole run.
        com_rms_m, com_max_m: Distance of the CoM from the plan's.
        orientation_rms_deg: Angle of the base from the plan's.
        swing_rms_m: Distance of end-effectors in the air from the plan's.
        slip_m: Longest way of an end-effector along its surface during one contact.
        torque_use: Largest torque over its limit.
        assist_force_rms_N, assist_moment_rms_Nm: Wrench of the assistance; 0 without it.
        final_base_error_m: Of the base from where the plan ends, in the ground plane, at the end of the run.
        qp_failures: Control steps in which the quadratic program was not solved.
        simulator_warnings: Of MuJoCo, all kinds together.
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
