"""
Planning while the robot walks: what to do with a replan's plan.
"""

from __future__ import annotations
import mcplan._core
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "FeltPush",
    "HEIGHT_MARGIN_M",
    "PushObserver",
    "TURN_MARGIN_RAD_S",
    "com_shift_W",
    "follows",
    "with_feet_kept_up",
    "with_planned_height",
    "with_planned_turn",
]

class FeltPush:
    """
    What pushes a robot to a side, as its controller feels it.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> FeltPush: ...
    def __deepcopy__(self, memo: dict) -> FeltPush: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        acceleration_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        lasted_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def acceleration_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m/s^2] Of the CoM on the level, which the controller's model does not explain.
        """
    @acceleration_W.setter
    def acceleration_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def lasted_s(self) -> float:
        """
        [s] Time for which it has been felt.
        """
    @lasted_s.setter
    def lasted_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PushObserver:
    """
    Feels pushes by the CoM's velocity against what the controller's model promised.
    """
    def __init__(self) -> None: ...
    def update(
        self,
        velocity_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"],
        promised_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] | None,
        dt_s: typing.SupportsFloat | typing.SupportsIndex,
    ) -> FeltPush:
        """
        What is felt at this control step: velocity of the CoM on the level (2,) [m/s], its acceleration since the last call by the model (2,) [m/s^2] or None where contacts were others than the model thought, and the time since the last call [s]. While contacts are others, for 30 ms after it, and where a velocity or acceleration is one that no robot has, or no number, nothing can be said: what was felt is held for a fifth of the time for which it had been felt, 0.3 s at most. Noise makes it slower, and is no push. Raises InvalidInput for a time that is not positive.
        """
    @property
    def push(self) -> FeltPush:
        """
        The FeltPush of the last call, a copy.
        """

def com_shift_W(
    push: FeltPush,
    com_height: typing.SupportsFloat | typing.SupportsIndex,
    gravity: typing.SupportsFloat | typing.SupportsIndex,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    How far beside the measured CoM to plan from while a push is felt, (3,) [m], for a pendulum of a height [m] under gravity [m/s^2]; references of the CoM are as far on the other side of the plan's. Raises InvalidInput.
    """

def follows(report: mcplan._core.Report, period_s: typing.SupportsFloat | typing.SupportsIndex) -> bool:
    """
    Whether it is better to follow the plan of a replan than to stay with the plan under way: it was made from the measured state, and it is solved, acceptable, or keeps all limits for twice the time [s] between two replans.
    """

def with_feet_kept_up(plan: mcplan._core.Plan) -> mcplan._core.Plan:
    """
    The plan with the ways of feet that are in the air at its start kept from the ground, and raised over their splines by 0.5 m/s at most. Raises InvalidPlan.
    """

def with_planned_height(
    measured: mcplan._core.Knot,
    plan: mcplan._core.Plan,
    t: typing.SupportsFloat | typing.SupportsIndex,
    margin_m: typing.SupportsFloat | typing.SupportsIndex = 0.03,
) -> mcplan._core.Knot:
    """
    The state from which to plan on at time t [s] in the plan under way: the measured one, but with height and vertical velocity of the CoM as planned where they are off by less than a margin [m].
    """

def with_planned_turn(
    measured: mcplan._core.Knot,
    plan: mcplan._core.Plan,
    t: typing.SupportsFloat | typing.SupportsIndex,
    margin_rad_s: typing.SupportsFloat | typing.SupportsIndex = 0.3,
) -> mcplan._core.Knot:
    """
    The state from which to plan on at time t [s] in the plan under way: the measured one, but what the base turns otherwise than planned is less by a margin [rad/s], or nothing, and its angular momentum with it.
    """

HEIGHT_MARGIN_M: float = 0.03
TURN_MARGIN_RAD_S: float = 0.3
