"""Contact forces between the solver's nodes: corrected at many instants, so that what is linear in between balances.

Forces f at corners that balance at the nodes leave a wrench r on the base between them. At a finer set of nodes the forces are
changed by d with G d = r, of least sum |d_c|^2 / s_c^2, where s_c = mu f_z - |(f_x, f_y)| says how far a force is inside of
its cone: those at its edge hardly change. Where the change would leave a cone, a part of it is made.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .free_flyer import rotations
from .knots import subdivided, with_knots

if TYPE_CHECKING:
    from .motion import Motion
    from .motion_model import MotionModel

Array = NDArray[np.float64]

#: Steps between instants at which forces are corrected [s].
STEP_S = 0.005
#: Friction beyond which it makes no difference.
MOST_FRICTION = 10.0
#: Forces outside of their cone by less are not [N].
SMALL_N = 1e-6
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
    finer = with_model(finer, motion.model)
    return with_model(replace(finer, corner_forces_S=finer.corner_forces_S + _changes(finer)), motion.model)


def with_model(motion: Motion, model: MotionModel) -> Motion:
    """The motion, which then does not read its robot again."""
    vars(motion)["model"] = model
    return motion


def _changes(motion: Motion) -> Array:
    """(n + 1, L, 4, 3) by which the forces at the nodes are changed, in the frames of soles."""
    states, forces_S = motion.sample(motion.times_s), motion.corner_forces_S
    count = len(states)
    base = rotations(motion.coordinates(motion.times_s)[0][:, 3:6])
    turned = np.einsum("kji,kejl->keil", base, states.rotations_W)  # soles in the axes of the base
    ends_B = np.einsum("kji,kej->kei", base, states.end_effectors_W - states.q[:, None, :3])
    corners_B = ends_B[:, :, None] + np.einsum("keij,epj->kepi", turned, motion.corner_points_S)
    skew = np.zeros((*corners_B.shape, 3))
    x, y, z = np.moveaxis(corners_B, -1, 0)
    skew[..., 0, 1], skew[..., 0, 2], skew[..., 1, 2] = -z, y, -x
    skew[..., 1, 0], skew[..., 2, 0], skew[..., 2, 1] = z, -y, x
    grasp = np.concatenate([np.broadcast_to(turned[:, :, None], skew.shape), skew @ turned[:, :, None]], axis=-2)
    frictions = _friction(motion)[:, :, None]
    room = np.maximum(_room(forces_S, frictions), 0.0)
    weights = (room / np.maximum(room.max(axis=(1, 2)), 1e-9)[:, None, None]) ** 2
    gram = np.einsum("kec,kecij,keclj->kil", weights, grasp, grasp)
    multipliers = np.einsum("kij,kj->ki", np.linalg.pinv(gram, rcond=RANK, hermitian=True), states.base_residual_B)
    changes = (weights[..., None] * np.einsum("kecij,ki->kecj", grasp, multipliers)).reshape(count, *forces_S.shape[1:])
    return np.asarray(_within(forces_S, changes, frictions) * changes)


def _room(forces_S: Array, frictions: Array) -> Array:
    """(..., 4) mu f_z - |(f_x, f_y)|."""
    return np.asarray(frictions * forces_S[..., 2] - np.linalg.norm(forces_S[..., :2], axis=-1))


def _within(forces_S: Array, changes: Array, frictions: Array) -> Array:
    """(n + 1, 1, 1, 1) the largest of some parts of all changes at a node with which all forces are in their cones."""
    parts = np.zeros(len(forces_S))
    for part in np.linspace(0.05, 1.0, 20):
        inside = (_room(forces_S + part * changes, frictions) >= -SMALL_N).all(axis=(1, 2))
        parts = np.where(inside, part, parts)
    return parts[:, None, None, None]


def _friction(motion: Motion) -> Array:
    """(n + 1, L) friction of the surfaces in contact at the nodes; where one is made or broken there is no force."""
    frictions = np.array(
        [min(float(surface.friction), MOST_FRICTION) for surface in motion.plan.scene.surfaces] + [1.0]
    )
    touched = frictions[motion.contacts]
    return np.asarray(np.vstack([touched[:1], np.minimum(touched[:-1], touched[1:]), touched[-1:]]))
