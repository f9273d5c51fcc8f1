"""How far solves overrun their time limit, and the time for surfaces that a path never comes near."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from mcplan import Scene
    from mcplan.model import Surface

LIMITS_S = (0.01, 0.05, 0.2, 0.5, 1.0)
IDLE = (0, 20, 50, 100, 300, 1000)

Progress = Callable[[str], None]
Solve = Callable[[float], Any]


def overruns(quick: bool = False, progress: Progress | None = None) -> list[dict[str, Any]]:
    """Rows of solves under time limits: CPU and wall clock beyond the limit, and how they ended.

    A limit is wall clock. CPU time is what a solve makes use of: on a busy machine the wall clock runs on while others do.

    Args:
        quick: The shortest limit and the first case of each engine alone.
        progress: Called with a line for each row.
    """
    rows = []
    named = set()
    for engine, case, solve in cases():
        if quick and engine in named:
            continue
        named.add(engine)
        for limit_s in LIMITS_S[: 1 if quick else None]:
            cpu_s, wall_s = time.process_time(), time.perf_counter()
            status = solve(limit_s)
            cpu_s, wall_s = time.process_time() - cpu_s, time.perf_counter() - wall_s
            rows.append(
                {
                    "engine": engine,
                    "case": case,
                    "limit_s": limit_s,
                    "cpu_s": cpu_s,
                    "cpu_over_s": cpu_s - limit_s,
                    "wall_over_s": wall_s - limit_s,
                    "status": status.name,
                }
            )
            if progress is not None:
                progress(f"{engine} {case}, {limit_s:g} s: {1e3 * (cpu_s - limit_s):+.0f} ms of CPU, {status.name}")
    return rows


def cases() -> Iterator[tuple[str, str, Solve]]:
    """Engine, case, and a solve of it under a limit [s] that returns its status."""
    import mcplan as mp

    from .growth import long_floor

    for name in ("stairs", "gap_with_rail", "random_patches"):
        yield "ddp", name, _plan(mp.load_scene(name))
    yield "ddp", "1000 idle surfaces", _plan(with_idle_surfaces(1000))
    for phases in (72, 288):
        yield "ddp", f"{phases} phases", _plan(long_floor(phases), phases=phases)
    yield "ddp", "stairs, lipm", _plan(mp.load_scene("stairs"), model="lipm")
    yield "ddp", "stairs, replanned", _replan(mp.load_scene("stairs"))
    for terrain in ("flat", "rubbles"):
        yield "rhp", terrain, _step(terrain)
    for task in ("cartwheel", "walking", "climbing", "stairs"):
        yield "sip", task, _move(task)


def _plan(scene: Scene, **options: Any) -> Solve:
    import mcplan as mp

    robot = mp.load_robot("humanoid44")
    return lambda limit_s: mp.plan(scene, robot, time_limit=limit_s, **options).report.status


def _replan(scene: Scene) -> Solve:
    """From where a plan is after three tenths of it; the plan itself is made once, without a limit."""
    import mcplan as mp

    @functools.cache
    def earlier() -> tuple[mp.Plan, float, mp.model.Knot]:
        plan = mp.plan(scene, "humanoid44").plan
        time_s = 0.3 * plan.duration()
        state, measured = plan.at(time_s), mp.model.Knot()
        measured.com_W, measured.com_velocity_W = state.com_W, state.com_velocity_W
        measured.base_rpy, measured.base_rpy_rate = state.base_rpy, state.base_rpy_rate
        measured.end_effectors_W = [end.position_W for end in state.end_effectors]
        return plan, time_s, measured

    earlier()
    return lambda limit_s: mp.replan(*earlier(), time_limit=limit_s).report.status


def _step(terrain: str) -> Solve:
    import mcplan as mp

    return lambda limit_s: mp.receding_horizon(terrain, time_limit=limit_s).step().status


def _move(name: str) -> Solve:
    import mcplan as mp

    return lambda limit_s: mp.whole_body(name, time_limit=limit_s).report.status


def idle_surfaces(quick: bool = False, progress: Progress | None = None) -> list[dict[str, Any]]:
    """Rows of solves of flat with surfaces beside the path that are of no use: their number and what they cost.

    Args:
        quick: The first two numbers alone.
        progress: Called with a line for each row.
    """
    import mcplan as mp

    rows = []
    robot = mp.load_robot("humanoid44")
    for count in IDLE[: 2 if quick else None]:
        scene = with_idle_surfaces(count)
        cpu_s = time.process_time()
        report = mp.plan(scene, robot).report
        cpu_s = time.process_time() - cpu_s
        rows.append({"idle": count, "cpu_s": cpu_s, "iterations": report.iterations, "status": report.status.name})
        if progress is not None:
            progress(f"{count} idle surfaces: {cpu_s:.3f} s of CPU, {report.iterations} iterations")
    return rows


def with_idle_surfaces(count: int, seed: int = 0) -> Scene:
    """Flat with patches of 0.2 m, two to six metres to either side of the path and up to half a metre high."""
    import mcplan as mp

    random = np.random.default_rng(seed)
    scene = mp.load_scene("flat")
    square_W = np.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.1, 0.1, 0.0], [-0.1, 0.1, 0.0]])
    patches: list[Surface] = []
    for index in range(count):
        side = 1.0 if index % 2 else -1.0
        middle_W = [random.uniform(-3.0, 6.0), side * random.uniform(2.5, 6.0), random.uniform(0.0, 0.5)]
        patches.append(mp.model.Surface(name=f"idle_{index}", vertices_W=square_W + middle_W))
    scene.surfaces = [*scene.surfaces, *patches]
    return scene
