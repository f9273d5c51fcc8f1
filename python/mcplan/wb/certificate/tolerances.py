"""The limits that a motion is held to."""

from __future__ import annotations

import math
import numbers
from dataclasses import dataclass, fields

from mcplan.errors import InvalidOptions, shown

#: Between two instants, at least and at most: farther apart, little of a motion would be looked at [s].
SAMPLE_S = (1e-5, 0.01)


@dataclass(frozen=True)
class MotionTolerances:
    """Accepted amounts of everything that the certificate looks at, at instants `sample_s` apart.

    Attributes:
        sample_s: Between two instants [s].
        consistency: Relative difference of what the motion says of its states from what its numbers mean.
        contacts_s: Time in which its contacts are not those of the plan [s].
        position: Of a joint beyond its limit [rad or m].
        velocity_use: Largest speed of a joint over its limit.
        torque_use: Largest torque of a joint over its limit.
        torque_step: Largest change of a torque within a millisecond, over its limit.
        friction_N: Tangential force of a corner beyond what friction holds [N].
        pull_N: Pull of a corner, or force of an end-effector that is free [N].
        force_use: Largest force of an end-effector over its max_force; a thousandth more is what the check of plans accepts.
        center_of_pressure_m: Outside of the sole, and of a corner outside of it [m].
        polygon_m: Centre of pressure outside of the surface's polygon [m]: what the check of plans accepts.
        drift_m: Of an end-effector in contact from the plan's foothold [m].
        drift_deg: Of a sole in contact from it [degrees].
        drift_speed: Of the points of an end-effector in contact [m/s].
        contact_distance_m: Of an end-effector in contact from the plane of its surface [m]: what the check of plans accepts.
        node_N, node_Nm: Wrench on the base with which a node is balanced, of what contacts can balance.
        unbalanced_s: Time in which nodes are not [s].
        residual_N, residual_Nm: Wrench on the base that the shipped contact forces leave, at the base's origin.
        corrected_N, corrected_Nm: What is left when they are changed as little as needed at each instant, within cones, soles
            and torque limits.
        clearance_m: Depth of a swinging sole in the terrain [m]: what drift is accepted.
        mid_swing_m: Least height of a foot's sole over the terrain in the middle fifth of its swing [m].
        self_distance_m: Least distance of two links that do not share a joint, and are not nearer in the robot's posture [m].
        landing_m, landing_deg, landing_speed: Of the base, and of feet that land, from where the flight ends if its
            dynamics are integrated exactly [m, degrees, m/s].
        rest: Largest velocity of any coordinate at start and end, where the plan is at rest [m/s, rad/s].
        com_rms_m, com_max_m: Distance of the CoM from the plan's [m].
    """

    sample_s: float = 1e-3
    consistency: float = 1e-8
    contacts_s: float = 1e-6
    position: float = 1e-6
    velocity_use: float = 1.0
    torque_use: float = 1.0
    torque_step: float = 0.05
    friction_N: float = 1e-3
    pull_N: float = 1e-3
    force_use: float = 1.001
    center_of_pressure_m: float = 1e-6
    polygon_m: float = 1e-3
    drift_m: float = 1e-4
    drift_deg: float = 0.05
    drift_speed: float = 0.02
    contact_distance_m: float = 1e-3
    node_N: float = 1e-6
    node_Nm: float = 1e-6
    unbalanced_s: float = 0.1
    residual_N: float = 1.0
    residual_Nm: float = 1.0
    corrected_N: float = 1e-3
    corrected_Nm: float = 1e-3
    clearance_m: float = 1e-4
    mid_swing_m: float = 0.01
    self_distance_m: float = 0.005
    landing_m: float = 1e-3
    landing_deg: float = 0.1
    landing_speed: float = 0.02
    rest: float = 1e-3
    com_rms_m: float = 0.01
    com_max_m: float = 0.025

    def validate(self) -> None:
        """Raise InvalidOptions for a tolerance that is no number, or not above zero."""
        for item in fields(self):
            value = getattr(self, item.name)
            if isinstance(value, bool) or not isinstance(value, numbers.Real) or not finite(value):
                raise InvalidOptions(item.name, "must be a number", shown(value))
            if item.name == "sample_s" and not SAMPLE_S[0] <= float(value) <= SAMPLE_S[1]:
                raise InvalidOptions(item.name, f"must lie in [{SAMPLE_S[0]:g}, {SAMPLE_S[1]:g}] s", shown(value))
            if float(value) < 0.0:
                raise InvalidOptions(item.name, "must be at least 0", shown(value))


def finite(value: numbers.Real) -> bool:
    """Whether a number is one as a float, too."""
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number that is larger than any float
        return False
