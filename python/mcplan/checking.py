"""mp.check: the checker of the library, whose refusal of an argument names it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

from mcplan import _core
from mcplan._core import CheckResult, Plan, PlanarPlan, PlanarTolerances, Robot, Scene, Tolerances
from mcplan.arguments import require, titled
from mcplan.errors import InvalidArgument
from mcplan.files.meeting import warn_of_names

if TYPE_CHECKING:
    from mcplan.wb import Motion, MotionCheckResult, MotionTolerances

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
@overload
def check(plan: Motion, tolerances: MotionTolerances | None = None) -> MotionCheckResult: ...
def check(plan: Any, *given: Any, **named: Any) -> Any:
    """Check a plan from its positions, forces and polygons alone, a whole-body plan and a motion from their splines.

        mp.check(result.plan, scene, robot).raise_if_violated()

    Args:
        plan: The plan, or the motion.
        scene: What it is checked against; None: the plan's own. A whole-body plan and a motion take no scene and no robot.
        robot: As `scene`.
        tolerances: Accepted amounts beyond the limits: ``Tolerances``, ``PlanarTolerances`` of a whole-body plan, or
            ``wb.MotionTolerances`` of a motion.
        until_s: Before the plan's end only what comes no later than this time [s] is looked at; not for a whole-body plan.
        self_collision: Whether the collision pairs of a whole-body plan's robot are checked, too.

    Returns:
        The violations, if any; of a motion the worst place of every constraint, with ``measures``.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidPlan: The arrays of the plan do not fit together.
        InvalidOptions: A tolerance is no number, or until_s not above zero.
        InvalidScene, InvalidRobot, InvalidPlanarTask: What it is checked against is malformed.
        Interrupted: Ctrl-C, with what was found by then.
    """
    if not isinstance(plan, Plan | PlanarPlan):
        from mcplan.wb import Motion, MotionTolerances
        from mcplan.wb.certificate import certify

        require("plan", plan, Plan, PlanarPlan, Motion)
        require("tolerances", (tolerances := _only_tolerances(given, named)), MotionTolerances, optional=True)
        return certify(plan, tolerances)
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
    require("plan", plan, Plan, PlanarPlan)
    kind = Plan if isinstance(plan, Plan) else PlanarPlan
    takes, others = _TAKES[kind], {name for legal in _TAKES.values() for name in legal}
    for name, value in [*zip(takes, given, strict=False), *named.items()]:
        if name in takes:
            kinds = [each for each in takes[name] if each is not type(None)]
            require(name, value, *kinds, optional=type(None) in takes[name])
        elif name in others:
            raise InvalidArgument(name, f"must not be given with {titled(kind)}, which takes {' and '.join(takes)}")
