"""Multi-contact motion planning for legged robots.

    import mcplan as mp

    scene = mp.load_scene("gap_with_rail")
    robot = mp.load_robot("humanoid44")
    result = mp.plan(scene, robot, time_limit=1.0)
    print(result.report)
    mp.check(result.plan, scene, robot).raise_if_violated()
    result.plan.save("plan.npz")
    mp.show(result.plan, scene, robot).save_html("plan.html")
    motion = mp.motion(mp.plan("flat", "talos").plan).motion

Verbs, engines and what they are about are here; ``mcplan.model`` has what scenes, robots and plans are made of,
``mcplan.errors`` each error. The engines ``ddp``, ``rhp`` and ``sip`` have their options, a solve and its result: ``plan`` is
``ddp.plan``, ``walk`` is ``rhp.walk``, ``whole_body`` is ``sip.plan``; ``mcplan.wb`` has motions of robots in space.
``mcplan.ipm`` is the solver behind them, for problems of one's own.

Importing this loads NumPy and nothing heavier; the rest comes when first used.
"""

from __future__ import annotations

from mcplan import starting as _starting  # noqa: F401  first: Ctrl-C while the command loads

# isort: split
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan import ddp, moved, rhp, sip
from mcplan import errors as errors
from mcplan import ipm as ipm
from mcplan import model as model
from mcplan import notebooks as _notebooks  # noqa: F401  _repr_html_ of plans and results
from mcplan import samples as _samples  # noqa: F401  Plan.sample
from mcplan._core import (
    Plan,
    PlanarPlan,
    PlanarRobot,
    PlanarTask,
    PlanarTolerances,
    Robot,
    Scene,
    Status,
    Tolerances,
    __version__,
)
from mcplan.checking import check
from mcplan.ddp import plan, replan
from mcplan.errors import Interrupted, InvalidInput, MissingExtra, PlanViolated, UnknownName
from mcplan.export import export
from mcplan.files import methods as _methods  # noqa: F401  Plan.save and Plan.load
from mcplan.loading import load_planar_robot, load_planar_task, load_robot, load_scene
from mcplan.rhp import receding_horizon, walk
from mcplan.showing import show
from mcplan.sip import whole_body
from mcplan.sweep.results import load_sweep

if TYPE_CHECKING:
    # Names that lived here until 0.1.
    from mcplan.errors import InvalidArgument as InvalidArgument
    from mcplan.errors import InvalidOptions as InvalidOptions
    from mcplan.errors import InvalidPlan as InvalidPlan
    from mcplan.errors import InvalidRobot as InvalidRobot
    from mcplan.errors import InvalidScene as InvalidScene
    from mcplan.errors import UnknownRobot as UnknownRobot
    from mcplan.errors import UnknownScene as UnknownScene
    from mcplan.model import CheckResult as CheckResult
    from mcplan.model import Contact as Contact
    from mcplan.model import ContactRule as ContactRule
    from mcplan.model import EndEffector as EndEffector
    from mcplan.model import ForceLaw as ForceLaw
    from mcplan.model import Knot as Knot
    from mcplan.model import Phase as Phase
    from mcplan.model import Polytope as Polytope
    from mcplan.model import Report as Report
    from mcplan.model import Stance as Stance
    from mcplan.model import Step as Step
    from mcplan.model import Surface as Surface
    from mcplan.model import Swing as Swing
    from mcplan.model import Violation as Violation
    from mcplan.online.result import RunResult
    from mcplan.online.steering import Steer
    from mcplan.planar.tracking import PlanarResult
    from mcplan.rhp import Walk as Walk
    from mcplan.tracking import TrackingResult
    from mcplan.tracking.options import Watch
    from mcplan.wb import Motion, MotionResult, MotionTolerances

    PlanarMotion, WholeBodyPlan, WholeBodyTolerances = PlanarTask, PlanarPlan, PlanarTolerances
    PlanResult = ddp.Result
    InvalidMotion, UnknownMotion, load_motion = errors.InvalidPlanarTask, errors.UnknownPlanarTask, load_planar_task

__all__ = [
    "Interrupted",
    "InvalidInput",
    "MissingExtra",
    "Plan",
    "PlanViolated",
    "PlanarPlan",
    "PlanarRobot",
    "PlanarTask",
    "PlanarTolerances",
    "Robot",
    "Scene",
    "Status",
    "Tolerances",
    "UnknownName",
    "__version__",
    "check",
    "ddp",
    "export",
    "load_planar_robot",
    "load_planar_task",
    "load_robot",
    "load_scene",
    "load_sweep",
    "motion",
    "plan",
    "receding_horizon",
    "replan",
    "rhp",
    "run",
    "show",
    "sip",
    "track",
    "walk",
    "whole_body",
]

if not TYPE_CHECKING:
    # Names that lived here until 0.1, and where they are now.
    _MOVED = {
        name: f"{part}.{name}" for part, module in (("model", model), ("errors", errors)) for name in module.__all__
    }
    _MOVED |= {"PlanarMotion": "PlanarTask", "WholeBodyPlan": "PlanarPlan", "WholeBodyTolerances": "PlanarTolerances"}
    _MOVED |= {"PlanResult": "ddp.Result", "Walk": "rhp.Walk", "load_motion": "load_planar_task"}
    _MOVED |= {"InvalidMotion": "errors.InvalidPlanarTask", "UnknownMotion": "errors.UnknownPlanarTask"}
    PlanarPlan.motion = moved.attribute("PlanarPlan", "motion", "task")
    Robot.pressure_share = moved.attribute("Robot", "pressure_share", "pressure_ratio")

    def __getattr__(name: str) -> Any:
        if name not in _MOVED:
            raise AttributeError(f"module 'mcplan' has no attribute {name!r}", name=name, obj=None)
        import sys
        from operator import attrgetter

        moved.tell(name, _MOVED[name])
        return attrgetter(_MOVED[name])(sys.modules[__name__])

    def __dir__() -> list[str]:
        return __all__


def motion(
    plan: Plan | str | Path,
    *,
    joints: str | Sequence[str] = "default",
    node_s: float = 0.025,
    max_iterations: int = 60,
    time_limit_s: float = float("inf"),
    start: str = "follow",
    tolerances: MotionTolerances | None = None,
) -> MotionResult:
    """Find joints, torques and contact forces with which a robot carries out a plan of contacts and CoM.

        result = mp.motion("plan.npz")
        print(result.report)  # solved after 2.9 s, 10 iterations
        state = result.motion.at(0.5)  # q, v, a, tau, contact wrenches

    One interior-point solve: splines of base and joints, forces at the corners of soles, equations of motion, limits of
    positions, speeds and torques, soles over the ground, all near the plan. The status is `solved` only if the certificate
    holds, which works out all of it again at a thousand instants a second. Ctrl-C ends the solve with Interrupted, which
    carries the result.

    Args:
        plan: A plan of a robot with a URDF, or the path of one.
        joints: Those that move: "default" (all but grippers, fingers and head), "all", "legs", or names.
        node_s: Time between two nodes, at most [s].
        max_iterations: Of the interior-point method.
        time_limit_s: Wall clock, without the certificate [s]; if it ends before the first iteration, the motion stands still.
        start: "follow": from postures along the plan by inverse kinematics; "stand": from the robot standing still.
        tolerances: Of the certificate; None: its own.

    Returns:
        A ``mcplan.wb.MotionResult`` with ``motion``, ``report`` and ``certificate``. Where the robot lacks torque, speed or
        reach, the status says so and ``report.shortfall`` names joint, time and factor.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: An option is out of its range.
        InvalidInput: No such joint.
        InvalidPlan: The file is no plan, or one that is too long for a motion or out of all bounds.
        InvalidRobot: The robot has no URDF, or it cannot be read.
        MissingExtra: The packages of ``pip install 'mcplan[view]'`` are not installed.
    """
    from mcplan.extras import require

    require("mcplan.motion", "view", "pinocchio", "scipy")
    from mcplan.wb.solve import motion as find

    return find(
        plan,
        joints=joints,
        node_s=node_s,
        max_iterations=max_iterations,
        time_limit_s=time_limit_s,
        start=start,
        tolerances=tolerances,
    )


def track(
    plan: Plan | PlanarPlan | Motion | str | Path,
    robot: Robot | str | Path | None = None,
    *,
    watch: Watch | None = None,
    **options: Any,
) -> TrackingResult | PlanarResult:
    """Track a plan or a motion with a simulated robot: torques alone move it, within their limits.

        result = mp.track("plan.npz", "talos", mass_scale=1.1, pushes=[(40.0, 0.2, 3.0, 90.0)])
        print(result)  # a report; result.measures has the numbers, result.recording what the robot did
        result.save("run.npz")

    A fall ends the run and is a result, not an exception. Ctrl-C ends it with Interrupted, which carries the result.

    Args:
        plan: A plan of any planner, a motion, or the path of either. Of a motion all joints are tracked, with their
            velocities and accelerations, and errors are those from the motion, not from its plan.
        robot: A robot with a URDF and the plan's end-effectors by name, or what load_robot takes. None: the plan's own.
            A whole-body plan has its planar robot, a motion its joints; they take no other.
        watch: Called at every control step with the simulated time [s], the configuration (nq,) in Pinocchio's order and
            the plan that is followed, as ``mcplan.view.LiveView`` is.
        **options: Fields of ``mcplan.tracking.Options``: ``assist``, ``mass_scale``, ``friction_scale``,
            ``ground_shift_m``, ``seed``, ``hold_s``; ``pushes``, each as ``mcplan.tracking.Push`` or as size [N],
            duration [s], time [s] and direction [deg] (0 forward, 90 to the left).

    Returns:
        A ``TrackingResult`` with ``recording``, ``measures`` and the ``options`` as they were used; of a whole-body plan a
        ``PlanarResult`` with the same three.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, or its value is out of range; a planar robot has no pushes, assistance or seed.
        InvalidPlan: The file is no plan.
        InvalidRobot: The robot has no URDF, or it cannot be read, or it lacks an end-effector of the plan.
        InvalidInput: The robot cannot take up the plan's first or last posture; or a robot for a whole-body plan.
        UnknownRobot: No such name and no such file.
        MissingExtra: The packages of ``pip install 'mcplan[sim]'`` are not installed.
    """
    from mcplan.extras import require

    require("mcplan.track", "sim", "mujoco", "pinocchio", "proxsuite")
    from mcplan.following import track_any

    return track_any(plan, robot, options, watch=watch)


def run(
    scene: Scene | Plan | str | Path,
    robot: Robot | str | Path | None = None,
    *,
    watch: Watch | None = None,
    true_scene: Scene | str | Path | None = None,
    steer: Steer | None = None,
    **options: Any,
) -> RunResult:
    """Simulate a robot that is planned for while it walks: pushed, it takes other steps.

        result = mp.run("flat", "talos", push=(250.0, 0.2, 1.4, 90.0), latency=0.02)
        print(result)  # a report; result.measures and result.online have the numbers

    A fall ends the run and is a result, not an exception. Ctrl-C ends it with Interrupted, which carries the result.

    Args:
        scene: A scene, or what load_scene takes; or the plan to begin with, or the path of one (.npz, .json).
        robot: A robot with a URDF, or what load_robot takes; None: that of the plan.
        watch: Called at every control step with the simulated time [s], the configuration (nq,) in Pinocchio's order and
            the plan that is followed, as ``mcplan.view.LiveView`` is.
        true_scene: The ground that is simulated where it is not as planned: surfaces of the scene by name, elsewhere, with
            other friction, or left out. ``told_at_s`` is the time from which on the planner knows it; never by default.
        steer: Called at every control step with the simulated time [s]; returns an ``mcplan.online.Asked``: a velocity to
            walk at, a push, or that the run is over. What was asked for is in the result's options afterwards.
        **options: Fields of ``mcplan.online.OnlineOptions`` and of ``mcplan.tracking.Options``, among them ``push``, one
            or several as ``mcplan.track`` takes them; ``command``, a velocity (ahead, left [m/s], turning [rad/s]);
            ``goal``, a place and heading instead of the scene's goal (x, y [m], heading [rad], from a time on [s]);
            ``engine``, "ddp" or "rhp", which keeps surfaces and order of feet and plans at touchdowns;
            ``latency`` [s], a fixed time from measured state to plan instead of the wall clock of the computation, for
            runs that repeat to the byte; ``period`` [s]; ``replanning=False``: the first plan is followed, for comparison.

    Returns:
        A ``mcplan.online.RunResult``: all that ``track`` returns, and how planning went in ``online``.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, or its value is out of range.
        InvalidScene, InvalidPlan: The scene is malformed, or the file is no plan.
        InvalidRobot: The robot has no URDF, or it cannot be read, or it lacks an end-effector of the plan.
        InvalidInput: No plan was found to begin with, or the robot cannot take up its first posture.
        UnknownName: No such scene or robot, and no such file.
        MissingExtra: The packages of ``pip install 'mcplan[sim]'`` are not installed.
    """
    from mcplan.extras import require

    require("mcplan.run", "sim", "mujoco", "pinocchio", "proxsuite")
    from mcplan.online.steering import Beside
    from mcplan.running import run_any

    return run_any(scene, robot, options, Beside(None, watch, steer), true_scene)
