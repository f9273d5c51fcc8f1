"""mp.whole_body: options by name or object, task and warm start by name or object, then the semi-infinite planner."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan._core import PlanarPlan, PlanarTask, sip
from mcplan.arguments import named_by_file, require, require_or_path
from mcplan.errors import Interrupted, InvalidOptions, shown
from mcplan.options import fill, start

#: What each choice of `minimise` sets; options given besides come after it.
CRITERIA: dict[str, dict[str, Any]] = {
    "torque": {"torque_weight": 1.0, "duration_weight": 0.0},
    "time": {"torque_weight": 0.0, "duration_weight": 1.0},
    # Without a cost nothing tells durations apart: one for the whole motion, as in the paper's Table III.
    "none": {"torque_weight": 0.0, "duration_weight": 0.0, "jerk_weight": 0.0, "free_durations": False},
}
#: Options that a certificate needs, since it proves everything that the checker looks at.
_PROVED = ("dynamics", "torque_limits", "clearance")


def whole_body(
    task: PlanarTask | str | Path,
    warm_start: PlanarPlan | str | Path | None,
    certify: bool,
    minimise: str | None,
    named: Mapping[str, Any],
    options: sip.Options | None = None,
) -> sip.Result:
    """See mcplan.whole_body."""
    require("certify", certify, bool)
    chosen = make_options(minimise, named, options)  # before files are read: what is said first is what was typed
    if certify:
        require_provable(chosen)
    planner = sip.Planner(task_of(task), chosen)
    return solve(planner, warm_start, certify=certify, self_collision=chosen.self_collision)


def solve(
    planner: sip.Planner,
    warm_start: PlanarPlan | str | Path | None,
    certify: bool = False,
    self_collision: bool = False,
) -> sip.Result:
    """Run the planner from nothing, or from a plan or the path of one, and prove what it found where that is asked for.

    Raises:
        Interrupted: Ctrl-C, also while it proves: the motion is there then, without a certificate.
    """
    if warm_start is None:
        result = planner.solve()
    else:
        with named_by_file(plan=warm_start):
            result = planner.solve(_plan_of(warm_start))
    if certify:
        try:
            result.certificate = sip.certify(result.plan, self_collision=self_collision)
        except KeyboardInterrupt:
            raise Interrupted(result) from None
    return result


def _plan_of(warm_start: PlanarPlan | str | Path) -> PlanarPlan:
    if isinstance(warm_start, PlanarPlan):
        return warm_start
    require_or_path("warm_start", warm_start, "a PlanarPlan")
    from mcplan.files.whole_body_plans import load_whole_body_plan

    return load_whole_body_plan(warm_start)


def make_options(minimise: str | None, values: Mapping[str, Any], base: sip.Options | None = None) -> sip.Options:
    """Options of the planner from a criterion, and from names and values.

    Args:
        minimise: One of CRITERIA. None: what `base` asks for; without one "torque", or "none" without dynamics.
        values: By name, None for those that stay as they are.
        base: What criterion and values stand above; None: the defaults.

    Raises:
        InvalidArgument: `base` is something else.
        InvalidOptions: No such criterion or option (the message lists those that exist), a wrong type, or out of range.
    """
    options: sip.Options = start("options", base, sip.Options)
    given = {name: value for name, value in values.items() if value is not None}
    if minimise is None and base is not None:
        return fill(options, given)
    if minimise is None:
        dynamics = {name: value for name, value in given.items() if name == "dynamics"}
        minimise = "torque" if fill(sip.Options(), dynamics).dynamics else "none"
    if not isinstance(minimise, str) or minimise not in CRITERIA:
        raise InvalidOptions("minimise", f"must be one of {', '.join(CRITERIA)}", shown(minimise))
    fill(options, {**CRITERIA[minimise], **given})
    if not options.dynamics and options.torque_weight > 0.0:
        raise InvalidOptions(
            "minimise", "must be time or none without dynamics: there are no torques then", shown(minimise)
        )
    return options


def require_provable(options: sip.Options) -> None:
    """Raises InvalidOptions where a certificate would be about constraints that the planner leaves out."""
    for name in _PROVED:
        if not getattr(options, name):
            raise InvalidOptions("certify", f"needs {name}, since a certificate is about all constraints")


def task_of(task: PlanarTask | str | Path) -> PlanarTask:
    """The task, or what load_planar_task makes of its name."""
    if isinstance(task, PlanarTask):
        return task
    require_or_path("task", task, "a PlanarTask", "a name")
    from mcplan.files.planar_tasks import load_planar_task

    return load_planar_task(task)
