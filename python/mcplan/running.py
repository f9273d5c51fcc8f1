"""mp.run: a plan to begin with, a simulation with replanning, options by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Plan, Robot, Scene, Status, join_surfaces
from mcplan.arguments import require_or_path
from mcplan.errors import InvalidInput, InvalidOptions, did_you_mean, shown
from mcplan.files.whole_ground import on_whole_ground
from mcplan.kinematics.urdf_model import require_urdf
from mcplan.online.goals import require_goals
from mcplan.online.options import OnlineOptions, option_names
from mcplan.online.steering import ALONE, Beside, require_steerable
from mcplan.solve import plan as solve
from mcplan.tracking.choice import is_row, make_options
from mcplan.tracking.options import Options

if TYPE_CHECKING:
    from mcplan.online.result import RunResult

#: Short names of options.
SHORT = {"push": "pushes", "latency": "latency_s", "period": "period_s", "duration": "duration_s", "keep": "keep_s"}
#: Options of a tracked run that a run with replanning has not: help for the base that would hide what replanning does.
WITHOUT = ("assist",)


def run_any(
    scene: Scene | Plan | str | Path,
    robot: Robot | str | Path | None,
    values: Mapping[str, Any],
    beside: Beside = ALONE,
    true_scene: Scene | str | Path | None = None,
) -> RunResult:
    """Walk with replanning; see mcplan.run.

    Args:
        scene: Where to walk, or the plan to begin with.
        robot: None: that of the plan.
        values: Options by name.
        beside: What is called while the run goes on.
        true_scene: The ground that is simulated; None: as planned.
    """
    if not isinstance(robot, Robot):
        require_or_path("robot", robot, "a Robot", "a name", optional=True)
    if not isinstance(scene, (Scene, Plan)):
        require_or_path("scene", scene, "a Scene", "a Plan", "a name")
    options, online = chosen_options(values)
    require_steerable(beside.steer, online)
    from mcplan.online.runner import run

    if true_scene is not None and not isinstance(true_scene, Scene):
        require_or_path("true_scene", true_scene, "a Scene", "a name")
        from mcplan.files.scenes import load_scene

        true_scene = load_scene(true_scene)
    own = robot if isinstance(scene, Plan) else None
    begins = first_plan(scene, robot, online, in_pieces=true_scene is not None)
    return run(begins, own, options, online, *beside[:2], true_scene, beside.steer)


def chosen_options(values: Mapping[str, Any]) -> tuple[Options, OnlineOptions]:
    """Options of the simulation and of planning, from one set of names.

    Raises:
        InvalidOptions: No such option, a wrong type, or out of range.
    """
    for short, name in SHORT.items():
        if values.get(short) is not None and values.get(name) is not None:
            raise InvalidOptions(short, f"must not be given with {name}, which is the same", shown(values[short]))
    given = {SHORT.get(name, name): value for name, value in values.items() if value is not None}
    own = option_names()
    known = [name for name in Options.__dataclass_fields__ if name not in WITHOUT]
    for name in given:
        if name not in own and name not in known:
            legal = sorted([*own, *known])
            raise InvalidOptions(name, f"no such option. {did_you_mean(name, legal)}Options: {', '.join(legal)}")
    options = make_options({name: value for name, value in given.items() if name not in own})
    online = replace(OnlineOptions(), **{name: _typed(name, given[name]) for name in own if name in given})
    online.validate()
    return options, online


def first_plan(
    scene: Scene | Plan | str | Path,
    robot: Robot | str | Path | None,
    online: OnlineOptions | None = None,
    in_pieces: bool = False,
) -> Plan:
    """The plan to begin with: given, loaded, or found for a scene; by rhp where that replans. Of ddp's it is one on whole
    ground, on which replans may step across the seams of tiles.

    Args:
        scene: Where to walk, or the plan.
        robot: Who walks, with a scene.
        online: What is asked for.
        in_pieces: Surfaces stay as they are, since the ground that is simulated names them.

    Raises:
        InvalidInput: No plan was found, or no robot was named.
        InvalidOptions: A goal lies over no ground.
        InvalidRobot: It has no URDF.
    """
    begins = _plan_or_walk(scene, robot)
    if not in_pieces and (online is None or online.engine == "ddp"):
        begins = _on_whole_ground(begins)
    ground, walker = (begins.scene, begins.robot) if isinstance(begins, Plan) else begins
    require_urdf(walker)  # before a search, not after it
    if online is not None:
        require_goals(ground, walker, online)
    if online is None or online.engine == "ddp":
        return begins if isinstance(begins, Plan) else _searched(*begins)
    from mcplan.online.horizon_walk import first_walk

    if isinstance(begins, Plan):
        return begins if begins.planner == "rhp" else first_walk(begins.scene, begins.robot, online, begins)
    return first_walk(*begins, online)


def _on_whole_ground(begins: Plan | tuple[Scene, Robot]) -> Plan | tuple[Scene, Robot]:
    """The plan, or the scene, on surfaces that are joined; itself where none are to be."""
    return on_whole_ground(begins) if isinstance(begins, Plan) else (join_surfaces(begins[0]), begins[1])


def names_plan(scene: str | Path) -> bool:
    """Whether a path is that of a plan, not of a scene, and no name of one."""
    return Path(scene).suffix in (".npz", ".json")


def _plan_or_walk(scene: Scene | Plan | str | Path, robot: Robot | str | Path | None) -> Plan | tuple[Scene, Robot]:
    """The plan, if it is one or the path of one; else scene and robot.

    Raises:
        InvalidInput: It is a whole-body plan, or no robot was named.
    """
    if isinstance(scene, Plan):
        return scene
    if not isinstance(scene, Scene):
        if names_plan(scene):
            from mcplan.files.whole_body_plans import load_any_plan

            plan = load_any_plan(Path(scene))
            if not isinstance(plan, Plan):
                raise InvalidInput("scene", "must be a scene or a plan of ddp", f"{scene}, a whole-body plan")
            return plan
        from mcplan.files.scenes import load_scene

        scene = load_scene(scene)
    if robot is None:
        raise InvalidInput("robot", "must be given with a scene")
    if not isinstance(robot, Robot):
        from mcplan.files.robots import load_robot

        robot = load_robot(robot)
    return scene, robot


def _searched(scene: Scene, robot: Robot) -> Plan:
    result = solve(scene, robot, {})
    if result.report.status not in (Status.solved, Status.acceptable):
        raise InvalidInput("scene", "must have a plan to begin with", f"{scene.name}: {result.report.message}")
    return result.plan


def _typed(name: str, value: Any) -> Any:
    kind = type(getattr(OnlineOptions(), name))
    if kind is tuple:
        return _goals(name, value) if name == "goal" else _commands(name, value)
    if kind is float and not isinstance(value, bool) and hasattr(value, "__float__") and np.ndim(value) == 0:
        return float(value)
    if not isinstance(value, kind):
        raise InvalidOptions(name, "must be a number" if kind is float else f"must be a {kind.__name__}", shown(value))
    return value


def _commands(name: str, value: Any) -> tuple[tuple[float, ...], ...]:
    """Velocities with the times from which on they hold: of one without a time, from the beginning.

    Raises:
        InvalidOptions: No numbers, or not three or four of them.
    """
    return tuple((0.0, *row) if len(row) == 3 else row for row in _rows(name, value))


def _goals(name: str, value: Any) -> tuple[tuple[float, ...], ...]:
    """Times, places and headings, from x, y, heading and time: the last two are 0 unless they are given.

    Raises:
        InvalidOptions: No numbers, or not two to four of them.
    """
    rows = _rows(name, value)
    if any(len(row) not in (2, 3, 4) for row in rows):
        raise InvalidOptions(name, "must be two to four numbers: x, y, heading, from a time on", shown(value))
    full = [(*row, *(0.0, 0.0)[len(row) - 2 :]) for row in rows]
    return tuple((row[3], *row[:3]) for row in full)


def _rows(name: str, value: Any) -> list[tuple[float, ...]]:
    """Rows of numbers, from one or several.

    Raises:
        InvalidOptions: No numbers.
    """
    try:
        rows = [value] if is_row(value) else list(value)
        if any(isinstance(part, str | bytes) for row in rows for part in (row, *row)):
            raise TypeError
        numbers = [tuple(float(number) for number in row) for row in rows]
    except (TypeError, ValueError, OverflowError):
        raise InvalidOptions(name, "must be numbers", shown(value)) from None
    if not np.isfinite([number for row in numbers for number in row]).all():
        raise InvalidOptions(name, "must be finite numbers", shown(value))
    return numbers
