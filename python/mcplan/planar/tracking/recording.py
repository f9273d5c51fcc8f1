"""What a planar robot did in a run, sampled, beside what its plan asks for."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.files.whole_body_plans import plan_from_bytes
from mcplan.tracking.run_files import PLANAR_RUN, Arrays, Header, columns_of, load_run

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PlanarRecording:
    """A run of a whole-body plan: n instants, one a control step.

    j joints, e end-effectors in the robot's order, at most p points of an end-effector. Everything is in the plane of the
    planar robot: x forward, y up, angles anti-clockwise, world frame W, SI units. `_plan` says what the plan asks for at
    that instant; from the plan's end on that is its last instant.

    Attributes:
        plan: What was tracked; it carries robot and ground.
        joints: (j) names of the links that the joints move.
        end_effectors: (e) names of the end-effectors.
        times_s: (n,) from 0.
        phases: (n,) phase of the plan.
        base, base_plan: (n, 3) x, y [m], angle [rad].
        base_velocity, base_velocity_plan: (n, 3) [m/s, rad/s].
        q, q_plan: (n, j) [rad].
        velocity, velocity_plan: (n, j) [rad/s].
        torques: (n, j) applied [N m]: feed-forward and feedback, clipped to the limits.
        feedforward: (n, j) the plan's torques [N m].
        feedback: (n, j) torques of the feedback before clipping [N m].
        torque_limits: (j,) [N m].
        points_W: (n, e, p, 2) where the points of the end-effectors are [m]; NaN: there is no such point.
        points_contact_W: (n, e, p, 2) where the plan's contacts put them [m]; NaN: the plan has no contact there.
        forces_W: (n, e, p, 2) contact forces on the robot in the simulation [N]; NaN: there is no such point.
        forces_plan_W: (n, e, p, 2) those of the plan [N], 0 without contact; NaN: there is no such point.
        surfaces_plan: (n, e) surface that the plan's contact is on, -1: free.
        left_plan_at_s: Time at which the robot was no longer where the plan has it; infinite: it always was.
    """

    plan: PlanarPlan
    joints: tuple[str, ...]
    end_effectors: tuple[str, ...]
    times_s: Array
    phases: NDArray[np.int64]
    base: Array
    base_plan: Array
    base_velocity: Array
    base_velocity_plan: Array
    q: Array
    q_plan: Array
    velocity: Array
    velocity_plan: Array
    torques: Array
    feedforward: Array
    feedback: Array
    torque_limits: Array
    points_W: Array
    points_contact_W: Array
    forces_W: Array
    forces_plan_W: Array
    surfaces_plan: NDArray[np.int64]
    left_plan_at_s: float

    @property
    def ends(self) -> tuple[str, ...]:
        """Earlier name of ``end_effectors``, for one release."""
        return self.end_effectors

    @property
    def within_plan(self) -> NDArray[np.bool_]:
        """(n,) instants within the plan's duration: those after it have its last posture."""
        return self.times_s <= self.plan.duration()

    @staticmethod
    def load(path: str | Path) -> PlanarRecording:
        """The recording of a run that ``PlanarResult.save`` or ``mcplan track --save`` wrote.

        Raises:
            InvalidInput: No such file; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        return load_run(path, {PLANAR_RUN: recording_from})


def recording_from(header: Header, arrays: Arrays) -> PlanarRecording:
    """The recording that the file of a run contains."""
    columns = columns_of(PlanarRecording, arrays)
    return PlanarRecording(
        plan=plan_from_bytes(arrays["plan"].tobytes()),
        joints=tuple(header["joints"]),
        end_effectors=tuple(header["ends"]),
        left_plan_at_s=float(header["ended_at_s"]),
        **columns,
    )
