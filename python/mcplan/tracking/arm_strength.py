"""What an arm can push: the largest force at an end-effector that its joints' torque limits allow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidOptions
from mcplan.files import strength
from mcplan.kinematics.urdf_model import own_joints

if TYPE_CHECKING:
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Directions of the force that the robot exerts on its surroundings; base upright, x forward.
DIRECTIONS = {
    "down": (0.0, 0.0, -1.0),
    "up": (0.0, 0.0, 1.0),
    "forward": (1.0, 0.0, 0.0),
    "backward": (-1.0, 0.0, 0.0),
    "left": (0.0, 1.0, 0.0),
    "right": (0.0, -1.0, 0.0),
}


@dataclass(frozen=True)
class Strength:
    """Forces that an end-effector can exert in one direction, over many postures.

    Attributes:
        end_effector: Its name.
        direction: Key of DIRECTIONS.
        forces_N: (n,) ascending.
    """

    end_effector: str
    direction: str
    forces_N: Array

    def quantile_N(self, fraction: float) -> float:
        """Force that this fraction of the postures does not exceed [N]."""
        return float(np.quantile(self.forces_N, fraction))


def largest_force_N(urdf_model: UrdfModel, end: int, configuration: Array, direction_W: Array) -> tuple[float, str]:
    """Largest force that an end-effector can exert in a direction with the robot at rest; see mcplan.files.strength.

    Args:
        urdf_model: The robot's model.
        end: Index of the end-effector.
        configuration: (nq,) Pinocchio's order.
        direction_W: (3,) direction of the force on the surroundings, of any length but 0.

    Returns:
        Force [N], 0 if the arm cannot carry its own weight, infinite if no joint limits the force; and the joint that
        reaches its torque limit first.
    """
    return strength.largest_force_N(
        urdf_model.model,
        urdf_model.model.createData(),
        urdf_model.frames[end],
        np.asarray(configuration, float),
        direction_W,
    )


def random_strengths(urdf_model: UrdfModel, end: int, samples: int = 2000, seed: int = 0) -> list[Strength]:
    """Strength over postures drawn evenly within the limits of the joints that move the end-effector but not the other ones.

    Torso joints keep the robot's posture, since they carry the other arm, too; their torque limits count.

    Args:
        urdf_model: The robot's model.
        end: Index of the end-effector.
        samples: Number of postures.
        seed: Seed of their choice.

    Returns:
        One Strength for each of DIRECTIONS.

    Raises:
        InvalidOptions: samples is below 1.
    """
    if samples < 1:
        raise InvalidOptions("samples", "must be at least 1", str(samples))
    model, rng = urdf_model.model, np.random.default_rng(seed)
    own = own_joints(urdf_model, end)
    index = [model.joints[j].idx_q for j in own]
    low, high = model.lowerPositionLimit[index], model.upperPositionLimit[index]
    data, forces = model.createData(), np.empty((samples, len(DIRECTIONS)))
    for n in range(samples):
        q = urdf_model.neutral.copy()
        q[index] = rng.uniform(low, high)
        for k, direction in enumerate(DIRECTIONS.values()):
            forces[n, k], _ = strength.largest_force_N(
                model, data, urdf_model.frames[end], q, np.array(direction), update=k == 0
            )
    name = urdf_model.robot.end_effectors[end].name
    return [Strength(name, direction, np.sort(forces[:, k])) for k, direction in enumerate(DIRECTIONS)]
