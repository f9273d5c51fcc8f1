"""What the controller asks of joints: a posture to stay near to, or positions with their velocities and accelerations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class JointReferences:
    """Desired joints at n instants; after the last one they stay.

    Attributes:
        positions: (n, nj) [rad].
        velocities, accelerations: (n, nj) their derivatives; None: a posture, from which tasks may take joints away.
    """

    positions: Array
    velocities: Array | None = None
    accelerations: Array | None = None

    @staticmethod
    def of_posture(configurations: Array) -> JointReferences:
        """Of one configuration (nq,), or of one for each control step (n, nq)."""
        return JointReferences(np.atleast_2d(configurations)[:, 7:])

    @property
    def timed(self) -> bool:
        """Whether they say how joints move, not only near to where."""
        return self.velocities is not None

    def at(self, n: int) -> tuple[Array, Array | float, Array | float]:
        """Position, velocity and acceleration at control step n."""
        n = min(n, len(self.positions) - 1)
        return (
            self.positions[n],
            0.0 if self.velocities is None else self.velocities[n],
            0.0 if self.accelerations is None else self.accelerations[n],
        )
