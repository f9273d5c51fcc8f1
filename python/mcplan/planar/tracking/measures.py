"""How well a whole-body plan was followed, and how near the simulator's contact forces are to the planned ones."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mcplan.tracking.measures import rms

from .recording import Array, PlanarRecording

#: Earlier names of measures, which attributes, JSON and files keep for one release.
EARLIER = {"force_rms_ends": "force_rms_end_effectors", "torque_feedback_share": "torque_feedback_ratio"}


@dataclass(frozen=True)
class PlanarMeasures:
    """Numbers of one run. Forces, joints and torques are those within the plan's duration.

    Attributes:
        completed: Whether the robot was where the plan has it to the end of the run.
        completed_s: Until when it was.
        force_rms: Rms over time of the contact forces' error over the rms of the planned ones, all end-effectors together.
        force_rms_end_effectors: The same of each end-effector alone, by name; those without planned forces are left out.
        force_rms_robot: The same of the sum of all contact forces, which balance alone determines.
        drift_m: Largest distance of a point from where the plan's contact puts it, while the plan has it in contact.
        slip_m: Largest displacement of a point along its surface while the plan has it in contact.
        joint_rms_rad: Distance of joints from the plan's.
        base_rms_m: Distance of the base from the plan's.
        torque_feedback_ratio: Ratio of the rms of the feedback's torques to that of the feed-forward ones.
        torque_use: Largest applied torque over its limit.
        early_contact_N_s: Impulse of contact forces at end-effectors that the plan has in the air.
        simulator_warnings: Number of warnings of MuJoCo, all kinds together.
        realtime_factor: Simulated time over wall clock.
        velocity_use: Largest speed of a joint over the robot's limit; NaN in files of earlier versions.
    """

    completed: bool
    completed_s: float
    force_rms: float
    force_rms_end_effectors: dict[str, float]
    force_rms_robot: float
    drift_m: float
    slip_m: float
    joint_rms_rad: float
    base_rms_m: float
    torque_feedback_ratio: float
    torque_use: float
    early_contact_N_s: float
    simulator_warnings: int
    realtime_factor: float
    velocity_use: float = float("nan")

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON; those with an earlier name under both."""
        data = asdict(self)
        return data | {earlier: data[name] for earlier, name in EARLIER.items()}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> PlanarMeasures:
        """Those of as_dict(), or of a file with the earlier names."""
        return cls(**{EARLIER.get(name, name): value for name, value in data.items()})

    @property
    def force_rms_ends(self) -> dict[str, float]:
        """Earlier name of ``force_rms_end_effectors``, for one release."""
        return self.force_rms_end_effectors

    @property
    def torque_feedback_share(self) -> float:
        """Earlier name of ``torque_feedback_ratio``, for one release."""
        return self.torque_feedback_ratio


def measure(recording: PlanarRecording, simulator_warnings: int, wall_clock_s: float) -> PlanarMeasures:
    """Numbers of a recording.

    Args:
        recording: A recording of at least one instant.
        simulator_warnings: Counted by the simulation.
        wall_clock_s: Wall clock of the run.
    """
    r = recording
    n = r.within_plan
    # An end-effector's force is the sum over its points: how friction is distributed to them is not determined by
    # motion and torques.
    # torques.
    forces = np.nansum(r.forces_W[n], axis=2)
    forces_plan = np.nansum(r.forces_plan_W[n], axis=2)
    off = r.points_W - r.points_contact_W
    left = r.left_plan_at_s
    step = np.diff(r.times_s, append=r.times_s[-1])[n]
    air = np.linalg.norm(forces, axis=-1) * (r.surfaces_plan[n] < 0)
    return PlanarMeasures(
        completed=bool(np.isinf(left)),
        completed_s=float(min(left, r.times_s[-1])),
        force_rms=_relative(forces - forces_plan, forces_plan),
        force_rms_end_effectors={
            name: _relative(forces[:, e] - forces_plan[:, e], forces_plan[:, e])
            for e, name in enumerate(r.end_effectors)
            if forces_plan[:, e].any()
        },
        force_rms_robot=_relative(forces.sum(axis=1) - forces_plan.sum(axis=1), forces_plan.sum(axis=1)),
        drift_m=_largest(np.linalg.norm(off, axis=-1)),
        slip_m=_slip(r),
        joint_rms_rad=rms(r.q[n] - r.q_plan[n]),
        base_rms_m=rms(np.linalg.norm(r.base[n, :2] - r.base_plan[n, :2], axis=1)),
        torque_feedback_ratio=_relative(r.feedback[n], r.feedforward[n]),
        torque_use=float((np.abs(r.torques) / r.torque_limits).max()),
        early_contact_N_s=float((air * step[:, None]).sum()),
        simulator_warnings=simulator_warnings,
        realtime_factor=float(r.times_s[-1] / wall_clock_s),
        velocity_use=float(velocity_uses(r)[n].max()),
    )


def velocity_uses(r: PlanarRecording) -> Array:
    """(n, j) speeds of joints over their limits."""
    limits = np.array([body.velocity_max for body in r.plan.task.robot.bodies[1:]])
    return np.asarray(np.abs(r.velocity) / limits)


def nearest_to_velocity_limit(r: PlanarRecording) -> tuple[str, float]:
    """The joint whose speed came nearest to its limit, or went farthest beyond it, within the plan, and when [s]."""
    use = velocity_uses(r)[r.within_plan]
    n, joint = np.unravel_index(int(np.argmax(use)), use.shape)
    return r.joints[joint], float(r.times_s[n])


def _relative(error: Array, reference: Array) -> float:
    """Rms of an error over the rms of what it is an error of; infinite: that is zero throughout."""
    size = rms(reference)
    return rms(error) / size if size > 0 else float("inf")


def _largest(values: Array) -> float:
    """Largest of those that are numbers, 0 if none is."""
    return float(np.nanmax(values, initial=0.0))


def _slip(r: PlanarRecording) -> float:
    """Largest displacement of a point along its surface during one contact of the plan."""
    longest = 0.0
    for e in range(len(r.end_effectors)):
        on = r.surfaces_plan[:, e]
        for first, last in _stretches(on):
            tangent = r.plan.task.surfaces[int(on[first])].tangent_W
            along = r.points_W[first:last, e] @ tangent
            longest = max(longest, _largest(np.abs(along - along[0])))
    return longest


def _stretches(on: np.ndarray) -> list[tuple[int, int]]:
    """First and one past the last index of each stretch of equal values that are not negative."""
    edges = np.flatnonzero(np.diff(on)) + 1
    bounds = [0, *edges.tolist(), len(on)]
    return [(a, b) for a, b in zip(bounds[:-1], bounds[1:], strict=True) if on[a] >= 0]
