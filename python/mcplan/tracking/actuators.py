"""Motors: the torque that they have left at a speed, and how late and how smoothly they give what they are told.

Torque and speed, with v_max the URDF's velocity limit, taken as the no-load speed, and tau_max its effort:

    -tau_max min(1, (1 + v / v_max) / (1 - KNEE))  <=  tau  <=  tau_max min(1, (1 - v / v_max) / (1 - KNEE))

It is the line of a DC motor at full voltage, cut off by the current that it may take: full torque up to KNEE of the
no-load speed, then less along a straight line, none at v_max; braking torque is unreduced. A joint that something else
drives beyond v_max is braked along the same line.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Ratio of the no-load speed up to which a motor has its full torque.
KNEE = 0.8


@dataclass(frozen=True)
class TorqueSpeed:
    """Torques that the motors of nj joints have at a speed.

    Attributes:
        torque_limits: (nj,) [N m].
        velocity_limits: (nj,) no-load speeds [rad/s]; infinite: full torque at every speed.
    """

    torque_limits: Array
    velocity_limits: Array

    @classmethod
    def of(cls, torque_limits: Array, velocity_limits: Array, limited: bool = True) -> TorqueSpeed:
        """Of a URDF's limits, in which a velocity of 0 says that none is known; `limited` off: torques alone."""
        known = (np.asarray(velocity_limits, float) > 0.0) & limited
        return cls(np.asarray(torque_limits, float), np.where(known, velocity_limits, np.inf))

    @cached_property
    def stall_torques(self) -> Array:
        """(nj,) where the line at full voltage meets speed 0 [N m]."""
        return self.torque_limits / (1.0 - KNEE)

    @cached_property
    def slopes(self) -> Array:
        """(nj,) torque lost with speed at full voltage [N m s/rad]."""
        return self.stall_torques / self.velocity_limits

    def bounds(self, velocities: Array) -> tuple[Array, Array]:
        """Smallest and largest torque (nj,) at speeds (nj,) [rad/s]; the former is never above the latter."""
        fast = np.asarray(velocities, float) / self.velocity_limits
        low = np.maximum(np.minimum((1.0 + fast) / (1.0 - KNEE), 1.0), -1.0)  # np.clip takes three times as long
        high = np.maximum(np.minimum((1.0 - fast) / (1.0 - KNEE), 1.0), -1.0)
        return -self.torque_limits * low, self.torque_limits * high


class Lag:
    """Torques that come late and smoothed: a pure delay, then a first order lag.

    Args:
        step_s: Time from one call to the next.
        delay_s: Pure delay; rounded to steps.
        bandwidth_hz: Of the first order lag; 0: none.
    """

    def __init__(self, step_s: float, delay_s: float = 0.0, bandwidth_hz: float = 0.0) -> None:
        self._waiting: deque[Array] = deque()
        self._delay = round(delay_s / step_s)
        self._rate = 1.0 if bandwidth_hz <= 0.0 else 1.0 - np.exp(-2.0 * np.pi * bandwidth_hz * step_s)
        self._given: Array | None = None

    @property
    def acts(self) -> bool:
        """Whether torques come otherwise than they are told."""
        return self._delay > 0 or self._rate < 1.0

    def after(self, told: Array) -> Array:
        """The torques of this step (nj,), of those that the motors are told (nj,); the first ones act from the start."""
        while len(self._waiting) <= self._delay:
            self._waiting.append(np.array(told, float))
        told = self._waiting.popleft()
        self._given = told if self._given is None else self._given + self._rate * (told - self._given)
        return self._given
