"""Balance at the nodes, where forces are not interpolated: what contacts could balance there, the shipped forces do.

Between nodes forces are linear, and leave up to a newton on the base. At a node they are those of the states there, to
rounding: a joint off by a milliradian shows here, be it of an arm. With the wrenches G f that forces f at the corners that
press can give, r_c = G G^+ r is the part of the missing wrench r that they could have balanced. What lies outside of the
range of G (a moment about the line of two point feet) is looked at where stances end.

For a moment the edge of a cone or of a surface may be in the way: what counts is in how much time r_c is there, a node for half
of the way to those beside it. What is more than the base's residual may be is found there, and does not count once more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .correction import grasp_of
from .inputs import CertifiedMotion
from .result import MotionViolation
from .robot import CertifiedRobot
from .states import States, states_of
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: Corners with less of the largest force than this ratio have no say: it would take much of them to change little.
PRESSES = 1e-2
#: Singular values below this ratio of the largest are directions in which the contacts give no wrench.
RANK = 1e-4


def balance_at_nodes(motion: CertifiedMotion, robot: CertifiedRobot, tolerances: MotionTolerances) -> MotionViolation:
    """Time in which nodes leave a force or a moment on the base that contacts could have balanced, since when."""
    states = states_of(motion, robot, motion.times_s)
    could_W = _within(_pressing(states), states.residual_W)
    forces, moments = (np.linalg.norm(could_W[:, part], axis=1) for part in (slice(0, 3), slice(3, 6)))
    balanced = (forces <= tolerances.node_N) & (moments <= tolerances.node_Nm)
    balanced |= (forces > tolerances.residual_N) | (moments > tolerances.residual_Nm)
    lasts = 0.5 * (np.diff(states.times, prepend=states.times[0]) + np.diff(states.times, append=states.times[-1]))
    first = float(states.times[np.argmin(balanced)])  # 0 where all are
    return MotionViolation("unbalanced", float(lasts[~balanced].sum()), tolerances.unbalanced_s, "s", first)


def _pressing(states: States) -> Array:
    """(n, 6, 3 C) wrenches of forces at the corners that press, zero of the others."""
    count = len(states.times)
    grasp = grasp_of(states.corners_W - states.base_W[:, None, None]).reshape(count, -1, 6, 3)
    sizes = np.linalg.norm(states.corner_forces_W, axis=3).reshape(count, -1)
    presses = sizes > PRESSES * np.maximum(sizes.max(axis=1, keepdims=True, initial=0.0), 1e-9)
    return np.asarray((grasp * presses[:, :, None, None]).transpose(0, 2, 1, 3).reshape(count, 6, -1))


def _within(grasp: Array, residual_W: Array) -> Array:
    """(n, 6) the parts of wrenches that forces at the corners that press could give."""
    vectors, sizes, _ = np.linalg.svd(grasp, full_matrices=False)
    basis = vectors * (sizes > RANK * np.maximum(sizes[:, :1], 1e-9))[:, None, :]
    return np.asarray(np.einsum("kij,klj,kl->ki", basis, basis, residual_W))
