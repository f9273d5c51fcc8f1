"""Plans whose contacts are compared with real ones (``mcplan bench contacts``): made, measured, judged, timed."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from mcplan._core import may_touch
from mcplan.errors import InvalidOptions, UnknownScene

from . import SCENES
from .contact_measures import ContactMeasures, hands_only_phases, measure_contacts
from .contacts_cases import HAND_MEAN, ITERATION_MS, RAIL_COST, RAIL_GOOD, RATIO, Case, Demand
from .criteria import comparable_cost
from .processes import each
from .speed import iterations, searching_iterations

if TYPE_CHECKING:
    from mcplan import Plan, Robot, Scene
    from mcplan.ddp import Result
    from mcplan.model import EndEffector

Outcome = TypeVar("Outcome")


@dataclass(frozen=True)
class Row:
    """A case and what came of it; None where there is no plan to measure. Lengths [m], forces over the weight.

    `cost_duration` is the part of `cost` that draws the phases' durations to the middle of their box.
    """

    case: str
    scene: str
    robot: str
    model: str
    status: str = ""
    message: str = ""
    time_s: float | None = None
    iterations: int | None = None
    cost: float | None = None
    cost_duration: float | None = None
    tangent_foot: float | None = None
    tangent_hand: float | None = None
    circle_foot: float | None = None
    circle_hand: float | None = None
    peak_foot: float | None = None
    peak_hand: float | None = None
    hand_mean_low: float | None = None
    hand_mean_high: float | None = None
    pressure_off_sole_m: float | None = None
    pressure_off_surface_m: float | None = None
    slip_m: float | None = None
    reach_m: float | None = None
    swing_stiffness: float | None = None
    momentum_Nms: float | None = None
    roll_deg: float | None = None
    pitch_deg: float | None = None
    com_low_knots_m: float | None = None
    com_low_m: float | None = None
    com_high_knots_m: float | None = None
    com_high_m: float | None = None
    flights: int | None = None
    hands_only: int | None = None
    alternate: bool | None = None
    missed: str = ""
    com_replay_m: float | None = None
    velocity_replay_m_s: float | None = None
    momentum_replay_Nms: float | None = None
    orientation_deg: float | None = None
    orientation_from_start_deg: float | None = None
    holds: bool | None = None
    why: str = ""

    def as_dict(self) -> dict[str, Any]:
        """Fields by name."""
        return asdict(self)


def run(cases: Sequence[Case], jobs: int = 1, progress: Callable[[str], None] | None = None) -> list[Row]:
    """Plan all cases and judge what comes of them.

    Args:
        cases: What to plan.
        jobs: Processes; 1: this one.
        progress: Called with a line for each case that is done.

    Returns:
        Rows in the order of the cases.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed during a solve.
    """
    rows: dict[int, Row] = {}
    for index, row in each(solve, cases, jobs):
        rows[index] = row
        if progress is not None:
            progress(f"[{len(rows)}/{len(cases)}] {line(row)}")
    return [rows[i] for i in range(len(cases))]


def solve(case: Case) -> Row:
    """Plan a case, measure and judge it. A scene or an option that does not exist is a row that fails."""
    head: dict[str, Any] = {"case": case.name, "scene": case.scene, "robot": case.robot, "model": case.model}
    try:
        result = plan_of(case)
    except (UnknownScene, InvalidOptions) as refused:
        return Row(**head, status="refused", message=str(refused), holds=False, why=str(refused))
    row = Row(**head, **values_of(result))
    why = shortfalls(row, case.demand)
    return Row(**{**row.as_dict(), "holds": not why, "why": "; ".join(why)})


def plan_of(case: Case) -> Result:
    """Plan a case.

    Raises:
        UnknownScene, InvalidOptions: The scene or an option does not exist.
    """
    import mcplan

    options = dict(case.planning)
    if case.model:
        options["model"] = case.model
    scene = scene_of(case)
    return mcplan.plan(scene, robot_of(case, scene.gravity), **options)


def scene_of(case: Case) -> Scene:
    """The case's scene, with its friction, grasps and rules."""
    import mcplan

    scene = mcplan.load_scene(case.scene)
    surfaces = list(scene.surfaces)
    for surface in surfaces:
        if case.friction is not None:
            surface.friction = case.friction
        surface.grasp = surface.grasp and case.grasp
    scene.surfaces = surfaces
    if not case.rules:
        scene.rules = []
    return scene


def robot_of(case: Case, gravity: float) -> Robot:
    """The case's robot, with the cap on its hands."""
    import mcplan

    robot = mcplan.load_robot(case.robot)
    if case.hand_cap is not None:
        cap = case.hand_cap * robot.mass * gravity
        robot.end_effectors = [_capped(end, cap) for end in robot.end_effectors]
    return robot


def _capped(end: EndEffector, cap: float) -> EndEffector:
    if end.kind == "hand":
        end.max_force = min(end.max_force, cap)
    return end


def values_of(result: Result) -> dict[str, Any]:
    """Fields of a row that a solve determines."""
    report, plan = result.report, result.plan
    worst = report.worst_violation
    values: dict[str, Any] = {"status": str(report.status), "time_s": report.time_s, "iterations": report.iterations}
    if values["status"] != "solved":
        values["message"] = report.message or (str(worst) if worst.name else "")
    if plan.phases:
        durations = (report.cost_terms.get(name, 0.0) for name in ("duration", "flight_duration"))
        values |= {"cost": comparable_cost(report), "cost_duration": float(sum(durations))}
        values |= measured(plan, measure_contacts(plan))
    return values


def measured(plan: Plan, found: ContactMeasures) -> dict[str, Any]:
    """Fields of a row that a plan determines."""
    hands = [end.name for end in plan.robot.end_effectors if end.kind == "hand"]
    means = [
        value for phase in found.hands_only if len(phase.vertical) == len(hands) for value in phase.vertical.values()
    ]
    feet = [end for end in plan.robot.end_effectors if end.kind == "foot"]
    for_feet = {s.name for s in plan.scene.surfaces if any(may_touch(s, foot) for foot in feet)}
    return {
        **{f"{field}_{kind}": _of(found, name, kind) for field, name in _BY_KIND for kind in ("foot", "hand")},
        "hand_mean_low": min(means, default=None),
        "hand_mean_high": max(means, default=None),
        "pressure_off_sole_m": found.largest("pressure_off_sole_m"),
        "pressure_off_surface_m": found.largest("pressure_off_surface_m"),
        "slip_m": found.largest("slip_m"),
        "reach_m": found.largest("reach_m"),
        "swing_stiffness": found.largest("swing_stiffness"),
        "momentum_Nms": found.momentum_peak_Nms,
        "roll_deg": found.roll_deg,
        "pitch_deg": found.pitch_deg,
        "com_low_knots_m": found.com_height_knots_m[0],
        "com_low_m": found.com_height_m[0],
        "com_high_knots_m": found.com_height_knots_m[1],
        "com_high_m": found.com_height_m[1],
        "flights": found.flights,
        "hands_only": len(hands_only_phases(plan)),
        "alternate": found.feet_alternate,
        "missed": ", ".join(sorted(for_feet - found.surfaces("foot"))),
        "com_replay_m": found.replay.com_m,
        "velocity_replay_m_s": found.replay.velocity_m_s,
        "momentum_replay_Nms": found.replay.momentum_Nms,
        "orientation_deg": found.replay.orientation_deg,
        "orientation_from_start_deg": found.replay.orientation_from_start_deg,
    }


_BY_KIND = (("tangent", "tangent"), ("circle", "tangent_circle"), ("peak", "peak"))


def _of(found: ContactMeasures, name: str, kind: str) -> float | None:
    """Largest value of a field among the end-effectors of a kind; None where none of them is in contact."""
    return found.largest(name, kind) if found.surfaces(kind) else None


#: Statuses of plans that are handed out as such.
_CLAIMED = ("solved", "acceptable")

#: Fields of a row, the field of a demand that limits them, and how they are called.
_LIMITED = (
    ("cost", "cost", "J"),
    ("tangent_foot", "tangent", "tangential over normal force of a foot"),
    ("tangent_hand", "tangent", "tangential over normal force of a hand"),
    ("pressure_off_sole_m", "pressure_m", "centre of pressure beyond the sole [m]"),
    ("pressure_off_surface_m", "pressure_m", "centre of pressure off the surface [m]"),
    ("slip_m", "slip_m", "slip [m]"),
    ("reach_m", "reach_m", "reach in contact exceeded by [m]"),
    ("swing_stiffness", "swing_stiffness", "stiffness of a swinging end-effector"),
    ("momentum_Nms", "momentum_Nms", "angular momentum [N m s]"),
    ("peak_hand", "hand_peak", "force of a hand over the weight"),
    ("com_replay_m", "com_replay_m", "replayed CoM [m]"),
    ("momentum_replay_Nms", "momentum_replay_Nms", "replayed angular momentum [N m s]"),
    ("orientation_deg", "orientation_deg", "replayed base [deg]"),
)


def shortfalls(row: Row, demand: Demand) -> list[str]:
    """Which demands a row does not meet, in words; empty: it meets all. A tangent without contact has no demand."""
    solved = row.status == "solved"
    if demand.solved is True and not solved:
        return [f"{row.status}: {row.message}".rstrip(": ")]
    if demand.hands_only is False and row.hands_only and row.status in _CLAIMED:
        return ["claims a phase on hands alone"]
    if not solved:  # it claims nothing else that could be wrong
        return []
    if demand.solved is False:
        return [f"is solved, with J {row.cost:.3g}"]
    found = []
    for name, limit, words in _LIMITED:
        value, max_value = getattr(row, name), getattr(demand, limit)
        if max_value < float("inf") and value is not None and not value <= max_value:
            found.append(f"{words} {value:.3g}, at most {max_value:g}")
    if demand.flights is not None and row.flights != demand.flights:
        found.append(f"{row.flights} flights, not {demand.flights}")
    if demand.alternate and not row.alternate:
        found.append("feet do not alternate")
    if demand.every_surface and row.missed:
        found.append(f"no foot on {row.missed}")
    if demand.hands_only is True and not row.hands_only:
        found.append("no phase on hands alone")
    if demand.hand_mean_off < float("inf"):
        found += _hand_means(row, demand.hand_mean_off)
    return found


def _hand_means(row: Row, max_value: float) -> list[str]:
    """The vertical forces' means of both hands while they support the whole weight, against half of it each."""
    if row.hand_mean_low is None or row.hand_mean_high is None:
        return ["no phase on both hands alone"]
    off = max(abs(row.hand_mean_low - HAND_MEAN), abs(row.hand_mean_high - HAND_MEAN)) / HAND_MEAN
    means = f"{row.hand_mean_low:.3f} to {row.hand_mean_high:.3f}"
    return (
        [f"hands support {means} of the weight in the mean, 0.5 within {100 * max_value:g} %"]
        if off > max_value
        else []
    )


def line(row: Row) -> str:
    """A row in a few words."""
    head = f"{row.case}: {row.status}"
    if row.time_s is not None:
        head += f" in {row.time_s:.2f} s"
    if row.cost is not None:
        head += f", J {row.cost:.3g}, L {row.momentum_Nms:.1f} N m s"
        tangents = [f"{value:.3f}" for value in (row.tangent_foot, row.tangent_hand) if value is not None]
        head += f", tangents {' / '.join(tangents)}"
    return head if row.holds else f"{head}, DOES NOT HOLD: {row.why}"


def settings_summary(rows: Sequence[Row]) -> dict[str, Any]:
    """How many settings find a plan on hands alone, and what the best of these plans costs."""
    costs = [row.cost for row in rows if row.status == "solved" and row.hands_only and row.cost is not None]
    min_cost = float(min(costs)) if costs else None
    return {
        "runs": len(rows),
        "solved": sum(row.status == "solved" for row in rows),
        "hands_only": len(costs),
        "min_cost": min_cost,
        "median_cost": float(np.median(costs)) if costs else None,
        "hold_contacts": sum(bool(row.holds) for row in rows),
        "holds": min_cost is not None and min_cost <= RAIL_COST and len(costs) >= RAIL_GOOD,
    }


def compare_speed(
    repeats: int = 5,
    names: Sequence[str] = SCENES,
    models: Sequence[str] = ("wrench", "lipm"),
    progress: Callable[[str], None] | None = None,
) -> list[dict[str, Any]]:
    """Processor times per iteration of two models, on one thread, alternating on each scene.

    Args:
        repeats: Solves behind each median.
        names: Scenes.
        models: Ours and the one to compare with.
        progress: Called with a line for each scene.

    Returns:
        Rows with the times of the iterations with the sequence free and of all iterations of a plan [ms], and their ratios.
    """
    import mcplan

    robot = mcplan.load_robot("humanoid44")
    rows = []
    for name in names:
        scene = mcplan.load_scene(name)
        row: dict[str, Any] = {"scene": name}
        times: dict[str, list[tuple[float, float, float]]] = {"ours": [], "other": []}
        for _ in range(repeats):  # alternating: what else the machine does affects both
            for key, model in zip(times, models, strict=True):
                times[key].append(_iteration_times_ms(scene, robot, {"model": model} if model else {}))
        for key, model in zip(times, models, strict=True):
            search, whole, plan = np.median(times[key], axis=0)
            row |= {f"{key}_model": model, f"{key}_ms": float(search), f"{key}_all_ms": float(whole)}
            row[f"{key}_plan_ms"] = float(plan)
        row["ratio"] = row["ours_ms"] / row["other_ms"]
        row["ratio_all"] = row["ours_all_ms"] / row["other_all_ms"]
        row["holds"] = max(row["ratio"], row["ratio_all"]) <= RATIO and row["ours_ms"] <= ITERATION_MS
        rows.append(row)
        if progress is not None:
            progress(f"{name}: {row['ours_ms']:.3f} ms, {row['ratio']:.2f} times {row['other_ms']:.3f} ms")
    return rows


def _iteration_times_ms(scene: Scene, robot: Robot, options: dict[str, Any]) -> tuple[float, float, float]:
    """An iteration with the sequence free, one of all those of a plan, and the whole plan [ms of the processor]."""
    (whole, (found,)), processor_ratio = _with_processor_ratio(lambda: iterations(scene, robot, 1, options))
    limits = {"max_iterations": searching_iterations(found.report), "restarts": 0}
    (search, _), search_ratio = _with_processor_ratio(lambda: iterations(scene, robot, 1, options | limits))
    return search_ratio * search.ms, processor_ratio * whole.ms, processor_ratio * 1e3 * found.report.time_s


def _with_processor_ratio(function: Callable[[], Outcome]) -> tuple[Outcome, float]:
    """What a function returns, and the ratio of this process's processor time to the wall clock, at most 1.

    Reports time by the wall clock; this takes out of it what other processes had meanwhile.
    """
    wall, processor = time.perf_counter(), time.process_time()
    outcome = function()
    return outcome, min(1.0, (time.process_time() - processor) / (time.perf_counter() - wall))
