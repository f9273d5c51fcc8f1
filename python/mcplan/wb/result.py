"""What a search for a motion comes back with."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .certificate.result import MotionCheckResult
    from .motion import Motion


class MotionStatus(str, Enum):
    """How a search for a motion ended."""

    SOLVED = "solved"  #: converged, and the certificate holds
    TORQUE_INFEASIBLE = "torque_infeasible"  #: converged to a motion that asks a joint for more torque than it has
    SPEED_INFEASIBLE = "speed_infeasible"  #: likewise of speed
    REACH_INFEASIBLE = (
        "reach_infeasible"  #: end-effectors do not reach their footholds, or the ground or links are in the way
    )
    NOT_CERTIFIED = "not_certified"  #: converged, but the certificate found a violation
    NOT_CONVERGED = "not_converged"
    TIME_LIMIT = "time_limit"
    INTERRUPTED = "interrupted"

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True)
class Shortfall:
    """What a robot lacks for a plan, where it lacks most.

    Attributes:
        what: "torque", "speed", "reach", "clearance" or "distance".
        joint: Name of the joint; of clearances the end-effector, of distances the links.
        time_s: When [s].
        factor: What is asked for over what there is.
    """

    what: str
    joint: str
    time_s: float
    factor: float

    def __str__(self) -> str:
        return f"{self.joint} needs {self.factor:.2f} times its {self.what} at {self.time_s:.3f} s"


@dataclass(frozen=True)
class MotionReport:
    """How a motion was searched for; times are wall-clock.

    Attributes:
        status: How the search ended.
        message: Why, in a sentence.
        iterations: Of the interior-point method.
        time_s: From the plan to the motion, without its certificate [s].
        start_s: Of which until the solver began: the model and inverse kinematics [s].
        evaluation_s: Of which in dynamics and kinematics [s].
        linear_solver_s: Of which in factorisations and back-substitutions [s].
        certificate_s: What the certificate took [s].
        cost: Of the motion at its solution.
        shortfall: What the robot lacks; None: nothing that is known.
    """

    status: MotionStatus
    message: str
    iterations: int
    time_s: float
    start_s: float
    evaluation_s: float
    linear_solver_s: float
    certificate_s: float
    cost: float
    shortfall: Shortfall | None = None

    def __str__(self) -> str:
        why = "" if self.status is MotionStatus.SOLVED else f": {self.shortfall or self.message}"
        return f"{self.status} after {self.time_s:.2f} s, {self.iterations} iterations{why}"


@dataclass(frozen=True, eq=False)
class MotionResult:
    """A motion and how it was found.

    Attributes:
        motion: The one that was found, or the best one where none was.
        report: How the search ended.
        certificate: What was found of the motion at a thousand instants a second; None where the search did not converge.
    """

    motion: Motion
    report: MotionReport
    certificate: MotionCheckResult | None = None

    @property
    def status(self) -> MotionStatus:
        """How the search ended."""
        return self.report.status

    @property
    def iterations(self) -> int:
        """Of the interior-point method."""
        return self.report.iterations

    @property
    def shortfall(self) -> Shortfall | None:
        """What the robot lacks for the plan."""
        return self.report.shortfall
