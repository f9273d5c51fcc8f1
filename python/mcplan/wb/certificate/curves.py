"""What the certificate is about over time, for plots and pages."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .contacts import angles_between
from .distances import distance_curve
from .flight import flights
from .footholds import footholds_of, standing
from .inputs import CertifiedMotion
from .robot import certified_robot
from .states import equally_spaced, states_of
from .terrain import heights_over

Array = NDArray[np.float64]

#: Instants at which the distance of links is worked out [1/s]: each takes some exact distances of meshes.
DISTANCE_RATE = 50.0


@dataclass(frozen=True, eq=False)
class MotionCurves:
    """Measures of a motion at N instants, of a robot with J moving joints and L end-effectors.

    Attributes:
        times_s: (N,) [s].
        joints: (J,) names.
        torque_use, speed_use: (N, J) over their limits; 0 where there is none.
        range_use: (N, J) position in the joint's range, -1 at its lower limit and 1 at its upper; 0 without limits.
        residual: (N, 2) force [N] and moment [N m] on the base that no contact gives.
        com_off_m: (N,) distance of the CoM from the plan's [m].
        drift_m, drift_deg: (N, L) of end-effectors in contact from their footholds [m, degrees], NaN in the air.
        height_m: (N, L) of end-effectors in the air over the terrain [m], NaN in contact.
        distance_times_s: (K,) instants of the distances [s].
        distance_m: (K,) distance of the nearest two links that count [m], inf without collision shapes.
        links: (K,) their names.
        flights: Begin and end of each stretch without contact [s].
    """

    times_s: Array
    joints: tuple[str, ...]
    torque_use: Array
    speed_use: Array
    range_use: Array
    residual: Array
    com_off_m: Array
    drift_m: Array
    drift_deg: Array
    height_m: Array
    distance_times_s: Array
    distance_m: Array
    links: list[str]
    flights: list[tuple[float, float]]


def curves_of(motion: CertifiedMotion, rate_hz: float = 200.0) -> MotionCurves:
    """Measures of a motion at about a rate [1/s], start and end included."""
    robot = certified_robot(motion)
    states = states_of(motion, robot, equally_spaced(motion, 1.0 / rate_hz))
    times, shape = states.times, states.contacts.shape
    drift, angle, height = (np.full(shape, np.nan) for _ in range(3))
    for foothold in (footholds := footholds_of(motion.plan)):
        e, here = foothold.end_effector, standing(times, foothold)
        drift[here, e] = np.linalg.norm(states.positions_W[here, e] - foothold.position_W, axis=1)
        angle[here, e] = np.degrees(angles_between(foothold.rotation_W, states.rotations_W[here, e]))
    for e in range(shape[1]):
        own = [standing(times, foothold) for foothold in footholds if foothold.end_effector == e]
        free = ~np.any(own or [np.zeros(len(times), bool)], axis=0)
        if free.any():
            height[free, e] = heights_over(motion, states, e, np.flatnonzero(free))
    residual = states.residual_W.reshape(-1, 2, 3)
    com_W = np.asarray(motion.plan.sample(times).com_W)
    middle, half = 0.5 * (robot.high + robot.low), 0.5 * (robot.high - robot.low)
    bounded = np.isfinite(half) & (half > 0.0)
    angles = states.coordinates[:, 6:]
    ranges = np.where(bounded, (angles - np.where(bounded, middle, 0.0)) / np.where(bounded, half, 1.0), 0.0)
    few = np.arange(0, len(times), max(1, round(rate_hz / DISTANCE_RATE)))
    apart, links = distance_curve(robot, states, few)
    return MotionCurves(
        times_s=times,
        joints=robot.names,
        torque_use=np.abs(states.tau) / robot.effort,
        speed_use=np.abs(states.rates[:, 6:]) / robot.speed,
        range_use=ranges,
        residual=np.linalg.norm(residual, axis=2),
        com_off_m=np.linalg.norm(states.com_W - com_W, axis=1),
        drift_m=drift,
        drift_deg=angle,
        height_m=height,
        distance_times_s=times[few],
        distance_m=apart,
        links=links,
        flights=flights(motion),
    )
