"""The loop: plan, controller, simulation, recording."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, Robot
from mcplan.arguments import require_or_path
from mcplan.errors import InvalidInput, InvalidRobot, shown
from mcplan.extras import require
from mcplan.files.robots import list_robots_with
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample_at
from mcplan.kinematics.urdf_model import UrdfModel

from .assist import assistance
from .disturbances import disturbed
from .interruption import Interruption
from .joint_references import JointReferences
from .measures import at_torque_limit, measure, with_touches
from .motion_references import motion_references
from .options import Options, Watch, require_watch
from .postures import postures_along
from .recorder import Acting, Recorder
from .references import References, references
from .result import TrackingResult
from .robot_dynamics import RobotDynamics
from .sensors import Sensors
from .separation import Separation

if TYPE_CHECKING:
    from mcplan.wb import Motion

    from .simulation import Simulation

Array = NDArray[np.float64]

#: An end-effector is taken to be in contact above this ratio of its force to the robot's weight.
CONTACT_RATIO = 0.01
#: Fallen: ratio of the CoM's distance from the plan to its height, or angle of the base from the plan's [rad].
FALLEN_RATIO, FALLEN_RAD = 0.35, 1.0
#: [m] by which the first posture may miss the plan.
START_MISS = 0.03


@dataclass(frozen=True)
class _Trial:
    """What is tracked by what: the plan, its references, those of joints, the first and last configuration, options."""

    plan: Plan
    urdf_model: UrdfModel
    desired: References
    joints: JointReferences
    start: Array
    end: Array
    options: Options


def track(
    plan: Plan | Motion | str | Path,
    robot: Robot | str | Path | None = None,
    options: Options | None = None,
    progress: Callable[[float, float], None] | None = None,
    watch: Watch | None = None,
) -> TrackingResult:
    """Track a plan or a motion with a simulated robot, which its torques alone move, within their limits.

    Args:
        plan: A plan of `ddp` or `rhp`, a motion along one, or the path of either.
        robot: A robot with a URDF and the plan's end-effectors by name; None: the plan's own. A motion takes no other.
        options: Options of the run.
        progress: Called now and then with the time simulated and the time to simulate [s].
        watch: Called at every control step with the simulated time [s], the configuration (nq,) in Pinocchio's order and
            the plan that is followed, as ``mcplan.view.LiveView`` is.

    Returns:
        What the robot did, and how well. A fall ends the run and is a result, not an exception. Ctrl-C ends it with
        Interrupted, which carries the result.

    Raises:
        MissingExtra: The packages of ``pip install 'mcplan[sim]'`` are not installed.
        InvalidOptions: An option is out of range, or a push does not act in the run.
        InvalidPlan: The file is no plan.
        InvalidRobot: The robot has no URDF, or it cannot be read, or it lacks an end-effector of the plan.
        InvalidInput: The robot cannot take up the plan's first or last posture.
    """
    require("mcplan.tracking", "sim", "mujoco", "pinocchio", "proxsuite")
    options = options or Options()
    options.validate()
    require_watch(watch)
    followed = _loaded(plan)
    plan = followed if isinstance(followed, Plan) else followed.plan
    options.require_pushes_within(plan.duration() + options.hold_s)
    tracked_robot = robot_for(plan, robot) if isinstance(followed, Plan) else _own_robot(followed, robot)
    if options.seed:
        options = disturbed(options, options.seed, plan.duration(), tracked_robot.mass)
    from . import mujoco_model
    from .simulation import Simulation

    model = mujoco_model.build(tracked_robot, plan.scene, options)
    simulation = Simulation(model, options.torque_delay_s, options.torque_bandwidth_hz)
    make = _plan_trial if isinstance(followed, Plan) else _motion_trial
    trial = make(followed, model.urdf_model, options)  # type: ignore[arg-type]
    on_ground = trial.start.copy()
    on_ground[2] += options.ground_shift_m
    simulation.reset(on_ground, np.zeros(model.urdf_model.model.nv))
    with Interruption() as stop:
        result = _run(trial, simulation, stop, progress, watch)
    stop.raise_with(result)
    return result


def _plan_trial(plan: Plan, urdf_model: UrdfModel, options: Options) -> _Trial:
    desired = references(plan, urdf_model.robot, options.control_step_s, options.hold_s)
    start, end = posture_at(urdf_model, plan, 0.0), posture_at(urdf_model, plan, desired.duration_s)
    posture = start
    if any(phase.has_points for phase in plan.phases):
        # Such plans know nothing of the base: its rotation has to suit the legs.
        posture = postures_along(urdf_model, plan, desired.count, options.control_step_s)
        desired = desired.with_base(posture[:, 3:7])
        end = posture[-1]
    return _Trial(plan, urdf_model, desired, JointReferences.of_posture(posture), start, end, options)


def _motion_trial(motion: Motion, urdf_model: UrdfModel, options: Options) -> _Trial:
    desired, joints, (start, end) = motion_references(motion, options.control_step_s, options.hold_s)
    return _Trial(motion.plan, urdf_model, desired, joints, start, end, options)


def _own_robot(motion: Motion, robot: Robot | str | Path | None) -> Robot:
    """The robot of a motion's URDF, with the plan's end-effectors."""
    if robot is not None:
        name = robot.name if isinstance(robot, Robot) else str(robot)
        raise InvalidInput("robot", "must not be given with a motion, which has its own joints", shown(name))
    own: Robot = motion.model.complete.robot
    return own


def robot_for(plan: Plan, robot: Robot | str | Path | None) -> Robot:
    """The robot with the plan's end-effectors, in the plan's order.

    Raises:
        InvalidRobot: It lacks one; or as load_robot.
        UnknownRobot: As load_robot.
    """
    if robot is None:
        return plan.robot
    if not isinstance(robot, Robot):
        from mcplan.files.robots import load_robot

        require_or_path("robot", robot, "a Robot", "a name", optional=True)
        robot = load_robot(robot)
    own = {end.name: end for end in robot.end_effectors}
    for end in plan.robot.end_effectors:
        if end.name not in own:
            others = list_robots_with([e.name for e in plan.robot.end_effectors], joints=True)
            take = f", as {', '.join(others)} have" if others else ""
            rule = f"must have the plan's {end.name!r}{take}"
            raise InvalidRobot("end_effectors", rule, ", ".join(own) or "none", robot.name)
    ordered = robot.__copy__()
    ordered.end_effectors = [own[end.name] for end in plan.robot.end_effectors]
    return ordered


def _loaded(plan: Plan | Motion | str | Path) -> Plan | Motion:
    from mcplan.wb import Motion
    from mcplan.wb.loading import load_any

    if isinstance(plan, (Plan, Motion)):
        return plan
    found = load_any(Path(plan))
    if not isinstance(found, (Plan, Motion)):
        raise InvalidInput("plan", "must be a plan of ddp or rhp, or a motion", f"{plan}, a whole-body plan")
    return found


def posture_at(urdf_model: UrdfModel, plan: Plan, time_s: float) -> Array:
    """The configuration (nq,) in which a robot follows a plan at a time [s].

    Raises:
        InvalidInput: It cannot, by more than START_MISS.
    """
    postures = follow(urdf_model, sample_at(plan, plan.scene, plan.robot, np.array([time_s])))
    if postures.residual > START_MISS:
        raise InvalidInput(
            "plan",
            f"must be in reach of {urdf_model.robot.name}",
            f"{postures.where} is missed by {postures.residual:.3f} m",
        )
    return postures.configurations[0]


def _run(
    trial: _Trial,
    simulation: Simulation,
    stop: Interruption,
    progress: Callable[[float, float], None] | None,
    watch: Watch | None,
) -> TrackingResult:
    from .controller import Controller, Restraints

    urdf_model, desired, options = trial.urdf_model, trial.desired, trial.options
    separation = Separation(simulation.model) if options.self_contacts else None
    restraints = Restraints(simulation.model.motors, separation)
    controller = Controller(urdf_model, trial.plan.scene, desired, trial.joints, options.gains, restraints)
    recorder = Recorder(trial.plan, urdf_model, simulation.model.joints, desired)
    sensors, actual = Sensors(options.sensor_noise, options.noise_seed), RobotDynamics(urdf_model)
    contact_N = CONTACT_RATIO * actual.mass * trial.plan.scene.gravity
    steps = round(options.control_step_s / options.simulation_step_s)
    fell_at, failures, control_s, began = np.inf, 0, 0.0, time.perf_counter()
    n = 0
    for n in range(desired.count):
        now = n * desired.dt_s
        state = simulation.state()
        forces, touches = simulation.contact_forces_W(), simulation.touches()
        tick = time.perf_counter()
        in_contact = np.linalg.norm(forces, axis=1) > contact_N
        command = controller.step(n, *sensors.read(*state), in_contact)
        control_s += time.perf_counter() - tick
        failures += not command.solved
        dynamics = controller.dynamics
        if options.sensor_noise > 0.0:  # what is recorded is what the robot does, not what the controller reads
            dynamics = actual
            dynamics.update(*state)
        push = sum((p.force_W(now, desired.dt_s) for p in options.pushes), np.zeros(3))
        assist_W = assistance(dynamics, desired, n) if options.assist else np.zeros(6)
        given = simulation.advance(command.torques, assist_W + np.concatenate([push, np.zeros(3)]), steps)
        recorder.add(dynamics, Acting(given, forces, in_contact, assist_W, push, touches))
        if simulation.broke or _fallen(dynamics.com_W, dynamics.base_WB, desired, n, urdf_model.robot):
            fell_at = now
            break
        if stop.asked:
            break
        if watch is not None:
            watch(now, state[0], trial.plan)
        if progress is not None and n % 50 == 0:
            progress(now, desired.count * desired.dt_s)
    wall = time.perf_counter() - began
    recording = recorder.finish(fell_at)
    measures = measure(recording, trial.end)
    if simulation.model.link_pairs:
        measures = with_touches(measures, recording.touches)
    measures = replace(
        measures,
        qp_failures=failures,
        simulator_warnings=simulation.warnings,
        realtime_factor=(n + 1) * desired.dt_s / wall,
        control_ms=1e3 * control_s / (n + 1),
        leg_torque_limit_ratio=float(at_torque_limit(recording)[:, controller.legs].any(axis=1).mean()),
    )
    return TrackingResult(recording, measures, options, stop.asked)


def _fallen(com_W: Array, base_WB: Array, desired: References, n: int, robot: Robot) -> bool:
    off = com_W - desired.com_W[n]
    cosine = 0.5 * (float(np.vdot(desired.base_WB[n], base_WB)) - 1.0)  # of the angle between the two
    return math.sqrt(float(off @ off)) > FALLEN_RATIO * robot.com_height or cosine < math.cos(FALLEN_RAD)
