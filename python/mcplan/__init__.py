"""Multi-contact motion planning for legged robots.

    import mcplan as mp

    scene = mp.load_scene("gap_with_rail")
    robot = mp.load_robot("humanoid44")
    result = mp.plan(scene, robot, time_limit=1.0)
    print(result.report)
    mp.check(result.plan, scene, robot).raise_if_violated()
    result.plan.save("plan.npz")
    mp.show(result.plan, scene, robot).save_html("plan.html")

Importing this loads NumPy and nothing heavier; the rest comes when first used.
"""

from __future__ import annotations

from mcplan import starting as _starting  # noqa: F401  first: Ctrl-C while the command loads

# isort: split
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan._core import (
    CheckResult,
    Contact,
    ContactRule,
    EndEffector,
    ForceLaw,
    Knot,
    Phase,
    Plan,
    PlanarPlan,
    PlanarRobot,
    PlanarTask,
    PlanarTolerances,
    PlanResult,
    Polytope,
    Report,
    Robot,
    Scene,
    Stance,
    Status,
    Step,
    Surface,
    Swing,
    Tolerances,
    Violation,
    __version__,
    rhp,
    sip,
)
from mcplan.checking import check
from mcplan.errors import (
    Interrupted,
    InvalidArgument,
    InvalidInput,
    InvalidMotion,
    InvalidOptions,
    InvalidPlan,
    InvalidRobot,
    InvalidScene,
    PlanViolated,
    UnknownMotion,
    UnknownRobot,
    UnknownScene,
)
from mcplan.loading import load_motion, load_planar_robot, load_robot, load_scene
from mcplan.showing import show

Walk = rhp.Walk
# As planar classes were called before.
PlanarMotion, WholeBodyPlan, WholeBodyTolerances = PlanarTask, PlanarPlan, PlanarTolerances

if TYPE_CHECKING:
    from mcplan.planar.tracking import PlanarResult
    from mcplan.tracking import TrackingResult

__all__ = [
    "CheckResult",
    "Contact",
    "ContactRule",
    "EndEffector",
    "ForceLaw",
    "Interrupted",
    "InvalidArgument",
    "InvalidInput",
    "InvalidMotion",
    "InvalidOptions",
    "InvalidPlan",
    "InvalidRobot",
    "InvalidScene",
    "Knot",
    "Phase",
    "Plan",
    "PlanResult",
    "PlanViolated",
    "PlanarPlan",
    "PlanarRobot",
    "PlanarTask",
    "PlanarTolerances",
    "Polytope",
    "Report",
    "Robot",
    "Scene",
    "Stance",
    "Status",
    "Step",
    "Surface",
    "Swing",
    "Tolerances",
    "UnknownMotion",
    "UnknownRobot",
    "UnknownScene",
    "Violation",
    "Walk",
    "__version__",
    "check",
    "load_motion",
    "load_planar_robot",
    "load_robot",
    "load_scene",
    "plan",
    "receding_horizon",
    "replan",
    "rhp",
    "show",
    "sip",
    "track",
    "walk",
    "whole_body",
]


def plan(
    scene: Scene | str | Path,
    robot: Robot | str | Path = "humanoid44",
    *,
    warm_start: Plan | None = None,
    **options: Any,
) -> PlanResult:
    """Find a contact sequence and a motion from the scene's start to its goal.

    Ctrl-C ends the search with Interrupted, which carries the result with the best plan so far.

    Args:
        scene: A scene, or what load_scene takes.
        robot: A robot, or what load_robot takes.
        warm_start: An earlier plan of the same robot to start from.
        **options: Fields of ``mcplan.ddp.Options``; ``time_limit`` [s] is short for ``time_limit_s``. ``model`` says what
            contacts can do: "wrench" (default), forces within soles and friction cones that turn the base, or "lipm", the
            paper's forces through the CoM.

    Returns:
        The plan, with a report whose status is ``solved`` only if the checker accepts the plan.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidOptions: No such option, or its value is out of range.
        InvalidScene: The scene is malformed or does not fit the robot.
        InvalidRobot: The robot is malformed.
    """
    from mcplan.solve import plan as solve

    return solve(scene, robot, options, warm_start)


def replan(
    previous: Plan,
    t: float,
    measured: Knot,
    *,
    scene: Scene | None = None,
    robot: Robot | None = None,
    **options: Any,
) -> PlanResult:
    """Plan on from a measured state.

    Args:
        previous: The plan under way.
        t: Time in it [s]; the phase under way and those after it are the first guess.
        measured: The state now; its end-effectors in contact stand where they are. An ``angular_momentum_W`` of zero is
            made from ``base_rpy_rate``, an empty ``end_effector_yaw`` from the base's heading.
        scene: None: the plan's own.
        robot: None: the plan's own.
        **options: As for plan(); the number of phases is what is left of them.

    Returns:
        A plan from the measured state to the goal (``plan.measured_start`` is set).

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidInput: t lies outside the plan.
        InvalidPlan: The measured state does not fit the robot.
        InvalidOptions: No such option, or its value is out of range.
    """
    from mcplan.solve import replan as solve

    return solve(previous, t, measured, scene, robot, options)


def walk(
    scene: Scene | str | Path,
    robot: Robot | str | Path | None = None,
    *,
    sequence: Plan | str | Path | None = None,
    fidelity: str | rhp.Fidelity = "point",
    lookahead: int = 3,
    cycles: int = 14,
    transcription: str | rhp.Transcription = "trapezoidal",
    time_limit: float | None = None,
    **options: Any,
) -> Walk:
    """Plan a walk on two feet over given surfaces: CoM, angular momentum, footholds, timing and forces.

    Each cycle plans `lookahead` steps and executes the first; the next cycle starts from where it ends. A cycle that
    fails ends the walk: ``walk.plan`` is what was executed until then, ``walk.cycles`` says what happened. Ctrl-C ends
    it with Interrupted, which carries the walk.

    Args:
        scene: A scene, or what load_scene takes; its ``steps`` say which foot lands on which surface.
        robot: A robot with two feet, or what load_robot takes. None: the robot of `sequence`, else talos_wang.
        sequence: A plan, or path of one, whose start and contact sequence are taken instead of the scene's; the walk
            comes to rest after its last step.
        fidelity: Model of the steps after the first: "single" (centroidal), "com", "rectangle" or "point".
        lookahead: Steps in a horizon, 1 to 10, the executed one included.
        cycles: Steps to execute; fewer if the sequence ends before.
        transcription: "trapezoidal" or "euler" (the paper's, whose motion is not quite the integral of its forces).
        time_limit: Of each cycle, wall clock [s]; None: none.
        **options: Other fields of ``rhp.Options``, such as ``paper=True``.

    Returns:
        The walk: ``plan``, ``report``, ``cycles``, ``success``, and totals such as ``distance_m()``. The report's status
        is ``solved`` only if the checker accepts the whole plan.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, or its value is out of range.
        InvalidScene: The scene is malformed, has no steps, or does not fit the robot, which cannot stand at its start or
            goal, for instance.
        InvalidRobot: The robot is malformed or does not have two feet.
        InvalidPlan: The sequence lifts both feet at once, uses other end-effectors than feet, or names surfaces that
            the scene does not have.
        UnknownScene, UnknownRobot: No such name and no such file.
    """
    return receding_horizon(
        scene,
        robot,
        sequence=sequence,
        fidelity=fidelity,
        lookahead=lookahead,
        cycles=cycles,
        transcription=transcription,
        time_limit=time_limit,
        **options,
    ).walk()


def receding_horizon(
    scene: Scene | str | Path,
    robot: Robot | str | Path | None = None,
    *,
    sequence: Plan | str | Path | None = None,
    **options: Any,
) -> rhp.RecedingHorizon:
    """Make the planner behind walk(), to run it cycle by cycle and from measured states.

        planner = mp.receding_horizon("rubbles", time_limit=1.0)
        while running:
            cycle = planner.step(measured)  # an rhp.State; without one: from where the last step ends
            if cycle.executed:
                follow(planner.executed())  # a plan of one step, from time 0

    Args:
        scene: As for walk().
        robot: As for walk().
        sequence: As for walk().
        **options: As for walk().

    Raises:
        InvalidArgument, InvalidOptions, InvalidScene, InvalidRobot, InvalidPlan, UnknownScene, UnknownRobot: As for
            walk().
    """
    from mcplan.walking import receding_horizon as make

    return make(scene, robot, sequence, options)


def whole_body(
    motion: PlanarTask | str | Path,
    *,
    forces: str | sip.Forces = "per_point",
    minimise: str | None = None,
    contact: str | sip.ContactMode = "tube",
    order: int = 8,
    neq: int = 2,
    free_flyer: str | sip.FreeFlyer = "computed",
    free_durations: bool | None = None,
    time_limit: float | None = None,
    warm_start: PlanarPlan | str | Path | None = None,
    certify: bool = False,
    **options: Any,
) -> sip.Result:
    """Plan the whole body of a planar robot through a sequence of contact stances.

        result = mp.whole_body("climbing")
        result.plan.at(0.5).torque  # any instant: joints, base, torques, contact forces

    Joint trajectories are splines, and constraints hold at every instant between knots, not only at samples. Ctrl-C
    ends the search with Interrupted, which carries the result with the best motion so far.

    Args:
        motion: A motion, or what load_motion takes: its robot, surfaces and the stance of each phase.
        forces: Where contact forces come from: "uniform", "per_body" or "per_point" weights of the least norm (the
            paper's cases 1, 2 and 3), or "parameters" (polynomials of time).
        minimise: "torque" (integral of the squared torques), "time" or "none" (any motion within the constraints).
            None: "torque", or "none" with ``dynamics=False``. Weights in `options` replace what it sets.
        contact: How contacts are held: "tube" (within ``tube_m`` and ``tube_rad`` at every instant), "band" or
            "strict" (polynomial coefficients 0 to `neq`).
        order: Of the Taylor polynomials, 3 to 12.
        neq: Highest coefficient that "band" and "strict" hold.
        free_flyer: The base: "computed" from the joints, or "parameterised" by splines of its own.
        free_durations: A duration for each phase, or one for all intervals. None: each phase its own, except that
            "none" has nothing to choose them by.
        time_limit: Wall clock of the whole search [s]; None: none.
        warm_start: A plan of the same robot and phases, or the path of one, to start from.
        certify: Prove the constraints of what was found, at every instant: ``result.certificate``.
        **options: Other fields of ``sip.Options``, such as ``tube_m=1e-4`` or ``self_collision=True``.

    Returns:
        The motion: ``plan``, ``report``, ``parameters`` and ``constraints`` (size of the program), ``drift_m``,
        ``drift_rad``, ``certificate``. The report's status is ``solved`` only if the checker accepts the plan.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, its value is out of range, or it does not go with another one.
        InvalidMotion: The motion is malformed.
        InvalidRobot: Its robot is malformed.
        InvalidPlan: The warm start has other phases or joints, or is malformed.
        UnknownMotion, UnknownRobot: No such name and no such file.
    """
    from mcplan.planar.planning import whole_body as solve

    given: dict[str, Any] = {"forces": forces, "contact": contact, "order": order, "neq": neq, "free_flyer": free_flyer}
    given |= {"free_durations": free_durations, "time_limit": time_limit}
    return solve(motion, warm_start, certify, minimise, {**given, **options})


def track(
    plan: Plan | PlanarPlan | str | Path,
    robot: Robot | str | Path | None = None,
    **options: Any,
) -> TrackingResult | PlanarResult:
    """Track a plan with a simulated robot: torques alone move it, within their limits.

        result = mp.track("plan.npz", "talos", mass_scale=1.1, pushes=[(40.0, 0.2, 3.0, 90.0)])
        print(result)  # a report; result.measures has the numbers, result.recording what the robot did
        result.save("run.npz")

    A fall ends the run and is a result, not an exception. Ctrl-C ends it with Interrupted, which carries the result.

    Args:
        plan: A plan of any planner, or the path of one.
        robot: A robot with a URDF and the plan's end-effectors by name, or what load_robot takes. None: the plan's own.
            A whole-body plan has its planar robot and takes no other.
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

    return track_any(plan, robot, options)
