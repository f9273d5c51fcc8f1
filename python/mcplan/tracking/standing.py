"""Whether a robot stands at the end of a run, or is about to fall: where its capture point is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .recording import Recording

Array = NDArray[np.float64]

#: The velocity of the CoM is its displacement in so long [s].
LAST_S = 0.02
#: A robot whose capture point is so far beside its soles, in heights of its CoM, cannot stand without another step.
BESIDE = 0.05


def falls_at_end(recording: Recording) -> bool:
    """Whether a run went on to the end of a plan that ends at rest, and left the robot where it cannot stand."""
    plan = recording.plan
    if plan.open_end or len(recording.times_s) < 2:
        return False
    last_s, before_s = float(recording.times_s[-1]), float(recording.times_s[-2])
    if last_s + (last_s - before_s) <= plan.duration():
        return False
    return beside_soles_m(recording) > BESIDE * recording.simulated_robot.com_height


def beside_soles_m(recording: Recording) -> float:
    """How far the capture point p + v / omega is beside the soles at the end, on the level [m]; 0 where it is over them.

    The soles are taken for the hull of circles about those in contact, with half of their diagonals. With nothing in
    contact the distance is infinite.
    """
    r = recording
    steps = min(len(r.times_s) - 1, max(1, round(LAST_S / float(r.times_s[-1] - r.times_s[-2]))))
    velocity = (r.com_W[-1] - r.com_W[-1 - steps]) / (r.times_s[-1] - r.times_s[-1 - steps])
    omega = np.sqrt(r.scene.gravity / r.simulated_robot.com_height)
    capture = (r.com_W[-1] + velocity / omega)[:2]
    touching = np.flatnonzero(r.contacts[-1])
    if not len(touching):
        return float("inf")
    ends = r.simulated_robot.end_effectors
    half = max(float(np.linalg.norm(ends[int(i)].half_size)) for i in touching)
    return max(0.0, _from_hull(capture, r.end_effectors_W[-1, touching, :2]) - half)


def _from_hull(point: Array, corners: Array) -> float:
    """Distance from a point to the convex hull of others in the plane: the largest over the directions that part them.

    It is that over a turn in steps of a degree, which is less by one part in 6,000 at most.
    """
    angles = np.radians(np.arange(360.0))
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    return max(0.0, float((directions @ point - (directions @ corners.T).max(axis=1)).max()))
