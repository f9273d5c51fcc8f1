"""The contact-sequence search: options, a solve, a result that has the plan and a report.

    from mcplan import ddp

    options = ddp.Options(phases=24, weights=ddp.Weights(flight=2.0))
    result = ddp.plan("stairs", "humanoid44", options)  # or ddp.plan("stairs", phases=24)
    result.plan.save("plan.npz"), result.report.status

``SwitchedDdp`` is the planner behind it, one object for several solves.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

from mcplan._core import Knot, Plan, Robot, Scene
from mcplan._core import PlanResult as Result
from mcplan._core.ddp import (
    Method,
    Model,
    Options,
    Polish,
    ReplanOptions,
    StiffnessInput,
    SwitchedDdp,
    VelocityCommand,
    Weights,
    on_joined_ground,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from mcplan.option_types import DdpOptions, DdpReplanOptions
    from mcplan.solve import Command, Contacts
    from mcplan.wb.planned import PlannedMotion

__all__ = [
    "Method",
    "Model",
    "Options",
    "Polish",
    "ReplanOptions",
    "Result",
    "StiffnessInput",
    "SwitchedDdp",
    "VelocityCommand",
    "Weights",
    "on_joined_ground",
    "plan",
    "replan",
]


@overload
def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path = "humanoid44",
    options: Options | None = None,
    *,
    warm_start: Plan | None = None,
    motion: Literal[False] = False,
    **named: Unpack[DdpOptions],
) -> Result: ...


@overload
def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path = "humanoid44",
    options: Options | None = None,
    *,
    warm_start: Plan | None = None,
    motion: Literal[True] | Mapping[str, Any],
    **named: Unpack[DdpOptions],
) -> PlannedMotion: ...


def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path = "humanoid44",
    options: Options | None = None,
    *,
    warm_start: Plan | None = None,
    motion: bool | Mapping[str, Any] = False,
    **named: Unpack[DdpOptions],
) -> Result | PlannedMotion:
    """Find a contact sequence and a motion from the scene's start to its goal.

    Ctrl-C ends the search with Interrupted, which carries the result with the best plan so far.

    Args:
        scene: A scene, or what load_scene takes.
        robot: A robot, or what load_robot takes.
        options: How to search; None: the defaults.
        warm_start: An earlier plan of the same robot to start from.
        motion: Find a whole-body motion along the plan as well (``mcplan.motion``), and search again, up to five times in
            all, with the limits that it found missing. True, or options of ``mcplan.motion`` by name. A `time_limit` is
            for all of it, certificates apart.
        **named: Fields of ``ddp.Options`` by name, which stand above those of `options`; ``time_limit`` [s] is short for
            ``time_limit_s``. ``model`` says what contacts can do: "wrench" (default), forces within soles and friction
            cones that turn the base, or "lipm", the paper's forces through the CoM.

    Returns:
        The plan, with a report whose status is ``solved`` only if the checker accepts the plan. With `motion` a
        ``mcplan.wb.PlannedMotion``, which has the motion beside plan and report, and is ``solved`` only if it is certified.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidOptions: No such option, or its value is out of range.
        InvalidPlan: ``warm_start`` is a plan of another robot.
        InvalidScene: The scene is malformed or does not fit the robot.
        InvalidRobot: The robot is malformed.
        MissingExtra: With `motion`, the packages of ``pip install 'mcplan[view]'`` are not installed.
    """
    if motion is not False:
        from mcplan.alternation import plan_with_motion

        return plan_with_motion(scene, robot, named, warm_start, options, motion)
    from mcplan.solve import plan as solve

    return solve(scene, robot, named, warm_start, options)


def replan(
    previous: Plan,
    t: float,
    measured: Knot,
    options: Options | None = None,
    *,
    contacts: Contacts | None = None,
    command: Command | None = None,
    scene: Scene | None = None,
    robot: Robot | None = None,
    **named: Unpack[DdpReplanOptions],
) -> Result:
    """Plan on from a measured state: what a controller calls ten times a second.

    The phase under way and those after it are kept where they still do; steps are put in where the measured state asks for
    them, and phases are added at the end as the robot goes on. The report says where the plan comes from (``plan_from``),
    until when it keeps all limits (``kept_until_s``), and what the measured state violates by itself
    (``start_violations``). docs/replanning.md says what a controller does with which status.

    Args:
        previous: The plan under way.
        t: Time in it [s].
        measured: The state now. An ``angular_momentum_W`` of zero is made from ``base_rpy_rate``, an empty
            ``end_effector_yaw`` from the base's heading; without ``end_effector_velocities_W`` free end-effectors move as
            planned. What stands is put onto the plane of its surface.
        options: As for plan(); what looks for a sequence (phases, guesses, restarts) is not used.
        contacts: What each end-effector truly touches: surface indices of the plan's scene in the robot's order, -1 free,
            or names of surfaces by names of end-effectors, those left out free. None: as planned at that time.
        command: A velocity to walk on at, instead of to the scene's goal: ahead and to the left [m/s] and turning [rad/s],
            or a ``ddp.VelocityCommand``.
        scene: None: the plan's own.
        robot: None: the plan's own.
        **named: Fields of ``ddp.Options`` and ``ddp.ReplanOptions`` by name; ``time_limit`` [s] as for plan().

    Returns:
        A plan from the measured state (``plan.measured_start`` is set). Its status is ``solved`` if the checker accepts it,
        but for what the start itself violates and the plan makes good within ``start_slack_s``.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidInput: t lies outside the plan.
        InvalidPlan: The measured state or the contacts do not fit the robot or the scene.
        InvalidOptions: No such option, or its value is out of range.
    """
    from mcplan.solve import replan as solve

    return solve(previous, t, measured, contacts, command, scene, robot, named, options)
