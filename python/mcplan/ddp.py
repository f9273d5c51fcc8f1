"""The contact-sequence search: options, a solve, a result that has the plan and a report.

    from mcplan import ddp

    options = ddp.Options(phases=24, weights=ddp.Weights(flight=2.0))
    result = ddp.plan("stairs", "humanoid44", options)  # or ddp.plan("stairs", phases=24)
    result.plan.save("plan.npz"), result.report.status

``SwitchedDdp`` is the planner behind it, one object for several solves.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan._core import Knot, Plan, Robot, Scene
from mcplan._core import PlanResult as Result
from mcplan._core.ddp import Method, Model, Options, Polish, StiffnessInput, SwitchedDdp, Weights

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from mcplan.option_types import DdpOptions

__all__ = [
    "Method",
    "Model",
    "Options",
    "Polish",
    "Result",
    "StiffnessInput",
    "SwitchedDdp",
    "Weights",
    "plan",
    "replan",
]


def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path = "humanoid44",
    options: Options | None = None,
    *,
    warm_start: Plan | None = None,
    **named: Unpack[DdpOptions],
) -> Result:
    """Find a contact sequence and a motion from the scene's start to its goal.

    Ctrl-C ends the search with Interrupted, which carries the result with the best plan so far.

    Args:
        scene: A scene, or what load_scene takes.
        robot: A robot, or what load_robot takes.
        options: How to search; None: the defaults.
        warm_start: An earlier plan of the same robot to start from.
        **named: Fields of ``ddp.Options`` by name, which stand above those of `options`; ``time_limit`` [s] is short for
            ``time_limit_s``. ``model`` says what contacts can do: "wrench" (default), forces within soles and friction
            cones that turn the base, or "lipm", the paper's forces through the CoM.

    Returns:
        The plan, with a report whose status is ``solved`` only if the checker accepts the plan.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidOptions: No such option, or its value is out of range.
        InvalidScene: The scene is malformed or does not fit the robot.
        InvalidRobot: The robot is malformed.
    """
    from mcplan.solve import plan as solve

    return solve(scene, robot, named, warm_start, options)


def replan(
    previous: Plan,
    t: float,
    measured: Knot,
    options: Options | None = None,
    *,
    scene: Scene | None = None,
    robot: Robot | None = None,
    **named: Unpack[DdpOptions],
) -> Result:
    """Plan on from a measured state.

    Args:
        previous: The plan under way.
        t: Time in it [s]; the phase under way and those after it are the first guess.
        measured: The state now; its end-effectors in contact stand where they are. An ``angular_momentum_W`` of zero is
            made from ``base_rpy_rate``, an empty ``end_effector_yaw`` from the base's heading.
        options: As for plan(); the number of phases is what is left of them.
        scene: None: the plan's own.
        robot: None: the plan's own.
        **named: As for plan().

    Returns:
        A plan from the measured state to the goal (``plan.measured_start`` is set).

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidInput: t lies outside the plan.
        InvalidPlan: The measured state does not fit the robot.
        InvalidOptions: No such option, or its value is out of range.
    """
    from mcplan.solve import replan as solve

    return solve(previous, t, measured, scene, robot, named, options)
