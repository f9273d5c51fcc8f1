"""What a robot lacks for a plan: the limit that a motion exceeds most, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .result import Shortfall

if TYPE_CHECKING:
    from .motion import Motion
    from .nodes import Nodes

Array = NDArray[np.float64]

#: Beyond a limit by less [ratio; m], a motion is left to its certificate.
SMALL_RATIO, SMALL_M = 1e-6, 1e-3
#: Factor of a limit by which a motion that is not quite a solution tells that the robot lacks something.
MUCH = 1.1
#: Misses of a foothold [m, rad] that say that it is not reached.
MISS = 1e-3


def limits_exceeded(usage: Array, nodes: Nodes, motion: Motion) -> Shortfall | None:
    """The torque or speed that is exceeded most at the nodes, else a swing that is not clear of the ground.

    Args:
        usage: (n + 1, rows) of the solver: positions, speeds, torques, then distances.
        nodes: Its nodes.
        motion: The motion.
    """
    joints = len(motion.joints)
    for what, first in (("torque", 2 * joints), ("speed", joints)):
        used = usage[:, first : first + joints]
        k, joint = divmod(int(np.argmax(used)), joints)
        if used[k, joint] > 1.0 + SMALL_RATIO:
            return Shortfall(what, motion.joints[joint], float(nodes.times_s[k]), float(used[k, joint]))
    beyond = usage[:, 3 * joints :]
    if beyond.size == 0 or not beyond.max() > SMALL_M:
        return None
    k = int(np.argmax(beyond.max(axis=1)))
    ends = motion.plan.robot.end_effectors
    free = [end.name for end, interval in zip(ends, nodes.intervals[k], strict=True) if interval is None]
    return Shortfall("clearance", " and ".join(free) or "links", float(nodes.times_s[k]), 1.0 + float(beyond.max()))


def not_reached(motion: Motion, nodes: Nodes) -> Shortfall | None:
    """The foothold that is missed most: how far it is from the limb's first joint over how far the limb reaches."""
    states = motion.sample(nodes.times_s)
    worst, found = MISS, None
    for k, intervals in enumerate(nodes.intervals):
        for end, interval in enumerate(intervals):
            if interval is None:
                continue
            at = states.end_effectors_W[k, end]
            miss = float(np.linalg.norm(at - interval.position_W))
            if miss > worst:
                worst, found = miss, (k, end, interval.position_W)
    if found is None:
        return None
    k, end, wanted = found
    joint, root_W = _limb(motion, states.q[k], end)
    reached = float(np.linalg.norm(states.end_effectors_W[k, end] - root_W))
    factor = float(np.linalg.norm(wanted - root_W)) / max(reached, 1e-9)
    return Shortfall("reach", joint, float(nodes.times_s[k]), factor)


def _limb(motion: Motion, q: Array, end: int) -> tuple[str, Array]:
    """First joint of the limb of an end-effector, and where it is."""
    import pinocchio as pin  # type: ignore[import-untyped]

    model, data = motion.model.model, motion.model.model.createData()
    pin.forwardKinematics(model, data, q)
    chain = [joint for joint in model.supports[model.frames[motion.model.frames[end]].parentJoint] if joint > 1]
    first = chain[0] if chain else 1
    return str(model.names[first]), np.array(data.oMi[first].translation)


def shortfall_of(usage: Array, converged: bool, near: bool, nodes: Nodes, motion: Motion) -> Shortfall | None:
    """What is exceeded at the end of a search, or not reached; None: nothing that is known.

    Args:
        usage: Of limits, at the end.
        converged: Whether the search did.
        near: Whether, though it did not, all else than limits holds nearly, so that what exceeds them by much is lacking.
        nodes: The solver's.
        motion: The motion.
    """
    found = limits_exceeded(usage, nodes, motion) if converged or near else None
    if found is not None and not converged and found.factor < MUCH:
        found = None
    if found is None and not converged:
        found = not_reached(motion, nodes)
    return found
