"""Plans of all three planners tracked in simulation: a row for each, and whether it meets its demands."""

from __future__ import annotations

import copy
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.errors import InvalidInput

from .criteria import flights
from .processes import each
from .tracking_cases import Case, Demand

if TYPE_CHECKING:
    from mcplan import Plan, PlanarPlan, Scene
    from mcplan.model import EndEffector
    from mcplan.planar.tracking import PlanarResult
    from mcplan.tracking import Options, Recording, TrackingResult

#: What is done with a run in the process in which it was made, e.g. draw it.
Keep = Callable[[Case, "TrackingResult | PlanarResult"], None]

#: A torque of this ratio to its limit is at it.
AT_LIMIT = 0.999

#: Statuses of plans that are tracked.
TRACKED = ("solved", "acceptable")


@dataclass(frozen=True)
class Planned:
    """A plan and how it was found."""

    plan: Plan | PlanarPlan
    status: str
    message: str
    time_s: float


@dataclass(frozen=True)
class Row:
    """A case and what came of it; None: does not apply, or was not reached. Measures are those of mcplan.tracking.

    Attributes:
        case, planner, robot, scale, assisted: What was asked for.
        planned, message, planning_s: Status of the plan, what the planner says of it, time to find it.
        steps, flights: Swings of feet, and stretches without contact, in the plan.
        duration_s: Duration of the plan.
        mass_planned_kg, mass_kg: Mass of the robot in the plan, and of the simulated one.
        fell: It fell; or, of a planar robot, left its plan.
        torque_joint: The joint with the largest torque over its limit.
        velocity_joint: The joint with the largest speed over its limit.
        leg_torque_use, leg_torque_joint: The same among the joints that carry feet.
        leg_limit_ratio: Fraction of the time in which the torque of one of these is at its limit.
        holds: Whether the row meets its demands; None: it has none.
        why: Which demands it does not meet.
    """

    case: str
    planner: str
    robot: str
    scale: float
    assisted: bool
    planned: str = ""
    message: str = ""
    planning_s: float | None = None
    steps: int | None = None
    flights: int | None = None
    duration_s: float | None = None
    mass_planned_kg: float | None = None
    mass_kg: float | None = None
    fell: bool | None = None
    completed_s: float | None = None
    com_rms_m: float | None = None
    com_max_m: float | None = None
    final_base_error_m: float | None = None
    orientation_rms_deg: float | None = None
    swing_rms_m: float | None = None
    slip_m: float | None = None
    torque_use: float | None = None
    torque_joint: str = ""
    velocity_use: float | None = None
    velocity_joint: str = ""
    torque_step_use: float | None = None
    self_contacts: int | None = None
    self_contact_N: float | None = None
    self_contact_m: float | None = None
    terrain_contacts: int | None = None
    terrain_contact_N: float | None = None
    leg_torque_use: float | None = None
    leg_torque_joint: str = ""
    leg_limit_ratio: float | None = None
    assist_force_rms_N: float | None = None
    assist_moment_rms_Nm: float | None = None
    force_rms: float | None = None
    drift_m: float | None = None
    qp_failures: int | None = None
    simulator_warnings: int | None = None
    realtime_factor: float | None = None
    control_ms: float | None = None
    holds: bool | None = None
    why: str = ""

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON and CSV."""
        return asdict(self)


@dataclass(frozen=True)
class Task:
    """A case, what is done with its run, and who is told that planning and tracking begin."""

    case: Case
    keep: Keep | None = None
    progress: Callable[[str], None] | None = None


def table(
    cases: Sequence[Case], jobs: int = 1, progress: Callable[[str], None] | None = None, keep: Keep | None = None
) -> list[Row]:
    """Plan and track all cases.

    Args:
        cases: E.g. CASES or SHORT of ``tracking_cases``.
        jobs: Processes; more than the machine has cores make times longer.
        progress: Called with a line for each case that is begun or done.
        keep: Called with each case and its run. With several processes both are functions of modules: they are sent there.

    Returns:
        Rows in the order of the cases.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed.
    """
    rows: dict[int, Row] = {}
    for index, row in each(_solve, [Task(case, keep, progress) for case in cases], jobs):
        rows[index] = row
        if progress is not None:
            progress(f"[{len(rows)}/{len(cases)}] {line(row)}")
    return [rows[i] for i in range(len(cases))]


def _solve(task: Task) -> Row:
    if task.progress is not None:
        task.progress(f"{task.case.name}: planning ({task.case.planner}), then tracking")
    row, run = solve(task.case)
    if task.keep is not None and run is not None:
        task.keep(task.case, run)
    return row


def solve(case: Case) -> tuple[Row, TrackingResult | PlanarResult | None]:
    """Plan and track a case. Without a plan within its constraints there is no run."""
    values: dict[str, Any] = {"case": case.name, "planner": case.planner, "robot": case.robot}
    values |= {"scale": case.scale, "assisted": case.assist}
    found = plan_of(case)
    values |= {"planned": found.status, "message": found.message, "planning_s": found.time_s}
    run = None
    if found.status in TRACKED:
        values |= described(found.plan)
        try:
            run = track_plan(case, found.plan)
            values |= measured(run)
        except InvalidInput as refused:
            values["message"] = str(refused)
    return judged(Row(**values), case.demand), run


def plan_of(case: Case) -> Planned:
    """Plan a case.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed meanwhile.
    """
    import mcplan
    from mcplan.files.scenes import scaled
    from mcplan.planar.tracking import with_clearances

    began = time.perf_counter()
    found: Any
    if case.planner == "sip":
        task = mcplan.load_planar_task(case.scene)
        found = mcplan.whole_body(with_clearances(task) if case.clearances else task, **case.planning)
    else:
        scene = scaled(mcplan.load_scene(case.scene), case.scale)
        if case.gap_m:
            scene = with_gap(scene, case.gap_m)
        robot = mcplan.load_robot(case.planned_for or case.robot)
        if case.strong_hands:
            robot.end_effectors = [_strong(end) for end in robot.end_effectors]
        solver: Any = mcplan.walk if case.planner == "rhp" else mcplan.plan
        found = solver(scene, robot, **case.planning)
    status = str(found.report.status)
    worst = found.report.worst_violation
    message = (
        "" if status in TRACKED else "; ".join(filter(None, [found.report.message, str(worst) if worst.name else ""]))
    )
    return Planned(found.plan, status, message, time.perf_counter() - began)


def with_gap(scene: Scene, width_m: float) -> Scene:
    """A scene whose surfaces `before` and `after` are so far apart along x, the goal moved with the latter."""
    wider = copy.deepcopy(scene)
    surfaces = list(wider.surfaces)
    before, after = (surfaces[wider.surface_index(name)] for name in ("before", "after"))
    edge = np.asarray(after.vertices_W)[:, 0].min()
    shift = np.array([np.asarray(before.vertices_W)[:, 0].max() + width_m - edge, 0.0, 0.0])
    after.vertices_W = np.asarray(after.vertices_W) + shift
    wider.surfaces = surfaces
    goal = wider.goal
    goal.position_W = goal.position_W + shift
    wider.goal = goal
    return wider


def _strong(end: EndEffector) -> EndEffector:
    if end.kind == "hand":
        end.max_force = np.inf
    return end


def described(plan: Plan | PlanarPlan) -> dict[str, Any]:
    """Fields of a row that a plan determines."""
    from mcplan import Plan

    if not isinstance(plan, Plan):
        return {"duration_s": plan.duration(), "mass_planned_kg": plan.task.robot.mass()}
    feet = {i for i, end in enumerate(plan.robot.end_effectors) if end.kind == "foot"}
    return {
        "duration_s": plan.duration(),
        "mass_planned_kg": plan.robot.mass,
        "steps": sum(swing.end_effector in feet for swing in plan.swings),
        "flights": len(flights(plan.contact_sequence())),
    }


def track_plan(case: Case, plan: Any, options: Options | None = None) -> TrackingResult | PlanarResult:
    """Track a plan as its case asks for.

    Raises:
        InvalidInput: The robot cannot take up the plan's first posture.
        KeyboardInterrupt: Ctrl-C was pressed meanwhile.
    """
    from mcplan.planar.tracking import track_whole_body
    from mcplan.tracking.options import Options
    from mcplan.tracking.runner import track

    result: TrackingResult | PlanarResult
    if case.planner == "sip":
        result = track_whole_body(plan, options)
    else:
        result = track(plan, case.robot, options or Options(assist=case.assist))
    return result


def measured(run: TrackingResult | PlanarResult) -> dict[str, Any]:
    """Fields of a row that a run determines."""
    from mcplan.planar.tracking import measures as planar_measures
    from mcplan.tracking import TrackingResult
    from mcplan.tracking.report import nearest_to_velocity_limit

    own = {item.name for item in fields(Row)}
    measures: Any = run.measures
    values = {name: value for name, value in measures.as_dict().items() if name in own}
    if not isinstance(run, TrackingResult):
        use = np.abs(run.recording.torques).max(axis=0) / run.recording.torque_limits
        values["torque_joint"] = run.recording.joints[int(use.argmax())]
        values["velocity_joint"] = planar_measures.nearest_to_velocity_limit(run.recording)[0]
        return values | {"fell": not run.measures.completed, "mass_kg": run.recording.plan.task.robot.mass()}
    values["velocity_joint"] = nearest_to_velocity_limit(run.recording)[0]
    return values | _torques(run.recording) | {"mass_kg": float(run.recording.simulated_robot.mass)}


def _torques(recording: Recording) -> dict[str, Any]:
    """The joints with the largest torques over their limits, of all and of the legs."""
    from mcplan.kinematics.urdf_model import load_model

    urdf_model = load_model(recording.simulated_robot)
    legs: set[str] = set()
    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        if end.kind == "foot":
            chain = urdf_model.model.supports[urdf_model.model.frames[frame].parentJoint]
            legs |= {urdf_model.model.names[joint] for joint in chain}
    use = np.abs(recording.torques) / recording.torque_limits
    of_legs = np.where([name in legs for name in recording.joints], use, 0.0)
    max_use, max_of_legs = use.max(axis=0), of_legs.max(axis=0)
    return {
        "torque_joint": recording.joints[int(max_use.argmax())],
        "leg_torque_use": float(max_of_legs.max()),
        "leg_torque_joint": recording.joints[int(max_of_legs.argmax())],
        "leg_limit_ratio": float(np.mean(of_legs.max(axis=1) > AT_LIMIT)),
    }


def judged(row: Row, demand: Demand | None) -> Row:
    """The row with `holds` and `why`."""
    if demand is None:
        return row
    found = shortfalls(row, demand)
    return Row(**{**row.as_dict(), "holds": not found, "why": "; ".join(found)})


#: Field, how it is called, factor to the unit that people read, unit.
_LIMITED = (
    ("com_rms_m", "CoM rms", 1e3, " mm"),
    ("final_base_error_m", "base at the end", 1e3, " mm"),
    ("force_rms", "contact forces", 1e2, " %"),
    ("drift_m", "drift", 1e3, " mm"),
    ("qp_failures", "QP failures", 1, ""),
    ("simulator_warnings", "warnings", 1, ""),
)


def shortfalls(row: Row, demand: Demand) -> list[str]:
    """Which demands a row does not meet, in words; empty: it meets all."""
    if row.planned not in TRACKED:
        return [] if demand.refusable else [f"not planned: {row.planned}, {row.message}".rstrip(", ")]
    if row.fell is None:
        return [f"not tracked: {row.message}"]
    found = []
    for name in ("steps", "flights"):
        min_count, value = getattr(demand, name), getattr(row, name) or 0
        if value < min_count:
            found.append(f"{value} {name}, at least {min_count}")
    if row.fell:
        found.append(f"{'left its plan' if row.planner == 'sip' else 'fell'} at {row.completed_s:.2f} s")
    for name, words, factor, unit in _LIMITED:
        max_value, value = getattr(demand, name), getattr(row, name)
        if max_value < float("inf") and (value is None or not value <= max_value):
            has = "not measured" if value is None else f"{factor * value:.4g}"
            found.append(f"{words} {has}, at most {factor * max_value:g}{unit}")
    return found


def line(row: Row) -> str:
    """A row in a few words."""
    if row.fell is None:
        head = f"{row.case}: {row.planned} in {row.planning_s or 0.0:.1f} s, not tracked"
    else:
        head = f"{row.case}: {row.planned} in {row.planning_s or 0.0:.1f} s, "
        head += f"{'fell' if row.fell else 'up'} at {row.completed_s:.2f} s, "
        if row.force_rms is not None:
            head += f"contact forces {100 * row.force_rms:.1f} %, drift {1e3 * (row.drift_m or 0.0):.1f} mm"
        else:
            head += f"CoM {1e3 * (row.com_rms_m or 0.0):.1f} mm rms"
    return head if row.holds is not False else f"{head}, DOES NOT HOLD: {row.why}"
