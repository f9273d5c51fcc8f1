"""What the robot bears that its model does not know: a payload, or masses that are not the URDF's.

The CoM accelerates otherwise than the controller's program said it would. The difference, in the direction of gravity and
filtered,

    d/dt a = (a_measured - a_predicted - a) / T,

is what the load does to it, and is taken off what is asked for. A robot followed in time and place sinks by a / kp without
this, 15 mm with a tenth more mass; one whose plans begin where it is measured goes on sinking, since each of them forgets
that.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Time constant [s]: much longer than what a landing or a push does.
TIME_S = 3.0
#: Largest acceleration that is taken for a load's, a fifth of gravity [m/s^2].
LARGEST = 2.0


class UnknownLoad:
    """Estimates the vertical acceleration of the CoM that the model does not explain. Call once a control step."""

    def __init__(self, dt_s: float) -> None:
        """
        Args:
            dt_s: Time between two calls.
        """
        self.dt_s = dt_s
        self.acceleration = 0.0  # up [m/s^2]
        self._velocity: float | None = None
        self._predicted: float | None = None

    def update(self, velocity: float, as_expected: bool) -> float:
        """The estimate at this control step [m/s^2].

        Args:
            velocity: Of the CoM, up, as measured [m/s].
            as_expected: Whether just those end-effectors are in contact, one at least, of which the program thought so.
                Otherwise it is wrong for another reason than a load, or in flight, where all masses fall alike, and the
                estimate stays.
        """
        if as_expected and self._predicted is not None and self._velocity is not None:
            error = (velocity - self._velocity) / self.dt_s - self._predicted
            if np.isfinite(error):  # one bad reading must not stay in it for good
                self.acceleration += self.dt_s / TIME_S * (error - self.acceleration)
                self.acceleration = float(np.clip(self.acceleration, -LARGEST, LARGEST))
        self._velocity, self._predicted = velocity, None
        return self.acceleration

    def predict(self, acceleration: float) -> None:
        """Tell what the program's solution makes the CoM do, by the model alone, up [m/s^2]."""
        self._predicted = acceleration
