"""What acts on the robot that its controller's model does not know: loads, which last, and pushes, which come and go."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mcplan._core.online import FeltPush, PushObserver

from .unknown_load import UnknownLoad

Array = NDArray[np.float64]

#: Lag through which a push is taken off what is asked of the CoM [s]. Without one, soles that roll on an edge, of which the
#: model knows nothing, swing up with what is done about it.
LAG_S = 0.1


class UnknownForces:
    """Estimates the acceleration of the CoM that the model does not explain. Call once a control step.

    Along gravity it is a load's, through a long lag (UnknownLoad); on the level it is a push's, felt at once
    (PushObserver), and from the time for which it has lasted comes what to plan for.

    Attributes:
        acceleration_W: (3,) of the CoM by load and push, through their lags [m/s^2].
    """

    def __init__(self, dt_s: float) -> None:
        """
        Args:
            dt_s: Time between two calls.
        """
        self.dt_s = dt_s
        self._load, self._pushed = UnknownLoad(dt_s), PushObserver()
        self._promised_W: Array | None = None
        self.acceleration_W = np.zeros(3)

    def update(self, velocity_W: Array, as_expected: bool) -> None:
        """Estimate anew.

        Args:
            velocity_W: (3,) of the CoM, as measured [m/s].
            as_expected: Whether just those end-effectors are in contact, one at least, of which the program thought so.
        """
        self.acceleration_W[2] = self._load.update(float(velocity_W[2]), as_expected)
        promised_W = self._promised_W[:2] if as_expected and self._promised_W is not None else None
        self._pushed.update(velocity_W[:2], promised_W, self.dt_s)
        self._promised_W = None
        lags = self.push.acceleration_W - self.acceleration_W[:2]
        self.acceleration_W[:2] += min(self.dt_s / LAG_S, 1.0) * lags

    def predict(self, acceleration_W: Array) -> None:
        """Tell what the program's solution makes the CoM do, (3,) by the model alone [m/s^2]."""
        self._promised_W = acceleration_W
        self._load.predict(float(acceleration_W[2]))

    @property
    def push(self) -> FeltPush:
        """The push that is felt."""
        return self._pushed.push
