"""The closed loop: a robot in MuJoCo, a controller, and a planner beside it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, Robot, Scene
from mcplan.errors import InvalidInput, InvalidOptions
from mcplan.extras import require
from mcplan.tracking.disturbances import disturbed
from mcplan.tracking.interruption import Interruption
from mcplan.tracking.options import Options, Watch, require_watch
from mcplan.tracking.runner import robot_for

from .ending import length_of
from .goals import require_goals
from .horizon_bases import with_bases
from .horizon_loop import HorizonLoop
from .horizon_planner import require_steps
from .loop import Loop
from .options import OnlineOptions
from .result import RunResult
from .steering import Beside, Steer, require_steerable
from .true_scene import require_goal

Array = NDArray[np.float64]


def run(
    plan: Plan,
    robot: Robot | str | Path | None = None,
    options: Options | None = None,
    online: OnlineOptions | None = None,
    progress: Callable[[float, float], None] | None = None,
    watch: Watch | None = None,
    true_scene: Scene | None = None,
    steer: Steer | None = None,
) -> RunResult:
    """Simulate a robot that follows a plan and is planned for anew while it walks.

    Args:
        plan: The plan to begin with, of ``ddp``, or of ``rhp`` where that replans.
        robot: A robot with a URDF and the plan's end-effectors by name; None: the plan's own.
        options: Options of the simulation, as for tracking.
        online: When to replan, and when plans are taken over.
        progress: Called now and then with the time simulated and the time to simulate [s].
        watch: Called at every control step with the simulated time [s], the configuration (nq,) in Pinocchio's order and
            the plan that is followed, as ``mcplan.view.LiveView`` is.
        true_scene: The ground that is simulated: surfaces of the plan's scene by name, elsewhere, with other friction, or
            left out; None: as planned. The planner takes the ground for that of the plan until ``online.told_at_s``.
        steer: Called at every control step with the simulated time [s]; returns an ``Asked``: a velocity to walk at, a push,
            or that the run is over. What was asked for is in the result's options, with which a run repeats this one.

    Returns:
        What the robot did, and how planning went. Ctrl-C ends the run with Interrupted, which carries the result.

    Raises:
        MissingExtra: The packages of ``pip install 'mcplan[sim]'`` are not installed.
        InvalidOptions: An option is out of range, or a push does not act in the run.
        InvalidRobot: The robot has no URDF, or it cannot be read, or it lacks an end-effector of the plan.
        InvalidInput: The robot cannot take up the plan's first posture, or the plan has forces at points, or ``true_scene``
            does not fit the plan.
    """
    require("mcplan.online", "sim", "mujoco", "pinocchio", "proxsuite")
    require_watch(watch)
    options, online = options or Options(), online or OnlineOptions()
    _require_valid(plan, options, online, true_scene, steer)
    walker = robot_for(plan, robot)
    if options.seed:
        pushed_s = min(plan.duration(), length_of(plan, options, online, steer is not None))
        options = disturbed(options, options.seed, pushed_s, walker.mass)
    from mcplan.tracking import mujoco_model
    from mcplan.tracking.simulation import Simulation

    model = mujoco_model.build(walker, true_scene or plan.scene, options)
    if online.engine == "rhp":
        plan = with_bases(plan, model.urdf_model)
    simulation = Simulation(model, options.torque_delay_s, options.torque_bandwidth_hz)
    with Interruption() as stop:
        kind = HorizonLoop if online.engine == "rhp" else Loop
        loop = kind(plan, simulation, options, online, true_scene, Beside(progress, watch, steer))
        try:
            result = loop.run(stop)
        finally:
            loop.planner.close()
    stop.raise_with(result)
    return result


def _require_valid(
    plan: Plan, options: Options, online: OnlineOptions, true_scene: Scene | None, steer: Steer | None
) -> None:
    """Raise InvalidOptions or InvalidInput, as run() says."""
    options.validate()
    online.validate()
    if online.engine == "rhp":
        require_steps(plan)
    elif online.replanning and any(phase.has_points for phase in plan.phases):
        raise InvalidInput(
            "plan", "must be a plan of ddp: those with forces at points are replanned by engine 'rhp' alone"
        )
    require_steerable(steer, online)
    require_goals(plan.scene, plan.robot, online)
    if true_scene is not None:
        true_scene.validate()
        if not np.isnan(online.told_at_s):
            require_goal(true_scene, plan.scene)
    elif not np.isnan(online.told_at_s):
        raise InvalidOptions(
            "told_at_s",
            "must be given with a true scene (the ground that is simulated), which the planner is told",
            f"{online.told_at_s:g}",
        )
    run_s = length_of(plan, options, online, steer is not None)
    options.require_pushes_within(run_s)
    online.require_within(run_s)
