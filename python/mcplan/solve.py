"""mp.plan: options by name or object, scene and robot by name or object, then the planner."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import Knot, Plan, PlanResult, Robot, Scene
from mcplan.arguments import named_by_file, require, require_number, require_or_path
from mcplan.files.meeting import warn_of_names
from mcplan.options import fill, start


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
    return planner.solve() if warm_start is None else planner.solve(warm_start)


def replan(
    previous: Plan,
    t: float,
    measured: Knot,
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
    world, body = scene or previous.scene, robot or previous.robot
    return _core.ddp.SwitchedDdp(world, body, make_options(named, options)).replan(previous, t, measured)


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
