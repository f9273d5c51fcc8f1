"""mp.plan: options by name or object, scene and robot by name or object, then the planner."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import Knot, Plan, PlanResult, Robot, Scene
from mcplan.arguments import named_by_file, require, require_number, require_or_path
from mcplan.errors import InvalidArgument, InvalidOptions, InvalidPlan, did_you_mean, shown
from mcplan.files.meeting import warn_of_names
from mcplan.options import ALIASES, fill, option_names, start

#: Surfaces by end-effector: indices in the robot's order, -1 free, or names.
Contacts = Sequence[int] | Mapping[str, str | None]
#: A velocity to walk at: ahead and to the left [m/s], turning [rad/s].
Command = _core.ddp.VelocityCommand | Sequence[float]


def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path,
    named: Mapping[str, Any],
    warm_start: Plan | None = None,
    options: _core.ddp.Options | None = None,
) -> PlanResult:
    """See mcplan.plan."""
    require("warm_start", warm_start, Plan, optional=True)
    world, body, chosen = scene_of(scene), robot_of(robot), make_options(named, options)
    with named_by_file(scene, robot):
        planner = _core.ddp.SwitchedDdp(world, body, chosen)
        warn_of_names(world, body)
        _core.require_standing(world, body)
        if warm_start is not None:
            _require_of(body, warm_start)
    return planner.solve() if warm_start is None else planner.solve(warm_start)


def _require_of(robot: Robot, warm_start: Plan) -> None:
    """Raise InvalidPlan for a plan of another robot: contacts go by the number of an end-effector, so it would do for any."""
    rule = "must be that of the robot that is planned for, "
    own, other = ([end.name for end in each.end_effectors] for each in (robot, warm_start.robot))
    if warm_start.robot.name != robot.name:
        raise InvalidPlan("warm_start.robot.name", rule + shown(robot.name), shown(warm_start.robot.name))
    if own != other:
        raise InvalidPlan("warm_start.robot.end_effectors", rule + ", ".join(own), ", ".join(other))


def replan(
    previous: Plan,
    t: float,
    measured: Knot,
    contacts: Contacts | None,
    command: Command | None,
    scene: Scene | None,
    robot: Robot | None,
    named: Mapping[str, Any],
    options: _core.ddp.Options | None = None,
) -> PlanResult:
    """See mcplan.replan."""
    require("previous", previous, Plan)
    require("measured", measured, Knot)
    require("scene", scene, Scene, optional=True)
    require("robot", robot, Robot, optional=True)
    t = require_number("t", t)
    how, search = replan_options(named, options)
    return _core.ddp.replan(
        previous,
        t,
        measured,
        contact_indices(contacts, previous),
        scene or previous.scene,
        robot or previous.robot,
        how,
        search,
        command_of(command),
    )


def replan_options(
    named: Mapping[str, Any], base: _core.ddp.Options | None = None
) -> tuple[_core.ddp.ReplanOptions, _core.ddp.Options]:
    """Options of a replan and of its search, from one set of names.

    Raises:
        InvalidOptions: No such option, or its value is out of range.
    """
    own = option_names(_core.ddp.ReplanOptions)
    legal = [*own, *option_names(_core.ddp.Options)]
    for name in named:
        if name not in legal and name not in ALIASES:
            raise InvalidOptions(
                str(name), f"no such option. {did_you_mean(str(name), legal)}Options: {', '.join(legal)}"
            )
    how = fill(_core.ddp.ReplanOptions(), {name: value for name, value in named.items() if name in own})
    search = make_options({name: value for name, value in named.items() if name not in own}, base)
    how.validate()
    return how, search


def contact_indices(contacts: Contacts | None, plan: Plan) -> list[int]:
    """Surface index by end-effector, from indices or from names.

    Args:
        contacts: A sequence of indices, -1 free; or surfaces by end-effector, names both, where those left out are free;
            or None: empty, as planned.
        plan: Whose scene and robot are named.

    Raises:
        InvalidPlan: No such end-effector or surface.
        InvalidArgument: Something else.
    """
    if contacts is None:
        return []
    if not isinstance(contacts, Mapping):
        try:
            return [operator.index(surface) for surface in contacts]
        except TypeError:
            raise InvalidArgument(
                "contacts", "must be indices of surfaces, or a mapping from end-effectors to surfaces", shown(contacts)
            ) from None
    ends = [end.name for end in plan.robot.end_effectors]
    surfaces = [surface.name for surface in plan.scene.surfaces]
    out = [-1] * len(ends)
    for end, surface in contacts.items():
        if end not in ends:
            raise InvalidPlan("measured.contacts", f"must name end-effectors: {', '.join(ends)}", shown(end))
        if surface is None:
            continue
        if surface not in surfaces:
            raise InvalidPlan(
                f"measured.contacts.{end}",
                f"must be a surface of the plan's scene. {did_you_mean(str(surface), surfaces)}".rstrip(" ."),
                shown(surface),
            )
        out[ends.index(end)] = surfaces.index(surface)
    return out


def command_of(command: Command | None) -> _core.ddp.VelocityCommand | None:
    """The velocity to walk at, from three numbers or as it is.

    Raises:
        InvalidArgument: It is neither.
    """
    if command is None or isinstance(command, _core.ddp.VelocityCommand):
        return command
    try:
        ahead, left, yaw_rate = (float(number) for number in command)
    except (TypeError, ValueError):
        raise InvalidArgument(
            "command",
            "must be a ddp.VelocityCommand or three numbers: ahead, left [m/s], yaw rate [rad/s]",
            shown(command),
        ) from None
    return _core.ddp.VelocityCommand(velocity_B=[ahead, left], yaw_rate=yaw_rate)


def make_options(values: Mapping[str, Any], base: _core.ddp.Options | None = None) -> _core.ddp.Options:
    """Options of the contact-sequence search from names and values; `weights` may be a mapping too.

    Args:
        values: By name, None for those that stay as they are.
        base: What they stand above; None: the defaults.

    Raises:
        InvalidArgument: `base` is something else.
        InvalidOptions: No such option (the message lists those that exist), a wrong type, or out of range.
    """
    options: _core.ddp.Options = fill(start("options", base, _core.ddp.Options), values)
    return options


def scene_of(scene: Scene | str | Path) -> Scene:
    """The scene, or what load_scene makes of its name.

    Raises:
        InvalidArgument: It is neither; otherwise as load_scene.
    """
    if isinstance(scene, Scene):
        return scene
    require_or_path("scene", scene, "a Scene", "a name")
    from mcplan.files.scenes import load_scene

    return load_scene(scene)


def robot_of(robot: Robot | str | Path) -> Robot:
    """The robot, or what load_robot makes of its name.

    Raises:
        InvalidArgument: It is neither; otherwise as load_robot.
    """
    if isinstance(robot, Robot):
        return robot
    require_or_path("robot", robot, "a Robot", "a name")
    from mcplan.files.robots import load_robot

    return load_robot(robot)
