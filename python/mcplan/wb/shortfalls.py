"""What a robot lacks for a plan: the limit that a motion exceeds most, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample_at

from .result import Shortfall
from .start import coarse_times

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .motion import Motion
    from .motion_model import MotionModel
    from .nodes import Nodes

Array = NDArray[np.float64]

#: Beyond a limit by less [ratio; m], a motion is left to its certificate.
SMALL_RATIO, SMALL_M = 1e-6, 1e-3
#: Factor of a limit by which a motion that is not quite a solution tells that the robot lacks something.
MUCH = 1.1
#: Lever of what is left on the base [m].
ARM_M = 1.0
#: Misses of a foothold by inverse kinematics that say that it is not reached [m].
MISS_M = 5e-3


def limits_exceeded(usage: Array, nodes: Nodes, motion: Motion) -> Shortfall | None:
    """The torque or speed that is exceeded most at the nodes, by its factor, else a swing that is not clear of the ground.

    Args:
        usage: (n + 1, rows) of the solver: positions, speeds, torques, then distances.
        nodes: Its nodes.
        motion: The motion.
    """
    joints = len(motion.joints)
    used = usage[:, joints : 3 * joints]
    k, column = divmod(int(np.argmax(used)), 2 * joints)
    if used[k, column] > 1.0 + SMALL_RATIO:
        what, joint = ("speed", column) if column < joints else ("torque", column - joints)
        return Shortfall(what, motion.joints[joint], float(nodes.times_s[k]), float(used[k, column]))
    beyond = usage[:, 3 * joints :]
    if beyond.size == 0 or not beyond.max() > SMALL_M:
        return None
    k = int(np.argmax(beyond.max(axis=1)))
    ends = motion.plan.robot.end_effectors
    free = [end.name for end, interval in zip(ends, nodes.intervals[k], strict=True) if interval is None]
    return Shortfall("clearance", " and ".join(free) or "links", float(nodes.times_s[k]), 1.0 + float(beyond.max()))


def not_reached(model: MotionModel, plan: Plan, nodes: Nodes) -> Shortfall | None:
    """The foothold that inverse kinematics along the plan misses most: what its limb lacks of its length."""
    times = coarse_times(nodes)
    samples = sample_at(plan, plan.scene, plan.robot, times)
    found = follow(model.complete, samples)
    misses = np.where(samples.surfaces >= 0, found.end_misses, 0.0)
    k, end = (int(i) for i in np.unravel_index(int(np.argmax(misses)), misses.shape))
    if not misses[k, end] > MISS_M:
        return None
    joint, length = _limb(model, found.configurations[k], end)
    return Shortfall("reach", joint, float(times[k]), 1.0 + float(misses[k, end]) / length)


def _limb(model: MotionModel, q: Array, end: int) -> tuple[str, float]:
    """First joint of the limb of an end-effector, and how far that is from it [m]."""
    import pinocchio as pin  # type: ignore[import-untyped]

    whole, frame = model.complete.model, model.complete.frames[end]
    data = whole.createData()
    pin.framesForwardKinematics(whole, data, q)
    first = next(joint for joint in whole.supports[whole.frames[frame].parentJoint] if joint > 1)
    arm = data.oMf[frame].translation - data.oMi[first].translation
    return str(whole.names[first]), max(float(np.linalg.norm(arm)), 1e-3)


def shortfall_of(
    usage: Array, converged: bool, near: bool, nodes: Nodes, motion: Motion, left: float = float("inf")
) -> Shortfall | None:
    """What is exceeded at the end of a search, or not reached; None: nothing that is known.

    Args:
        usage: Of limits, at the end.
        converged: Whether the search did.
        near: Whether, though it did not, all else than limits holds nearly, so that what exceeds them by much is lacking.
        nodes: The solver's.
        motion: The motion.
        left: Force [N] or moment [N m] on the base that a search that is not near has not balanced.
    """
    found = limits_exceeded(usage, nodes, motion)
    if found is not None and not converged and found.factor < MUCH:
        found = None
    if found is not None and not (converged or near) and not _beyond(found, motion, left):
        found = None
    if found is None and not converged:
        found = not_reached(motion.model, motion.plan, nodes)
    return found


def _beyond(found: Shortfall, motion: Motion, left: float) -> bool:
    """Whether a torque is lacking even if all that is left on the base acted on the joint, a metre away from it."""
    if found.what != "torque":
        return False
    explained = left * ARM_M / float(motion.model.effort[motion.joints.index(found.joint)])
    return found.factor > MUCH * (1.0 + explained)
