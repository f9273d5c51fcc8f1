"""Plans tracked in physics simulation: MuJoCo, a whole-body controller, and what came of it.

    from mcplan.tracking import track

    result = track("plan.npz")
    print(result.measures)

Needs the extra `sim`: mujoco, pin, proxsuite.
"""

from __future__ import annotations

from .measures import Measures
from .options import Gains, Options, Push
from .recording import Recording
from .result import TrackingResult

__all__ = ["Gains", "Measures", "Options", "Push", "Recording", "TrackingResult", "track"]


def __getattr__(name: str) -> object:
    if name == "track":
        from .runner import track

        return track
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
