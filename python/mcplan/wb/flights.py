"""What a motion is asked beside flights, where legs push off and land: smoothness, and forces that come and go on a ramp."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .nodes import SAME_S

if TYPE_CHECKING:
    from mcplan._core.wb import Problem
    from mcplan.kinematics.samples import Interval

    from .nodes import Nodes

Array = NDArray[np.float64]

#: Of the weights, throughout motions with a flight: legs have to accelerate to push off, and what costs more beside the flight
#: must not take the CoM off the plan's.
ACCELERATION, COM = 0.2, 3.0
#: Of the weights in flights and this near to them [s], and in what further time they fall to what they are elsewhere [s].
NEAR_ACCELERATION, NEAR_TORQUE = 10.0, 50.0
NEAR_S, FADE_S = 0.05, 0.05
#: How long before a take-off and after a landing a contact's load is limited [s], and to what, over the robot's weight: at the
#: take-off or landing, and that long away from it. Without, forces jump from several weights to none in a node
#: (measured: docs/theory/wb.md, "Cost").
RAMP_S, LEAST_LOAD, MOST_LOAD = 0.08, 0.4, 4.0


@dataclass(frozen=True)
class Flights:
    """(f,) instants at which the last contact is broken, and at which one is made again [s]."""

    starts_s: Array
    ends_s: Array

    @staticmethod
    def of(nodes: Nodes) -> Flights:
        """The flights of a plan."""
        free = np.concatenate([[False], (nodes.contacts < 0).all(axis=1), [False]])
        return Flights(nodes.times_s[free[1:] & ~free[:-1]], nodes.times_s[~free[1:] & free[:-1]])

    def set_weights(self, problem: Problem) -> None:
        """Let a problem's weights be those of a motion that flies, if it does."""
        if self.starts_s.size > 0:
            weights = problem.weights
            weights.acceleration *= ACCELERATION
            weights.com *= COM
            problem.weights = weights

    def factors(self, time_s: float) -> tuple[float, float]:
        """Of the weights of accelerations and of torques at an instant: 1, 1 far from flights."""
        away = np.maximum(self.starts_s - time_s, time_s - self.ends_s).min(initial=np.inf)
        near = float(np.clip((NEAR_S + FADE_S - away) / FADE_S, 0.0, 1.0))
        return NEAR_ACCELERATION**near, NEAR_TORQUE**near

    def load_max(self, interval: Interval, time_s: float) -> float:
        """The largest load of a contact at an instant, over the robot's weight; inf: it has no limit."""
        away = float("inf")
        if (np.abs(self.starts_s - interval.end_s) <= SAME_S).any():
            away = interval.end_s - time_s
        if (np.abs(self.ends_s - interval.start_s) <= SAME_S).any():
            away = min(away, time_s - interval.start_s)
        if away >= RAMP_S - SAME_S:
            return float("inf")
        return LEAST_LOAD + (MOST_LOAD - LEAST_LOAD) * max(away, 0.0) / RAMP_S
