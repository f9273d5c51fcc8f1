"""Whole-body plans of planar robots in MuJoCo: feed-forward torques, and whether the contact forces come out as planned.

    from mcplan.tracking.planar import track_whole_body

    result = track_whole_body(plan)
    print(result.measures)

Needs the extra `sim` (mujoco).
"""

from __future__ import annotations

from .recording import PlanarRecording

__all__ = ["PlanarRecording"]
