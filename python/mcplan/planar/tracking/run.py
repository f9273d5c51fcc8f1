"""Run a whole-body plan in MuJoCo by the plan's torques and weak feedback on the joints, with no force on the base."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.errors import InvalidOptions
from mcplan.tracking.interruption import Interruption
from mcplan.tracking.options import Options

from .measures import measure
from .mjcf import build
from .recording import Array, PlanarRecording
from .result import PlanarResult
from .settings import ContactSettings, Feedback
from .simulation import PlanarSimulation

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan, PlanarState

#: A robot that is further than this from its plan has left it: base [m], base and joints [rad].
LEFT_PLAN_M = 0.1
LEFT_PLAN_RAD = 0.3

#: Half the simulation step changes force_rms by at most 0.011 (docs/tracking_planar.md); 1 ms doubles or triples it.
DEFAULT_OPTIONS = Options(simulation_step_s=2e-4, control_step_s=4e-4, speed_limits=False, self_contacts=False)


#: Options that planar robots have not, and the values by which they are off.
_ABSENT: dict[str, object] = {"pushes": (), "assist": False, "seed": 0}
_ABSENT |= dict.fromkeys(("torque_bandwidth_hz", "torque_delay_s", "sensor_noise"), 0.0)


def track_whole_body(
    plan: PlanarPlan,
    options: Options | None = None,
    feedback: Feedback | None = None,
    contacts: ContactSettings | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> PlanarResult:
    """Let MuJoCo's robot follow a whole-body plan, unassisted.

    The robot starts in the plan's state. From then on its motors get the torques of the plan at each control step, to which
    a weak feedback on the joints is added. A run ends `hold_s` after the plan, or where the robot has left it: its base by
    0.1 m or 0.3 rad, or a joint by 0.3 rad.

    Args:
        plan: A plan of a planar robot. ``prepare`` says how to plan so that a robot can follow.
        options: Steps, `hold_s` and the deviations that the plan does not know of: `mass_scale`, `friction_scale`,
            `ground_shift_m` (a start in the ground then throws the robot). Default: DEFAULT_OPTIONS.
        feedback: Feedback on the joints; default: Feedback().
        contacts: Hardness of the contacts; default: ContactSettings().
        progress: Called now and then with the time simulated and the time to simulate [s].

    Ctrl-C ends the run with Interrupted, which carries the result.

    Raises:
        InvalidOptions: Out of range, or asking for what planar robots have not: pushes, assistance, random disturbances.
        InvalidPlan, InvalidPlanarTask, InvalidRobot: The plan is malformed.
        MissingExtra: MuJoCo is not installed.
    """
    options = options or DEFAULT_OPTIONS
    _require_supported(options)
    options = replace(options, speed_limits=False, self_contacts=False)  # planar robots have neither
    plan.validate()
    model = build(plan.task, options, contacts, feedback)
    simulation = PlanarSimulation(model)
    simulation.reset(plan.at(0.0).configuration)
    start = time.perf_counter()
    with Interruption() as stop:
        rows, left = _run(simulation, plan, options, stop, progress)
    wall_clock_s = time.perf_counter() - start
    recording = _recording(plan, rows, left)
    measures = measure(recording, simulation.warnings, wall_clock_s)
    result = PlanarResult(recording, measures, options, stop.asked)
    stop.raise_with(result)
    return result


def _require_supported(options: Options) -> None:
    options.validate()
    for name, empty in _ABSENT.items():
        value = getattr(options, name)
        if value != empty:
            raise InvalidOptions(name, f"must be {empty} for planar robots", str(value))


def _run(
    simulation: PlanarSimulation,
    plan: PlanarPlan,
    options: Options,
    stop: Interruption,
    progress: Callable[[float, float], None] | None,
) -> tuple[list[dict[str, Any]], float]:
    """What is recorded of each control step, and when the robot left the plan (infinite: never)."""
    duration = plan.duration()
    steps = round(options.control_step_s / options.simulation_step_s)
    rows: list[dict[str, Any]] = []
    count = round((duration + options.hold_s) / options.control_step_s) + 1
    for k in range(count):
        now = k * options.control_step_s
        state = plan.at(min(now, duration))
        rows.append({"times_s": now, "phases": state.phase, **_control(simulation, state)})
        if _has_left(rows[-1]):
            return rows, now
        if stop.asked:
            break
        simulation.advance(steps)
        if progress is not None and k % 100 == 0:
            progress(now, count * options.control_step_s)
    return rows, float("inf")


def _control(simulation: PlanarSimulation, state: PlanarState) -> dict[str, Any]:
    """Apply the torques of an instant; what is to be recorded of it."""
    asked = state.configuration
    at, velocity = simulation.positions, simulation.velocities
    back = simulation.apply(state.torque, asked.q, asked.velocity)
    points, forces = simulation.points_W(), simulation.forces_W()
    forces_plan, contact_points, surfaces = _planned(simulation, state, np.isnan(points))
    return {
        "base": at[:3],
        "base_plan": asked.base,
        "base_velocity": velocity[:3],
        "base_velocity_plan": asked.base_velocity,
        "q": at[3:],
        "q_plan": asked.q,
        "velocity": velocity[3:],
        "velocity_plan": asked.velocity,
        "torques": simulation.applied_torques(),
        "feedforward": state.torque,
        "feedback": back,
        "points_W": points,
        "points_contact_W": contact_points,
        "forces_W": forces,
        "forces_plan_W": forces_plan,
        "surfaces_plan": surfaces,
    }


def _planned(simulation: PlanarSimulation, state: PlanarState, absent: Any) -> tuple[Array, Array, Any]:
    """Of the plan at an instant: forces (e, p, 2), points where contacts put them (e, p, 2), surfaces (e,)."""
    task = simulation.model.task
    forces = np.where(absent, np.nan, 0.0)
    for force in state.forces:
        forces[force.end_effector, force.point] = force.force_W
    points = np.full(absent.shape, np.nan)
    surfaces = np.full(len(absent), -1)
    for contact in task.phases[state.phase].contacts:
        e = contact.end_effector
        along = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        for i, point in enumerate(task.robot.end_effectors[e].points):
            points[e, i] = contact.position_W + point * along
        surfaces[e] = contact.surface
    return forces, points, surfaces


def _has_left(row: dict[str, Any]) -> bool:
    off = np.abs(row["base"] - row["base_plan"])
    joints = np.abs(row["q"] - row["q_plan"])
    stays = np.hypot(off[0], off[1]) < LEFT_PLAN_M and max(off[2], joints.max()) < LEFT_PLAN_RAD
    return not stays  # what is not a number has left, too


def _recording(plan: PlanarPlan, rows: list[dict[str, Any]], left_plan_at_s: float) -> PlanarRecording:
    robot = plan.task.robot
    return PlanarRecording(
        plan=plan,
        joints=tuple(body.name for body in robot.bodies[1:]),
        end_effectors=tuple(end.name for end in robot.end_effectors),
        torque_limits=np.array([body.torque_max for body in robot.bodies[1:]]),
        left_plan_at_s=left_plan_at_s,
        **{name: np.array([row[name] for row in rows]) for name in rows[0]},
    )
