"""What a centroidal motion breaks between the instants at which a planner looked: the same measures for every planner.

A motion is sampled each millisecond. Nothing here knows who planned it, and nothing comes from mcplan's checker.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

WINDOW = 20  #: Samples over which the balance of moments is averaged.


@dataclass(frozen=True)
class Samples:
    """A motion at N instants, of a robot with E feet. World frame W, SI units."""

    times: Array  #: (N) [s]
    com_W: Array  #: (N, 3) [m]
    com_acceleration_W: Array  #: (N, 3) [m/s^2]
    base_rpy: Array  #: (N, 3) [rad]
    angular_momentum_W: Array  #: (N, 3), about the CoM [kg m^2/s]
    contacts: NDArray[np.bool_]  #: (N, E)
    feet_W: Array  #: (N, E, 3) [m]
    forces_W: Array  #: (N, E, 3), on the robot [N]
    moments_W: Array  #: (N, E, 3), on the robot about the foot's position [N m]


@dataclass(frozen=True)
class Limits:
    """What the robot and the scene allow."""

    mass: float  #: [kg]
    gravity: float  #: [m/s^2]
    friction: float  #: of the cone
    reach_min: Array  #: (E, 3), of the foot from the CoM in the base's axes [m]
    reach_max: Array  #: (E, 3)
    profile: list[tuple[float, float, float]]  #: level pieces of the ground: from x, to x, height [m]


@dataclass(frozen=True)
class Violations:
    """The largest of each over all instants; zero where a limit is kept."""

    force_N: float  #: of Newton's law
    moment_Nm: float  #: of Euler's law
    cone_N: float  #: tangential force beyond the friction cone
    pull_N: float  #: normal force below zero
    reach_mm: float  #: beyond the reach box
    slide_mm: float  #: of a foot in contact from where it came into contact
    under_mm: float  #: of a foot under the level pieces of the ground
    beside_mm: float  #: of a foot in contact from the height of the level piece it stands on; infinite over none

    def row(self) -> dict[str, float]:
        """By name."""
        return asdict(self)


def rotations(rpy: Array) -> Array:
    """Base to world (N, 3, 3): R_z(yaw) R_y(pitch) R_x(roll)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy).T, np.sin(rpy).T
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def balance(samples: Samples, limits: Limits) -> tuple[float, float]:
    """Largest residuals of m (a - g) = sum f and of dL/dt = sum (p - c) x f + n [N, N m].

    The second is an average over 20 ms, L(t + 20 ms) - L(t) less the integral of the moments: forces may jump where
    contacts change, and a difference over two milliseconds would tell of the jump.
    """
    weight = np.array([0.0, 0.0, limits.mass * limits.gravity])
    linear = limits.mass * samples.com_acceleration_W + weight - samples.forces_W.sum(axis=1)
    arms = samples.feet_W - samples.com_W[:, None, :]
    moment = (np.cross(arms, samples.forces_W) + samples.moments_W).sum(axis=1)
    steps = np.diff(samples.times)[:, None] * (moment[1:] + moment[:-1]) / 2.0
    impulse = np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    error = samples.angular_momentum_W - impulse
    span = samples.times[WINDOW:] - samples.times[:-WINDOW]
    angular = np.linalg.norm(error[WINDOW:] - error[:-WINDOW], axis=1) / span
    return float(np.linalg.norm(linear, axis=1).max()), float(angular.max())


def reach(samples: Samples, limits: Limits) -> float:
    """Largest distance of a foot in contact from its reach box, by axis [m]."""
    in_base = np.einsum("nij,nei->nej", rotations(samples.base_rpy), samples.feet_W - samples.com_W[:, None, :])
    beyond = np.maximum(limits.reach_min - in_base, in_base - limits.reach_max).max(axis=2)
    return float(np.where(samples.contacts, beyond, 0.0).max(initial=0.0))


def slide(samples: Samples) -> float:
    """Largest way of a foot in contact from where its contact began [m]."""
    most = 0.0
    for e in range(samples.contacts.shape[1]):
        begun = None
        for k, touching in enumerate(samples.contacts[:, e]):
            begun = (k if begun is None else begun) if touching else None
            if begun is not None:
                most = max(most, float(np.linalg.norm(samples.feet_W[k, e] - samples.feet_W[begun, e])))
    return most


def ground(samples: Samples, limits: Limits) -> tuple[float, float]:
    """Largest depth of a foot under level pieces, and largest height error of a foot in contact [m]."""
    under, beside = 0.0, 0.0
    for foot, contact in zip(samples.feet_W.swapaxes(0, 1), samples.contacts.T, strict=True):
        height = np.full(len(foot), np.nan)
        for begin, end, z in limits.profile:
            height = np.where((begin <= foot[:, 0]) & (foot[:, 0] <= end), z, height)
        under = max(under, float(np.nanmax(height - foot[:, 2], initial=0.0)))
        apart = np.abs(foot[:, 2] - height)[contact]
        beside = max(beside, float("inf") if np.isnan(apart).any() else float(apart.max(initial=0.0)))
    return under, beside


def measure(samples: Samples, limits: Limits) -> Violations:
    """All measures of a motion; the ground's normals are vertical."""
    force, moment = balance(samples, limits)
    normal, tangential = samples.forces_W[..., 2], np.linalg.norm(samples.forces_W[..., :2], axis=2)
    cone = np.where(samples.contacts, tangential - limits.friction * np.maximum(normal, 0.0), 0.0)
    under, beside = ground(samples, limits)
    return Violations(
        force_N=force,
        moment_Nm=moment,
        cone_N=float(cone.max(initial=0.0)),
        pull_N=float(-normal.min(initial=0.0)),
        reach_mm=1e3 * reach(samples, limits),
        slide_mm=1e3 * slide(samples),
        under_mm=1e3 * under,
        beside_mm=1e3 * beside,
    )
