"""Whole-body motion in space: every joint of a plan for a robot with a URDF, and the certificate of such motions."""

from .motion import Motion, MotionSamples, MotionState

__all__ = ["Motion", "MotionSamples", "MotionState"]
