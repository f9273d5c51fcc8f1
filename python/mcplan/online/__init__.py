"""Planning while the robot walks: measured states in, plans and references out.

    from mcplan.online import Planner, StateReader

    reader = StateReader(plan)
    with Planner(plan) as planner:
        planner.submit(reader.read(time_s, configuration, velocity, forces_W))
        update = planner.poll()

``Planner`` needs nothing but mcplan; ``StateReader`` needs Pinocchio, and ``run`` a simulator, the extra `sim`.
docs/online.md says how to wire it to a robot.
"""

from __future__ import annotations

from mcplan._core.online import FeltPush, PushObserver

from .contacts import ContactFilter
from .horizon_planner import HorizonPlanner
from .measures import OnlineMeasures
from .options import OnlineOptions
from .planner import MeasuredState, Planner, Update
from .steering import Asked

__all__ = [
    "Asked",
    "ContactFilter",
    "FeltPush",
    "HorizonPlanner",
    "MeasuredState",
    "OnlineMeasures",
    "OnlineOptions",
    "Planner",
    "PushObserver",
    "RunResult",
    "StateReader",
    "Update",
    "run",
    "with_bases",
]


def __getattr__(name: str) -> object:
    if name == "StateReader":
        from .state import StateReader

        return StateReader
    if name == "RunResult":
        from .result import RunResult

        return RunResult
    if name == "with_bases":
        from .horizon_bases import with_bases

        return with_bases
    if name == "run":
        from .runner import run

        return run
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
