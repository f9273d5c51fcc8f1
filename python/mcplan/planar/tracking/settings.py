"""Feedback on the joints and hardness of the contacts: plain data with the values that worked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mcplan.errors import InvalidOptions

if TYPE_CHECKING:
    from mcplan._core import PlanarRobot


@dataclass(frozen=True)
class ContactSettings:
    """How hard MuJoCo's contacts are.

    Attributes:
        time_constant_s: Time constant of a contact's return to its surface, critically damped; at least two simulation steps.
        impedance: Between 0 and 1; the nearer to 1, the stiffer a contact is.
        friction_impedance: Stiffness of friction over that of normal contact (MuJoCo's impratio).
    """

    time_constant_s: float = 0.004
    impedance: float = 0.9
    friction_impedance: float = 10.0

    def validate(self) -> None:
        """Raise InvalidOptions naming the first field out of its range."""
        _require("contacts.time_constant_s", "must be above 0", self.time_constant_s, self.time_constant_s > 0)
        _require("contacts.impedance", "must lie between 0 and 1", self.impedance, 0 < self.impedance < 1)
        positive = self.friction_impedance > 0
        _require("contacts.friction_impedance", "must be above 0", self.friction_impedance, positive)


@dataclass(frozen=True)
class Feedback:
    """Of the joints: torque = planned + stiffness (q_plan - q) + damping (velocity_plan - velocity), within the limits.

    A robot on one foot falls over it unless the joints are stiffer than its weight times the height of its CoM, so that the
    weight is their unit. Damping is part of the motors in MuJoCo, which integrates it implicitly: feet are so light
    (0.003 kg m^2) that 10 N m s/rad computed once a millisecond would make them swing up.

    Attributes:
        stiffness: Over the robot's weight [m/rad].
        damping_s: Damping over stiffness [s].
    """

    stiffness: float = 2.0
    damping_s: float = 0.02

    def gains(self, robot: PlanarRobot) -> tuple[float, float]:
        """Stiffness [N m/rad] and damping [N m s/rad] of every joint of a robot."""
        stiffness = self.stiffness * robot.mass() * robot.gravity
        return stiffness, self.damping_s * stiffness

    def validate(self) -> None:
        """Raise InvalidOptions naming the first field out of its range."""
        _require("feedback.stiffness", "must not be negative", self.stiffness, 0 <= self.stiffness < np.inf)
        _require("feedback.damping_s", "must not be negative", self.damping_s, 0 <= self.damping_s < np.inf)


def _require(field: str, rule: str, value: float, holds: bool) -> None:
    if not holds:
        raise InvalidOptions(field, rule, str(value))
