"""``Plan.sample``: the states of a plan at many times, as arrays.

The class is compiled; the method is given to it here, as those of files are.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Plan, plan_samples
from mcplan.errors import InvalidInput, shown

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class PlanSamples:
    """States of a plan at N times, of a robot with L end-effectors; what each is, ``Plan.at`` says of a single time."""

    times: NDArray[np.float64]  #: (N) [s]
    phase: NDArray[np.int32]  #: (N)
    com_W: NDArray[np.float64]  #: (N, 3) [m]
    com_velocity_W: NDArray[np.float64]  #: (N, 3) [m/s]
    com_acceleration_W: NDArray[np.float64]  #: (N, 3) [m/s^2]
    base_rpy: NDArray[np.float64]  #: (N, 3) [rad]
    base_rpy_rate: NDArray[np.float64]  #: (N, 3) [rad/s]
    base_quat_wxyz: NDArray[np.float64]  #: (N, 4)
    angular_momentum_W: NDArray[np.float64]  #: (N, 3), about the CoM [kg m^2/s]
    surfaces: NDArray[np.int32]  #: (N, L), index into scene.surfaces, -1: free
    end_effectors_W: NDArray[np.float64]  #: (N, L, 3) [m]
    end_effector_velocities_W: NDArray[np.float64]  #: (N, L, 3) [m/s]
    end_effector_yaw: NDArray[np.float64]  #: (N, L) [rad]
    forces_W: NDArray[np.float64]  #: (N, L, 3), on the robot [N]
    moments_W: NDArray[np.float64]  #: (N, L, 3), on the robot [N m]
    centers_of_pressure_W: NDArray[np.float64]  #: (N, L, 3) [m]

    def __len__(self) -> int:
        return len(self.times)


def sample(self: Plan, times: ArrayLike) -> PlanSamples:
    """States at many times, as arrays: what ``at`` says of each, in closed form.

    Args:
        times: One-dimensional [s], each in 0 to duration(), in any order.

    Raises:
        InvalidInput: A time is no number or lies outside; it is named by its index.
        InvalidPlan: The plan's arrays do not fit together.
    """
    try:
        asked = np.array(times, dtype=float)
    except (TypeError, ValueError):
        raise InvalidInput("times", "must be an array of numbers", shown(times)) from None
    if asked.ndim != 1:
        raise InvalidInput("times", "must have one dimension", f"{asked.ndim}")
    return PlanSamples(times=asked, **plan_samples(self, asked.tolist()))


def _give() -> None:
    owner: Any = Plan
    sample.__qualname__ = "Plan.sample"
    # Types, not texts: those who ask the class for signatures would look for their names in _core.
    sample.__annotations__ = {"times": Any, "return": PlanSamples}
    owner.sample = sample


_give()
