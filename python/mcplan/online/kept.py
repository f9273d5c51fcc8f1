"""What of a run is in its result: all of it, or its end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.tracking.recorder import Acting, Recorder

from .followed import FollowedReferences
from .result import FollowedPlan

if TYPE_CHECKING:
    from mcplan._core import Plan
    from mcplan.kinematics.urdf_model import UrdfModel
    from mcplan.tracking.recording import Recording
    from mcplan.tracking.references import References
    from mcplan.tracking.robot_dynamics import RobotDynamics


class Kept:
    """Recording, references that were followed, and plans.

    There is room for twice as long as is kept: whenever it is full, what is older is dropped. So memory does not grow.

    Args:
        plan: The first plan.
        urdf_model: The robot.
        joints: Names of the joints as torques have them.
        desired: References of the first plan.
        steps: Number of control steps of the run at most.
        keep_s: The last so many seconds are kept; nan: all.

    Attributes:
        plans: Those that were followed while what is kept was recorded.
    """

    def __init__(
        self, plan: Plan, urdf_model: UrdfModel, joints: tuple[str, ...], desired: References, steps: int, keep_s: float
    ) -> None:
        self.dt_s = desired.dt_s
        self.rows = steps if np.isnan(keep_s) else min(steps, 1 + round(keep_s / self.dt_s))
        self.followed = FollowedReferences(min(steps, 2 * self.rows), desired)
        self.recorder = Recorder(plan, urdf_model, joints, self.followed)
        self.plans = [FollowedPlan(plan, 0.0, 0.0)]

    @property
    def from_s(self) -> float:
        """Time of the run at which what is kept begins."""
        return self.recorder.dropped * self.dt_s

    def add(self, references: tuple[References, int], dynamics: RobotDynamics, acting: Acting) -> None:
        """A control step: row k of a window of references, the state, and what acts on the robot."""
        n = self.recorder.count
        if n == self.followed.count:
            self._drop(n - self.rows)
            n = self.recorder.count
        self.followed.add(n, *references)
        self.recorder.add(dynamics, acting)

    def recording(self, fell_at_s: float) -> Recording:
        """What was recorded last."""
        self._drop(max(self.recorder.count - self.rows, 0))
        return self.recorder.finish(fell_at_s)

    def _drop(self, steps: int) -> None:
        """Forget the oldest control steps."""
        if steps == 0:
            return
        self.recorder.drop(steps)
        self.followed.drop(steps)
        old = [n for n, following in enumerate(self.plans[1:]) if following.from_s <= self.from_s]
        del self.plans[: len(old)]
