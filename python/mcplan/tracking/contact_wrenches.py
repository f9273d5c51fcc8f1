"""Contact forces that balance a posture: near to the plan's, within soles and friction.

The plan's forces balance a lumped mass. The links of the robot ask for a little more:
legs that swing, a mass that is not quite the plan's. Without a correction that difference would be a wrench on the base
that nothing balances, and the torques of the joints would be wrong by it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Weight of the plan's forces against the balance of the base, and of small forces at corners against both.
REFERENCE, SMALL = 1e-2, 1e-4


@dataclass(frozen=True)
class Contact:
    """An end-effector on a surface.

    Attributes:
        points_W: (p, 3) corners of the sole or the point [m].
        normal_W: (3,) normal of the surface.
        friction: Friction coefficient of the surface; infinite: a grasp, forces in all directions.
        force_W: (3,) the plan's force [N].
        position_W: (3,) position of the end-effector, about which moments are taken [m].
        jacobian: (6, nv) Jacobian of the end-effector, world's axes.
        moment_W: (3,) the plan's moment about position_W [N m]; None: it leaves the centre of pressure open.
    """

    points_W: Array
    normal_W: Array
    friction: float
    force_W: Array
    position_W: Array
    jacobian: Array
    moment_W: Array | None = None


def balanced_wrenches(contacts: list[Contact], base: Array, length_m: float) -> tuple[list[Array], Array]:
    """Wrenches of the contacts that balance what the base needs.

    Args:
        contacts: Those that the plan has at this instant.
        base: (6,) generalised force that must come from the contacts [N, N m].
        length_m: Length by which moments are divided to weigh them against forces, e.g. the height of the CoM.

    Returns:
        Wrench on the robot of each contact, (6,) about its position, world's axes [N, N m]; and (6,) what of `base`
        they cannot balance.
    """
    from scipy.optimize import nnls

    if not contacts:
        return [], base
    maps = [_generators(contact) for contact in contacts]  # (6, g) each
    bases = [contact.jacobian[:, :6].T @ generators for contact, generators in zip(contacts, maps, strict=True)]
    scale = np.array([1.0, 1.0, 1.0, 1.0 / length_m, 1.0 / length_m, 1.0 / length_m])
    count = sum(m.shape[1] for m in maps)
    reference, desired = np.zeros((6 * len(contacts), count)), np.zeros(6 * len(contacts))
    start = 0
    for i, (contact, generators) in enumerate(zip(contacts, maps, strict=True)):
        columns = slice(start, start + generators.shape[1])
        reference[6 * i : 6 * i + 3, columns], desired[6 * i : 6 * i + 3] = generators[:3], contact.force_W
        if contact.moment_W is not None:
            reference[6 * i + 3 : 6 * i + 6, columns] = generators[3:] / length_m
            desired[6 * i + 3 : 6 * i + 6] = contact.moment_W / length_m
        start += generators.shape[1]
    matrix = np.vstack([scale[:, None] * np.hstack(bases), REFERENCE * reference, SMALL * np.eye(count)])
    amounts, _ = nnls(matrix, np.concatenate([scale * base, REFERENCE * desired, np.zeros(count)]), maxiter=50 * count)
    wrenches, start = [], 0
    for generators in maps:
        wrenches.append(generators @ amounts[start : start + generators.shape[1]])
        start += generators.shape[1]
    return wrenches, base - np.hstack(bases) @ amounts


def _generators(contact: Contact) -> Array:
    """Wrenches (6, g) whose sums with amounts >= 0 are those that a contact can give."""
    normal = contact.normal_W
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    first /= np.linalg.norm(first)
    across = np.cross(normal, first)
    if np.isinf(contact.friction):
        edges = np.vstack([np.eye(3), -np.eye(3)])
    else:
        edges = np.array([normal + contact.friction * side for side in (first, -first, across, -across)])
    columns = [
        np.concatenate([edge, np.cross(point - contact.position_W, edge)])
        for point in contact.points_W
        for edge in edges
    ]
    return np.array(columns).T
