"""What is exported: a plan, a motion or a recording, sampled at a rate, with joints where the format has them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, Robot
from mcplan.errors import InvalidInput, shown
from mcplan.kinematics.samples import Samples, sample_at

if TYPE_CHECKING:
    from mcplan import wb
    from mcplan.files.export_formats import Format
    from mcplan.tracking import Recording

    from .motion import Motion

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Source:
    """A plan, and the run or the motion of it if there is one.

    Attributes:
        plan: The plan.
        recording: What the robot did; None: a plan or a motion is exported.
        along: The motion along the plan that is exported, if one is.
        robot: Whose joints are exported, with the plan's end-effectors in the plan's order.
        rate_hz: Samples per second; 0: at the knots of the plan.
        order: Name of the format.
    """

    plan: Plan
    recording: Recording | None
    robot: Robot
    rate_hz: float
    order: str
    along: wb.Motion | None = None

    @staticmethod
    def of(
        what: Plan | wb.Motion | Recording, robot: Robot | str | Path | None, entry: Format, rate_hz: float | None
    ) -> Source:
        """The source of a plan, a motion or a recording.

        Raises:
            InvalidInput: A robot is given with a run or a motion; or the plan is empty.
            InvalidPlan: The plan is malformed.
            InvalidRobot: The robot lacks an end-effector of the plan.
        """
        rate = entry.rate_hz if rate_hz is None else rate_hz
        if entry.planned and not isinstance(what, Plan):
            what = what.plan
        if isinstance(what, Plan):
            if not what.phases:
                raise InvalidInput("what", "must be a plan that has phases", "none")
            what.validate()
            if robot is not None and not entry.joints:
                rule = f"must not be given for {entry.name}, which has no joints: it holds the plan, of its own robot"
                raise InvalidInput("robot", rule, shown(robot.name if isinstance(robot, Robot) else str(robot)))
            from mcplan.tracking.runner import robot_for

            return Source(what, None, robot_for(what, robot), rate, entry.name)
        if robot is not None:
            name = robot.name if isinstance(robot, Robot) else str(robot)
            raise InvalidInput("robot", "must not be given with a run or a motion, which have their own", shown(name))
        from mcplan.wb import Motion as MotionAlong

        if isinstance(what, MotionAlong):
            return Source(what.plan, None, what.model.complete.robot, rate, entry.name, what)
        return Source(what.plan, what, what.simulated_robot, rate, entry.name)

    @cached_property
    def times_s(self) -> Array:
        """Instants [s]: from 0, at the rate, up to the end of the plan or the run."""
        end = float(self.plan.duration()) if self.recording is None else float(np.ptp(self.recording.times_s))
        if self.rate_hz == 0.0:
            knots = np.asarray(self.plan.knot_times(), float)
            return np.minimum(knots[knots <= end + 1e-9], end)
        return np.arange(int(np.floor(end * self.rate_hz + 1e-9)) + 1) / self.rate_hz

    @cached_property
    def samples(self) -> Samples:
        """The plan at these instants; where a run goes on after its end, in its last state."""
        within = np.minimum(self.times_s, self.plan.duration())
        return sample_at(self.plan, self.plan.scene, self.plan.robot, within)

    @cached_property
    def motion(self) -> Motion:
        """Joints at these instants."""
        from .motion import at_knots, motion_along, planned_motion, recorded_motion

        if self.along is not None:
            return motion_along(self.along, self.times_s)
        if self.recording is not None:
            return recorded_motion(self.recording, self.times_s, self.rows)
        if self.rate_hz == 0.0:
            return at_knots(self.robot, self.plan)
        return planned_motion(self.robot, self.samples)

    @cached_property
    def rows(self) -> NDArray[np.int64]:
        """Of a recording: the row of each instant, the one nearest to it."""
        assert self.recording is not None
        step = self.recording.times_s[1] - self.recording.times_s[0] if len(self.recording.times_s) > 1 else 1.0
        found = np.rint(self.times_s / step).astype(np.int64)
        return np.minimum(found, len(self.recording.times_s) - 1)

    @cached_property
    def states(self) -> wb.MotionSamples:
        """Of a motion: its states at these instants."""
        assert self.along is not None
        return self.along.sample(self.times_s)

    @cached_property
    def in_contact(self) -> NDArray[np.bool_]:
        """(n, e): of a run by the simulator's forces, of a plan or a motion as planned."""
        if self.recording is not None:
            return np.asarray(self.recording.contacts[self.rows], bool)
        return self.samples.surfaces >= 0

    @cached_property
    def surfaces(self) -> NDArray[np.int64]:
        """(n, e) surface in contact as planned, -1: free."""
        if self.recording is not None:
            return np.asarray(self.recording.contacts_plan[self.rows], np.int64)
        return self.samples.surfaces

    @cached_property
    def forces_W(self) -> Array:
        """(n, e, 3) contact forces on the robot [N]."""
        if self.recording is not None:
            return np.asarray(self.recording.forces_W[self.rows], float)
        if self.along is not None:
            return self.states.wrenches_W[..., :3]
        return self.samples.forces_W

    @cached_property
    def moments_W(self) -> Array:
        """(n, e, 3) contact moments of a plan or a motion on the robot about the contact points [N m]; a run records none."""
        samples = self.samples
        if self.recording is not None:
            return np.zeros_like(samples.moments_W)
        if self.along is not None:
            return self.states.wrenches_W[..., 3:]
        arms = samples.pressure_W - samples.positions_W
        return np.asarray(samples.moments_W + np.cross(arms, samples.forces_W))

    @cached_property
    def end_effectors_W(self) -> Array:
        """(n, e, 3) contact points [m]."""
        if self.recording is not None:
            return np.asarray(self.recording.end_effectors_W[self.rows], float)
        if self.along is not None:
            return self.states.end_effectors_W
        return self.samples.positions_W

    @property
    def end_effector_names(self) -> list[str]:
        return [end.name for end in self.plan.robot.end_effectors]
