"""Contact forces between the solver's nodes: corrected at many instants, so that what is linear in between balances.

Forces f at corners that balance at the nodes leave a wrench r on the base between them. At a finer set of nodes the forces are
changed by d with G d = r, of least sum |d_c|^2 / s_c^2, where s_c = mu f_n - |f_t| says how far a force is inside of its
cone: those at its edge hardly change. Where the change would leave a cone, a part of it is made, and the rest is tried again
from there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .free_flyer import rotations
from .knots import subdivided, with_knots
from .nodes import FINEST_S

if TYPE_CHECKING:
    from .motion import Motion
    from .motion_model import MotionModel

Array = NDArray[np.float64]

#: Times that forces are changed.
ROUNDS = 4
#: Friction beyond which it makes no difference.
MOST_FRICTION = 10.0
#: Forces outside of their cone by less are not [N].
SMALL_N = 1e-6
#: Singular values below this ratio of the largest are directions in which the contacts give no wrench.
RANK = 1e-10


def balanced(motion: Motion, step_s: float = FINEST_S) -> Motion:
    """The same motion with nodes at most step_s apart and forces that balance the base at all of them."""
    times = subdivided(motion.times_s, step_s)
    interval = np.searchsorted(motion.times_s, 0.5 * (times[1:] + times[:-1]), side="right") - 1
    finer = replace(
        motion,
        times_s=times,
        coefficients=with_knots(motion.times_s, motion.coefficients, times),
        corner_forces_S=np.zeros((len(times), *motion.corner_forces_S.shape[1:])),
        contacts=motion.contacts[interval],
    )
    at_nodes = np.searchsorted(times, motion.times_s)
    rotations_W = with_model(finer, motion.model).sample(times).rotations_W
    # Forces of points are linear in the world between nodes: their frames turn, and the solver's cones do not.
    forces_W = np.einsum("keij,kepj->kepi", rotations_W[at_nodes], motion.corner_forces_S)
    finer = with_forces(finer, _linear(motion.times_s, forces_W, times), rotations_W)
    forces_W, at = np.einsum("keij,kepj->kepi", rotations_W, finer.corner_forces_S), np.arange(len(times))
    for _ in range(ROUNDS):
        changes, parts = _changes(finer, at, forces_W[at])
        forces_W[at] += changes
        finer = with_forces(finer, forces_W, rotations_W)
        at = at[parts < 1.0]
        if at.size == 0:
            break
    return finer


def with_forces(motion: Motion, forces_W: Array, rotations_W: Array) -> Motion:
    """The motion with forces (n + 1, L, 4, 3) that the world's axes have, and soles rotated so (n + 1, L, 3, 3)."""
    forces_S = np.einsum("keji,kepj->kepi", rotations_W, forces_W)
    return with_model(replace(motion, corner_forces_S=forces_S), motion.model)


def _linear(nodes: Array, values: Array, times: Array) -> Array:
    i = np.clip(np.searchsorted(nodes, times, side="right") - 1, 0, len(nodes) - 2)
    ratio = ((times - nodes[i]) / (nodes[i + 1] - nodes[i])).reshape(-1, *(1,) * (values.ndim - 1))
    return np.asarray((1.0 - ratio) * values[i] + ratio * values[i + 1])


def with_model(motion: Motion, model: MotionModel) -> Motion:
    """The motion, which then does not read its robot again."""
    vars(motion)["model"] = model
    return motion


def _changes(motion: Motion, at: NDArray[np.int64], forces_W: Array) -> tuple[Array, Array]:
    """(k, L, 4, 3) by which the forces at k nodes are changed, and (k,) what part of what is missing that is."""
    states = motion.sample(motion.times_s[at])
    base = rotations(motion.coordinates(motion.times_s[at])[0][:, 3:6])
    missing = np.einsum("kij,khj->khi", base, states.base_residual_B.reshape(-1, 2, 3)).reshape(-1, 6)
    arms = np.einsum("keij,epj->kepi", states.rotations_W, motion.corner_points_S)
    arms += (states.end_effectors_W - states.q[:, None, :3])[:, :, None]
    grasp = np.zeros((*arms.shape[:3], 6, 3))
    x, y, z = np.moveaxis(arms, -1, 0)
    grasp[..., :3, :] = np.eye(3)
    grasp[..., 3, 1], grasp[..., 3, 2], grasp[..., 4, 2] = -z, y, -x
    grasp[..., 4, 0], grasp[..., 5, 0], grasp[..., 5, 1] = z, -y, x
    cones = _Cones.of(motion, at)
    room = np.maximum(cones.room(forces_W), 0.0)
    weights = (room / np.maximum(room.max(axis=(1, 2)), 1e-9)[:, None, None]) ** 2
    gram = np.einsum("kec,kecij,keclj->kil", weights, grasp, grasp)
    multipliers = np.einsum("kij,kj->ki", np.linalg.pinv(gram, rcond=RANK, hermitian=True), missing)
    changes = weights[..., None] * np.einsum("kecij,ki->kecj", grasp, multipliers)
    parts = cones.part(forces_W, changes)
    return parts[:, None, None, None] * changes, parts


@dataclass(frozen=True)
class _Cones:
    """Friction (k, L) and normals (k, L, 3) of the surfaces in contact at k nodes."""

    frictions: Array
    normals: Array

    @staticmethod
    def of(motion: Motion, at: NDArray[np.int64]) -> _Cones:
        surfaces = motion.plan.scene.surfaces
        frictions = np.array([min(float(surface.friction), MOST_FRICTION) for surface in surfaces] + [1.0])
        normals = np.array([polygon_normal(np.asarray(surface.vertices_W)) for surface in surfaces] + [[0.0, 0.0, 1.0]])
        before = np.vstack([motion.contacts[:1], motion.contacts])
        touched = np.where(before >= 0, before, np.vstack([motion.contacts, motion.contacts[-1:]]))
        return _Cones(frictions[touched[at]], normals[touched[at]])

    def room(self, forces_W: Array) -> Array:
        """(k, L, 4) how far forces are inside of their cones: friction times the normal force, less the tangential."""
        along = np.einsum("kepj,kej->kep", forces_W, self.normals)
        across = np.linalg.norm(forces_W - along[..., None] * self.normals[:, :, None], axis=-1)
        return np.asarray(self.frictions[:, :, None] * along - across)

    def part(self, forces_W: Array, changes: Array) -> Array:
        """(k,) the largest of some parts of all changes at a node with which all forces are in their cones."""
        parts = np.zeros(len(forces_W))
        for part in np.linspace(0.05, 1.0, 20):
            inside = (self.room(forces_W + part * changes) >= -SMALL_N).all(axis=(1, 2))
            parts = np.where(inside, part, parts)
        return parts
