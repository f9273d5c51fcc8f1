"""Whole-body motion in space: every joint of a plan for a robot with a URDF, and the certificate of such motions."""

from .certificate import MotionCheckResult, MotionTolerances, MotionViolation
from .motion import Motion, MotionSamples, MotionState

__all__ = [
    "Motion",
    "MotionCheckResult",
    "MotionSamples",
    "MotionState",
    "MotionTolerances",
    "MotionViolation",
]
