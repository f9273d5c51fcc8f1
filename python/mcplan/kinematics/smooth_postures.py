"""Postures without jumps in what a plan leaves open: torso, arms, the rotation of the base."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .inverse_kinematics import Postures, follow

if TYPE_CHECKING:
    from .samples import Samples
    from .urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Standard deviation of the running mean [s]; number of passes of mean and inverse kinematics.
SPREAD, PASSES = 0.15, 3


def nearest(urdf_model: UrdfModel, samples: Samples, one: Postures, other: Postures) -> Postures:
    """At every sample the posture that misses the plan less: a search from one side may end where another does not.

    What counts is the largest miss of the CoM, end-effectors in contact and feet, also in the air.
    """
    feet = np.array([end.kind == "foot" for end in urdf_model.robot.end_effectors])
    counts = (samples.surfaces >= 0) | feet
    misses = [np.maximum(p.com_misses, np.where(counts, p.end_misses, 0.0).max(axis=1)) for p in (one, other)]
    first = (misses[0] <= misses[1])[:, None]
    return Postures.of(
        urdf_model,
        samples,
        np.where(first, one.configurations, other.configurations),
        np.where(first[:, 0], one.com_misses, other.com_misses),
        np.where(first, one.end_misses, other.end_misses),
        np.where(first, one.tilts, other.tilts),
    )


def smoothed(urdf_model: UrdfModel, samples: Samples, postures: Postures) -> Postures:
    """Postures that follow the plan almost as well, without the jumps of those that `follow` finds.

    Where a foot leaves the ground and need no longer lie flat, torso and base go back to the robot's posture at once.
    Here whatever the plan leaves open goes through running means of the postures before and after.
    """
    for _ in range(PASSES):
        postures = follow(urdf_model, samples, running_means(urdf_model, samples.times_s, postures.configurations))
    return postures


def running_means(urdf_model: UrdfModel, times_s: Array, configurations: Array) -> Array:
    """Running means (n, nq) of configurations: weights of a bell curve with the standard deviation SPREAD."""
    import pinocchio as pin  # type: ignore[import-untyped]

    result = np.empty_like(configurations)
    for n, q in enumerate(configurations):
        near = np.flatnonzero(np.abs(times_s - times_s[n]) <= 3.0 * SPREAD + 1e-9)
        weights = np.exp(-0.5 * ((times_s[near] - times_s[n]) / SPREAD) ** 2)
        away = np.array([pin.difference(urdf_model.model, q, configurations[k]) for k in near])
        result[n] = pin.integrate(urdf_model.model, q, weights @ away / weights.sum())
    return result
