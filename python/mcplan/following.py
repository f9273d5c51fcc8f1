"""mp.track: a plan of any planner, or a motion, options by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan._core import Plan, PlanarPlan, Robot
from mcplan.arguments import require_or_path
from mcplan.errors import InvalidInput, shown
from mcplan.tracking.choice import make_options
from mcplan.tracking.options import Watch

if TYPE_CHECKING:
    from mcplan.planar.tracking import PlanarResult
    from mcplan.tracking.result import TrackingResult
    from mcplan.wb import Motion


def track_any(
    plan: Plan | PlanarPlan | Motion | str | Path,
    robot: Robot | str | Path | None,
    values: Mapping[str, Any],
    progress: Callable[[float, float], None] | None = None,
    watch: Watch | None = None,
) -> TrackingResult | PlanarResult:
    """Track a plan of any planner, or a motion; see mcplan.track.

    Args:
        plan: The plan, the motion, or the path of one.
        robot: Robot for a plan of ddp or rhp; None: the plan's own.
        values: Fields of Options by name.
        progress: Called now and then with the time simulated and the time to simulate [s].
        watch: Called at every control step; see mcplan.track.
    """
    if not isinstance(robot, Robot):
        require_or_path("robot", robot, "a Robot", "a name", optional=True)
    from mcplan.wb import Motion

    if not isinstance(plan, (Plan, PlanarPlan, Motion)):
        require_or_path("plan", plan, "a Plan", "a PlanarPlan", "a Motion")
        from mcplan.wb.loading import load_any

        plan = load_any(plan)
    if isinstance(plan, (Plan, Motion)):
        from mcplan.tracking.runner import track

        return track(plan, robot, make_options(values), progress, watch)
    if watch is not None:
        raise InvalidInput("watch", "must not be given with a whole-body plan, whose robot is planar")
    if robot is not None:
        name = robot if isinstance(robot, (str, Path)) else robot.name
        raise InvalidInput("robot", "must not be given with a whole-body plan, which has its own", shown(str(name)))
    from mcplan.planar.tracking import DEFAULT_OPTIONS, track_whole_body

    return track_whole_body(plan, make_options(values, DEFAULT_OPTIONS), progress=progress)
