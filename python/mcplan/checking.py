"""mp.check: the checker of the library, whose refusal of an argument names it."""

from __future__ import annotations

from typing import Any, overload

from mcplan import _core
from mcplan._core import CheckResult, Plan, PlanarPlan, PlanarTolerances, Robot, Scene, Tolerances
from mcplan.arguments import require, titled
from mcplan.errors import InvalidArgument
from mcplan.files.meeting import warn_of_names

_TAKES: dict[type, dict[str, tuple[type, ...]]] = {
    Plan: {
        "scene": (Scene, type(None)),
        "robot": (Robot, type(None)),
        "tolerances": (Tolerances,),
        "until_s": (float, int),
    },
    PlanarPlan: {"tolerances": (PlanarTolerances,), "self_collision": (bool,)},
}


@overload
def check(
    plan: Plan,
    scene: Scene | None = None,
    robot: Robot | None = None,
    tolerances: Tolerances = ...,
    until_s: float = ...,
) -> CheckResult: ...
@overload
def check(plan: PlanarPlan, tolerances: PlanarTolerances = ..., self_collision: bool = False) -> CheckResult: ...
def check(plan: Any, *given: Any, **named: Any) -> CheckResult:
    """Check a plan from its positions, forces and polygons alone, a whole-body plan from its splines.

        mp.check(result.plan, scene, robot).raise_if_violated()

    Args:
        plan: The plan.
        scene: What it is checked against; None: the plan's own. A whole-body plan takes no scene and no robot.
        robot: As `scene`.
        tolerances: Accepted amounts beyond the limits: ``Tolerances``, or ``PlanarTolerances`` of a whole-body plan.
        until_s: Before the plan's end only what comes no later than this time [s] is looked at; not for a whole-body plan.
        self_collision: Whether the collision pairs of a whole-body plan's robot are checked, too.

    Returns:
        The violations, if any.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidPlan: The arrays of the plan do not fit together.
        InvalidOptions: A tolerance is no number, or until_s not above zero.
        InvalidScene, InvalidRobot, InvalidPlanarTask: What it is checked against is malformed.
        Interrupted: Ctrl-C, with what was found by then.
    """
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


def _require_taken(plan: Any, given: tuple[Any, ...], named: dict[str, Any]) -> None:
    """Raises InvalidArgument for the first argument of another type, and for one that only the other kind of plan takes."""
    require("plan", plan, Plan, PlanarPlan)
    kind = Plan if isinstance(plan, Plan) else PlanarPlan
    takes, others = _TAKES[kind], {name for legal in _TAKES.values() for name in legal}
    for name, value in [*zip(takes, given, strict=False), *named.items()]:
        if name in takes:
            kinds = [each for each in takes[name] if each is not type(None)]
            require(name, value, *kinds, optional=type(None) in takes[name])
        elif name in others:
            raise InvalidArgument(name, f"must not be given with {titled(kind)}, which takes {' and '.join(takes)}")
