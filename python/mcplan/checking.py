"""mp.check: the checker of the library, of plans at hand or in files, whose refusal of an argument names it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from mcplan import _core
from mcplan._core import CheckResult, Plan, PlanarPlan, PlanarTolerances, Robot, Scene, Tolerances
from mcplan.arguments import require, require_or_path, titled
from mcplan.errors import InvalidArgument
from mcplan.files.meeting import warn_of_names

if TYPE_CHECKING:
    from mcplan.wb import Motion, MotionCheckResult, MotionTolerances

_TAKES: dict[type, dict[str, tuple[type, ...]]] = {
    Plan: {
        "scene": (Scene,),
        "robot": (Robot,),
        "tolerances": (Tolerances,),
        "until_s": (float, int),
    },
    PlanarPlan: {"tolerances": (PlanarTolerances,), "self_collision": (bool,)},
}
#: Arguments that may be names or paths as well, or None.
_READ: dict[str, type] = {"scene": Scene, "robot": Robot}


@overload
def check(
    plan: Plan | str | Path,
    scene: Scene | str | Path | None = None,
    robot: Robot | str | Path | None = None,
    tolerances: Tolerances = ...,
    until_s: float = ...,
) -> CheckResult: ...
@overload
def check(plan: PlanarPlan, tolerances: PlanarTolerances = ..., self_collision: bool = False) -> CheckResult: ...
@overload
def check(plan: Motion, tolerances: MotionTolerances | None = None) -> MotionCheckResult: ...
def check(plan: Any, *given: Any, **named: Any) -> Any:
    """Check a plan from its positions, forces and polygons alone, a whole-body plan and a motion from their splines.

        mp.check(result.plan, scene, robot).raise_if_violated()
        mp.check("plan.npz", "flat")

    Args:
        plan: The plan, or the motion, or the path of either.
        scene: What it is checked against, or what load_scene takes; None: the plan's own. A whole-body plan and a motion take
            no scene and no robot.
        robot: As `scene`.
        tolerances: Accepted amounts beyond the limits: ``Tolerances``, ``PlanarTolerances`` of a whole-body plan, or
            ``wb.MotionTolerances`` of a motion.
        until_s: Before the plan's end only what comes no later than this time [s] is looked at; not for a whole-body plan.
        self_collision: Whether the collision pairs of a whole-body plan's robot are checked, too.

    Returns:
        The violations, if any; of a motion the worst place of every constraint, with ``measures``.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidPlan: The arrays of the plan do not fit together, or the file is no plan.
        InvalidOptions: A tolerance is no number, or until_s not above zero.
        InvalidScene, InvalidRobot, InvalidPlanarTask: What it is checked against is malformed.
        UnknownName: No such scene or robot, and no such file.
        FileNotFoundError: There is no such plan.
        Interrupted: Ctrl-C, with what was found by then.
    """
    if isinstance(plan, str | os.PathLike):
        from mcplan.wb.loading import load_any

        plan = load_any(Path(plan))
    if not isinstance(plan, Plan | PlanarPlan):
        from mcplan.wb import Motion, MotionTolerances
        from mcplan.wb.certificate import certify

        if not isinstance(plan, Motion):
            require_or_path("plan", plan, "a Plan", "a PlanarPlan", "a Motion")
        require("tolerances", (tolerances := _only_tolerances(given, named)), MotionTolerances, optional=True)
        return certify(plan, tolerances)
    if isinstance(plan, Plan):
        given, named = _with_files_read(given, named)
    try:
        found = _core.check(plan, *given, **named)
    except TypeError:  # only now is it worth a look which argument it was
        _require_taken(plan, given, named)
        raise
    if isinstance(plan, Plan):
        scene, robot = (
            named.get(name, given[i] if i < len(given) else None) for i, name in enumerate(("scene", "robot"))
        )
        warn_of_names(scene or plan.scene, robot or plan.robot)
    return found


def _with_files_read(given: tuple[Any, ...], named: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """The arguments with a scene and a robot where names or paths of them were given."""
    if not any(isinstance(value, str | os.PathLike) for value in (*given, *named.values())):
        return given, named
    from mcplan.files.robots import load_robot
    from mcplan.files.scenes import load_scene

    loads: dict[str, Callable[[str | Path], Any]] = {"scene": load_scene, "robot": load_robot}

    def read(name: str, value: Any) -> Any:
        if name not in loads or not isinstance(value, str | os.PathLike):
            return value
        return loads[name](value if isinstance(value, str) else Path(value))

    names = [*_TAKES[Plan], *[""] * len(given)]
    return tuple(read(name, value) for name, value in zip(names, given, strict=False)), {
        name: read(name, value) for name, value in named.items()
    }


def _only_tolerances(given: tuple[Any, ...], named: dict[str, Any]) -> Any:
    """The one argument that a motion takes, None without.

    Raises:
        InvalidArgument: There is another one.
    """
    others = [name for name in named if name != "tolerances"] + ["the third argument"] * (len(given) > 1)
    if others or (given and named):
        raise InvalidArgument(
            others[0] if others else "tolerances", "must not be given with a Motion, which takes tolerances"
        )
    return given[0] if given else named.get("tolerances")


def _require_taken(plan: Any, given: tuple[Any, ...], named: dict[str, Any]) -> None:
    """Raises InvalidArgument for the first argument of another type, and for one that only the other kind of plan takes."""
    kind = Plan if isinstance(plan, Plan) else PlanarPlan
    takes, others = _TAKES[kind], {name for legal in _TAKES.values() for name in legal}
    for name, value in [*zip(takes, given, strict=False), *named.items()]:
        if name in takes:
            if name in _READ and not isinstance(value, _READ[name]):
                require_or_path(name, value, titled(_READ[name]), "a name", optional=True)
            elif name not in _READ:
                require(name, value, *takes[name])
        elif name in others:
            raise InvalidArgument(name, f"must not be given with {titled(kind)}, which takes {' and '.join(takes)}")
