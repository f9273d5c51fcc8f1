"""What a control step costs on one core, by its parts, and how much faster than the clock a run is."""

from __future__ import annotations

import functools
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from .processes import apart
from .tracking import plan_of, track_plan
from .tracking_cases import CONTROL_MS, REALTIME_FACTOR, named

#: What is timed: level ground, with single and double support alternating.
CASE = "flat/talos"


def measure(repeats: int = 3, case: str = CASE) -> dict[str, Any]:
    """Medians over repeats, in a process of its own on one thread and one core. Ratios are to a control step.

    Args:
        repeats: Runs of the same plan.
        case: A case of the full table, of a humanoid.

    Returns:
        control_ms and its parts qp_ms (the solver), model_ms (kinematics and dynamics), rest_ms (building the program,
        references, torques), p99_ms (of whole steps); qp_ratio, model_ratio, rest_ratio; simulation_ms (MuJoCo, in one
        control step), realtime_factor; holds.
    """
    row: dict[str, Any] = apart(_measure, repeats, case)
    return row


def _measure(repeats: int, name: str) -> dict[str, Any]:
    from mcplan.tracking.controller import Controller
    from mcplan.tracking.quadratic_program import QuadraticProgram
    from mcplan.tracking.robot_dynamics import RobotDynamics
    from mcplan.tracking.simulation import Simulation

    case = named(name)
    plan = plan_of(case).plan
    rows = []
    for _ in range(repeats):
        dynamics = ((RobotDynamics, "update"), (RobotDynamics, "end_effector"))
        watched = ((Controller, "step"), (QuadraticProgram, "solve"), (Simulation, "advance"), *dynamics)
        with stopwatches(*watched) as (steps, solves, advances, updates, motions):
            result: Any = track_plan(case, plan)
        control, qp, model = (1e3 * sum(times) / len(steps) for times in (steps, solves, updates + motions))
        rows.append(
            {
                "control_ms": control,
                "qp_ms": qp,
                "model_ms": model,
                "rest_ms": control - qp - model,
                "p99_ms": 1e3 * float(np.quantile(steps, 0.99)),
                "simulation_ms": 1e3 * sum(advances) / len(steps),
                "realtime_factor": result.measures.realtime_factor,
            }
        )
    median = {key: float(np.median([row[key] for row in rows])) for key in rows[0]}
    ratios = {f"{part}_ratio": median[f"{part}_ms"] / median["control_ms"] for part in ("qp", "model", "rest")}
    holds = median["control_ms"] <= CONTROL_MS and median["realtime_factor"] >= REALTIME_FACTOR
    return {"case": name, "repeats": repeats, **median, **ratios, "holds": holds}


@contextmanager
def stopwatches(*watched: tuple[type, str]) -> Iterator[list[list[float]]]:
    """Lists of the durations [s] of all calls of these methods meanwhile, in the order of the methods."""
    with_times: list[list[float]] = [[] for _ in watched]
    before = [getattr(owner, name) for owner, name in watched]

    def timed(method: Any, times: list[float]) -> Any:
        @functools.wraps(method)
        def call(*args: Any, **kwargs: Any) -> Any:
            tick = time.perf_counter()
            try:
                return method(*args, **kwargs)
            finally:
                times.append(time.perf_counter() - tick)

        return call

    for (owner, name), method, times in zip(watched, before, with_times, strict=True):
        setattr(owner, name, timed(method, times))
    try:
        yield with_times
    finally:
        for (owner, name), method in zip(watched, before, strict=True):
            setattr(owner, name, method)
