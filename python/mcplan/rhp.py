"""Receding-horizon planning of walks on two feet: options, a solve, a result that has the plan and a report.

    from mcplan import rhp

    options = rhp.Options(lookahead=4, fidelity=rhp.Fidelity.single)
    result = rhp.walk("rubbles", options=options)  # or rhp.walk("rubbles", lookahead=4, fidelity="single")
    result.plan.save("walk.npz"), result.report.status

``RecedingHorizon`` is the planner behind it, cycle by cycle and from measured states.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan._core import Plan, Robot, Scene
from mcplan._core.rhp import Cycle, Fidelity, Options, RecedingHorizon, Solver, State, StepFrom, Transcription, Walk
from mcplan._core.rhp import Walk as Result

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from mcplan.option_types import RhpOptions

__all__ = [
    "Cycle",
    "Fidelity",
    "Options",
    "RecedingHorizon",
    "Result",
    "Solver",
    "State",
    "StepFrom",
    "Transcription",
    "Walk",
    "receding_horizon",
    "walk",
]


def walk(
    scene: Scene | str | Path,
    robot: Robot | str | Path | None = None,
    options: Options | None = None,
    *,
    sequence: Plan | str | Path | None = None,
    **named: Unpack[RhpOptions],
) -> Walk:
    """Plan a walk on two feet over given surfaces: CoM, angular momentum, footholds, timing and forces.

    Each cycle plans `lookahead` steps and executes the first; the next cycle starts from where it ends. A cycle that
    fails ends the walk: ``walk.plan`` is what was executed until then, ``walk.cycles`` says what happened. Ctrl-C ends
    it with Interrupted, which carries the walk. A cycle that a limit cuts short executes its best point or the step that
    the last plan predicted, where the checker finds that usable: ``cycle.step_from`` says which. One that the time limit
    cuts short without a step is gone on with in further calls, up to 50 and no longer than the step before lasts.

    Args:
        scene: A scene, or what load_scene takes; its ``steps`` say which foot lands on which surface.
        robot: A robot with two feet, or what load_robot takes. None: the robot of `sequence`, else talos_wang.
        options: How to plan; None: the defaults.
        sequence: A plan, or path of one, whose start and contact sequence are taken instead of the scene's; the walk
            comes to rest after its last step.
        **named: Fields of ``rhp.Options`` by name, which stand above those of `options`. ``fidelity``: model of the steps
            after the first, "single" (centroidal), "com", "rectangle" or "point" (default). ``lookahead``: steps in a
            horizon, 1 to 10, the executed one included. ``cycles``: steps to execute; fewer if the sequence ends before.
            ``transcription``: "trapezoidal" (default) or "euler" (the paper's, whose motion is not quite the integral of
            its forces). ``time_limit``: of each cycle, wall clock [s]; None: none.

    Returns:
        The walk: ``plan``, ``report``, ``cycles``, ``success``, and totals such as ``distance_m()``. The report's status
        is ``solved`` only if the checker accepts the whole plan.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, or its value is out of range.
        InvalidScene: The scene is malformed, has no steps, or does not fit the robot, which cannot stand at its start or
            goal, for instance.
        InvalidRobot: The robot is malformed or does not have two feet.
        InvalidPlan: The sequence lifts both feet at once, uses other end-effectors than feet, or names surfaces that
            the scene does not have.
        UnknownScene, UnknownRobot: No such name and no such file.
    """
    return receding_horizon(scene, robot, options, sequence=sequence, **named).walk()


def receding_horizon(
    scene: Scene | str | Path,
    robot: Robot | str | Path | None = None,
    options: Options | None = None,
    *,
    sequence: Plan | str | Path | None = None,
    **named: Unpack[RhpOptions],
) -> RecedingHorizon:
    """Make the planner behind walk(), to run it cycle by cycle and from measured states.

        planner = mp.receding_horizon("rubbles", time_limit=1.0)
        while running:
            cycle = planner.step(measured)  # an rhp.State; without one: from where the last step ends
            if cycle.executed:
                follow(planner.executed())  # a plan of one step, from time 0
            # else, if time ran out: step() again from the same state goes on where this cycle stopped

    Args:
        scene: As for walk().
        robot: As for walk().
        options: As for walk().
        sequence: As for walk().
        **named: As for walk().

    Raises:
        InvalidArgument, InvalidOptions, InvalidScene, InvalidRobot, InvalidPlan, UnknownScene, UnknownRobot: As for
            walk().
    """
    from mcplan.walking import receding_horizon as make

    return make(scene, robot, sequence, named, options)
