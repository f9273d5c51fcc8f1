"""Whole-body plans of planar robots in MuJoCo: feed-forward torques, and whether contact forces come out as planned.

    from mcplan.planar.tracking import track_whole_body

    result = track_whole_body(plan)
    print(result.measures)

Needs the extra `sim` (mujoco).
"""

from __future__ import annotations

from .measures import PlanarMeasures
from .prepare import PLANNING, trackable, with_clearances
from .recording import PlanarRecording
from .result import PlanarResult
from .run import DEFAULT_OPTIONS, track_whole_body
from .settings import ContactSettings, Feedback
from .suitability import Suitability, suitability

__all__ = [
    "DEFAULT_OPTIONS",
    "PLANNING",
    "ContactSettings",
    "Feedback",
    "PlanarMeasures",
    "PlanarRecording",
    "PlanarResult",
    "Suitability",
    "suitability",
    "track_whole_body",
    "trackable",
    "with_clearances",
]
