"""The certificate of motions, which sees no solver: all is worked out again from the numbers of the motion."""

from .certify import certify
from .result import MotionCheckResult, MotionViolation
from .tolerances import MotionTolerances

__all__ = ["MotionCheckResult", "MotionTolerances", "MotionViolation", "certify"]
