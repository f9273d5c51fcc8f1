"""What the planner knows of the ground while the robot walks on it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .felt_ground import SlipSense, at_felt_heights, with_friction
from .true_scene import as_told, require_known

if TYPE_CHECKING:
    from mcplan._core import Scene

    from .options import OnlineOptions
    from .planner import MeasuredState

Array = NDArray[np.float64]


class KnownGround:
    """The scene that plans are made on: the first plan's, until the feet or somebody say otherwise.

    Args:
        planned: The scene of the first plan.
        true: The ground that is simulated, where it is another.
        online: ``felt_ground`` and ``told_at_s``.
        end_effectors: How many there are.
        force_min_N: Normal force from which on a contact says how slippery its surface is.

    Attributes:
        scene: As it is known now.
        felt: How often a surface was felt to be elsewhere, or more slippery, than it was known to be.
    """

    def __init__(
        self, planned: Scene, true: Scene | None, online: OnlineOptions, end_effectors: int, force_min_N: float
    ) -> None:
        if true is not None:
            require_known(true, planned)
        self.scene, self.felt = planned, 0
        self._planned, self._online = planned, online
        self._known = planned  # but for what is felt
        self._untold = true
        self._slips = SlipSense(end_effectors, force_min_N)

    def told(self, now_s: float) -> bool:
        """Whether the true ground becomes known now."""
        if self._untold is None or not now_s >= self._online.told_at_s:
            return False
        self.scene = self._known = as_told(self._untold, self._planned)
        self._untold = None
        return True

    def feel_heights(self, state: MeasuredState, speeds_m_s: Sequence[float]) -> bool:
        """Whether end-effectors stand higher or lower than they should; from then on their surfaces are known to be there.

        Args:
            state: The measured state.
            speeds_m_s: (e,) of the contact points.
        """
        if not self._online.felt_ground:
            return False
        moved = at_felt_heights(self.scene, state.contacts, list(state.knot.end_effectors_W), speeds_m_s)
        if moved is None:
            return False
        self.scene, self.felt = moved, self.felt + 1
        return True

    def unevenness_m(self) -> float:
        """How far surfaces have been felt to lie higher or lower than they were known to, at most [m]."""
        pairs = zip(self.scene.surfaces, self._known.surfaces, strict=True)
        return max((abs(float(felt.vertices_W[0][2] - known.vertices_W[0][2])) for felt, known in pairs), default=0.0)

    def feel_slips(
        self, surfaces: Sequence[int], forces_W: Sequence[Array], velocities_W: Sequence[Array]
    ) -> dict[int, float]:
        """Friction coefficients of surfaces on which end-effectors slip, by index, known from then on.

        Args:
            surfaces, forces_W, velocities_W: As for ``SlipSense.update``.
        """
        if not self._online.felt_ground:
            return {}
        found = self._slips.update(self.scene, surfaces, forces_W, velocities_W)
        if found:
            self.scene, self.felt = with_friction(self.scene, found), self.felt + len(found)
        return found
