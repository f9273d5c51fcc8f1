"""mp.walk: options by name or object, scene, robot and sequence by name or object, then the receding-horizon planner."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from mcplan._core import Plan, Robot, Scene, require_standing, rhp
from mcplan.arguments import named_by_file, require_or_path
from mcplan.errors import Interrupted, InvalidInput
from mcplan.files.meeting import warn_of_names
from mcplan.options import fill, start
from mcplan.solve import robot_of, scene_of

#: Walks where no robot is named and no sequence brings one.
ROBOT = "talos_wang"


def receding_horizon(
    scene: Scene | str | Path,
    robot: Robot | str | Path | None,
    sequence: Plan | str | Path | None,
    named: Mapping[str, Any],
    options: rhp.Options | None = None,
) -> rhp.RecedingHorizon:
    """See mcplan.receding_horizon."""
    chosen = make_options(named, options)  # before files are read: what is said first is what was typed
    parts = parts_of(scene, robot, sequence)
    with named_by_file(scene, robot, sequence):
        return planner_of(*parts, chosen)


def parts_of(
    scene: Scene | str | Path, robot: Robot | str | Path | None, sequence: Plan | str | Path | None
) -> tuple[Scene, Robot, Plan | None]:
    """Scene, robot and sequence from what walk() takes for them."""
    scene = scene_of(scene)
    if sequence is not None and not isinstance(sequence, Plan):
        require_or_path("sequence", sequence, "a Plan")
        from mcplan.files.plans import load_plan

        sequence = load_plan(sequence)
    if robot is None:
        robot = ROBOT if sequence is None else sequence.robot
    return scene, robot_of(robot), sequence


def planner_of(scene: Scene, robot: Robot, sequence: Plan | None, options: rhp.Options) -> rhp.RecedingHorizon:
    """The planner of a scene's own steps or of a plan's.

    Raises:
        InvalidScene: Without a sequence, which has a start of its own: the robot cannot stand at the scene's start or goal.
    """
    warn_of_names(scene, robot)
    if sequence is None:
        planner = rhp.RecedingHorizon(scene, robot, options)
        require_standing(scene, robot)
        return planner
    return rhp.RecedingHorizon(scene, robot, sequence, options)


def make_options(values: Mapping[str, Any], base: rhp.Options | None = None) -> rhp.Options:
    """Options of the receding-horizon planner from names and values.

    Args:
        values: By name, None for those that stay as they are.
        base: What they stand above; None: the defaults.

    Raises:
        InvalidArgument: `base` is something else.
        InvalidOptions: No such option (the message lists those that exist), a wrong type, or out of range.
    """
    options: rhp.Options = fill(start("options", base, rhp.Options), values)
    return options


def cycles_of(planner: rhp.RecedingHorizon, count: int) -> Iterator[rhp.Cycle]:
    """Run cycles one by one, as planner.walk() does, until `count` are done, one fails or the sequence ends.

    planner.result() is the walk then, and its success that of all cycles.

    Raises:
        Interrupted: Ctrl-C, with the walk until then.
    """
    for index in range(count):
        try:
            cycle = planner.step()
        except Interrupted:
            raise Interrupted(planner.result()) from None
        except InvalidInput as end:
            if index > 0 and end.field == "cycles":  # the sequence has no more steps
                return
            raise
        yield cycle
        if not cycle.executed:
            return
