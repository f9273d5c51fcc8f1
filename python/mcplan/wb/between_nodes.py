"""Contact forces between the solver's nodes: corrected at many instants, so that what is linear in between balances.

Forces f at corners that balance at the nodes leave a wrench r on the base between them. At a finer set of nodes the forces are
changed by d with G d = r, of least sum |d_c|^2 / n_c^2 with the normal forces n_c: corners that hardly press hardly change, and
forces stay in their cones.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .knots import subdivided, with_knots

if TYPE_CHECKING:
    from .motion import Motion

Array = NDArray[np.float64]

#: Steps between instants at which forces are corrected [s].
STEP_S = 0.005
#: Singular values below this ratio of the largest are directions in which the contacts give no wrench.
RANK = 1e-10


def balanced(motion: Motion, step_s: float = STEP_S) -> Motion:
    """The same motion with nodes at most step_s apart and forces that balance the base at all of them."""
    times = subdivided(motion.times_s, step_s)
    interval = np.searchsorted(motion.times_s, 0.5 * (times[1:] + times[:-1]), side="right") - 1
    finer = replace(
        motion,
        times_s=times,
        coefficients=with_knots(motion.times_s, motion.coefficients, times),
        corner_forces_S=motion.forces(times),
        contacts=motion.contacts[interval],
    )
    return replace(finer, corner_forces_S=finer.corner_forces_S + _changes(finer))


def _changes(motion: Motion) -> Array:
    """(n + 1, L, 4, 3) by which the forces at the nodes are changed, in the frames of soles."""
    states, forces_S = motion.sample(motion.times_s), motion.corner_forces_S
    count = len(states)
    from .free_flyer import rotations

    base = rotations(motion.coordinates(motion.times_s)[0][:, 3:6])
    turned = np.einsum("kji,kejl->keil", base, states.rotations_W)  # soles in the axes of the base
    ends_B = np.einsum("kji,kej->kei", base, states.end_effectors_W - states.q[:, None, :3])
    corners_B = ends_B[:, :, None] + np.einsum("keij,epj->kepi", turned, motion.corner_points_S)
    skew = np.zeros((*corners_B.shape, 3))
    x, y, z = np.moveaxis(corners_B, -1, 0)
    skew[..., 0, 1], skew[..., 0, 2], skew[..., 1, 2] = -z, y, -x
    skew[..., 1, 0], skew[..., 2, 0], skew[..., 2, 1] = z, -y, x
    grasp = np.concatenate([np.broadcast_to(turned[:, :, None], skew.shape), skew @ turned[:, :, None]], axis=-2)
    pushes = np.maximum(forces_S[..., 2], 0.0)
    weights = (pushes / np.maximum(pushes.max(axis=(1, 2)), 1e-9)[:, None, None]) ** 2
    gram = np.einsum("kec,kecij,keclj->kil", weights, grasp, grasp)
    multipliers = np.einsum("kij,kj->ki", np.linalg.pinv(gram, rcond=RANK, hermitian=True), states.base_residual_B)
    changes = weights[..., None] * np.einsum("kecij,ki->kecj", grasp, multipliers)
    return changes.reshape(count, *forces_S.shape[1:])
