"""mp.plan: options by name, scene and robot by name or object, then the planner."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import Knot, Plan, PlanResult, Robot, Scene
from mcplan.errors import InvalidOptions, did_you_mean

_ALIASES = {"time_limit": "time_limit_s"}


def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path,
    options: Mapping[str, Any],
    warm_start: Plan | None = None,
) -> PlanResult:
    """See mcplan.plan."""
    if not isinstance(scene, Scene):
        from mcplan.files.scenes import load_scene

        scene = load_scene(scene)
    if not isinstance(robot, Robot):
        from mcplan.files.robots import load_robot

        robot = load_robot(robot)
    planner = _core.ddp.SwitchedDdp(scene, robot, make_options(options))
    return planner.solve() if warm_start is None else planner.solve(warm_start)


def replan(
    previous: Plan, t: float, measured: Knot, scene: Scene | None, robot: Robot | None, options: Mapping[str, Any]
) -> PlanResult:
    """See mcplan.replan."""
    planner = _core.ddp.SwitchedDdp(scene or previous.scene, robot or previous.robot, make_options(options))
    return planner.replan(previous, t, measured)


def make_options(values: Mapping[str, Any]) -> Any:
    """Options of the contact-sequence search from names and values; `weights` may be a mapping too.

    Raises:
        InvalidOptions: No such option (the message lists those that exist), a wrong type, or out of range.
    """
    options = _core.ddp.Options()
    for name, value in values.items():
        name = _ALIASES.get(name, name)
        if name == "weights" and isinstance(value, Mapping):
            for weight, amount in value.items():
                _set(options.weights, weight, amount, prefix="weights.")
        else:
            _set(options, name, value)
    options.validate()
    return options


def _set(target: Any, name: str, value: Any, prefix: str = "") -> None:
    legal = option_names(type(target))
    if name not in legal:
        raise InvalidOptions(prefix + name, f"no such option. {did_you_mean(name, legal)}Options: {', '.join(legal)}")
    if isinstance(value, str) and hasattr(type(getattr(target, name)), "__members__"):
        members = type(getattr(target, name)).__members__
        if value not in members:
            raise InvalidOptions(prefix + name, f"must be one of {', '.join(members)}", repr(value))
        value = members[value]
    try:
        setattr(target, name, value)
    except TypeError:
        kind = type(getattr(target, name)).__name__
        raise InvalidOptions(prefix + name, f"must be of type {kind}", repr(value)) from None


def option_names(cls: type) -> list[str]:
    """Names of the fields of a bound options class, in their order of declaration."""
    return [name for name, member in vars(cls).items() if isinstance(member, property)]
