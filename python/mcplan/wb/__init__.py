"""Whole-body motion in space: every joint of a plan for a robot with a URDF, and the certificate of such motions."""

from .certificate import MotionCheckResult, MotionTolerances, MotionViolation
from .motion import Motion, MotionSamples, MotionState
from .planned import PlannedMotion, Round
from .result import MotionReport, MotionResult, MotionStatus, Shortfall

__all__ = [
    "Motion",
    "MotionCheckResult",
    "MotionReport",
    "MotionResult",
    "MotionSamples",
    "MotionState",
    "MotionStatus",
    "MotionTolerances",
    "MotionViolation",
    "PlannedMotion",
    "Round",
    "Shortfall",
]
