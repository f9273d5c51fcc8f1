"""Which end-effectors bear force: the plan's timing, corrected by what the ground says."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: A foot that meets the ground after this share of its swing has landed early; before, it has not left yet.
EARLY_SHARE = 0.7
#: Speed at which a foot that is late is lowered onto the ground [m/s], and how far [m].
SEARCH_SPEED, SEARCH_DEPTH = 0.15, 0.08


class Mode(Enum):
    """What an end-effector does."""

    FREE = "free"
    CONTACT = "contact"
    SEARCH = "search"  # the plan has it on the ground, the ground is not there yet


@dataclass
class Contact:
    """An end-effector's state.

    Attributes:
        mode: What it does.
        position_W, rotation_W: Where it came to stand, in contact.
        searched_s: Time spent in the search.
    """

    mode: Mode = Mode.FREE
    position_W: Array = field(default_factory=lambda: np.zeros(3))
    rotation_W: Array = field(default_factory=lambda: np.eye(3))
    searched_s: float = 0.0

    def update(self, planned: bool, touches: bool, swing_share: float, dt_s: float) -> bool:
        """Move on by a control step.

        Args:
            planned: The plan has it in contact now.
            touches: The measured force says that it is.
            swing_share: How much of the planned swing has passed.
            dt_s: Control step.

        Returns:
            Whether it came into contact just now: where it is, is where it stands.
        """
        if not planned:
            early = touches and swing_share > EARLY_SHARE
            landed = early and self.mode is not Mode.CONTACT
            stays = self.mode is Mode.CONTACT and swing_share > EARLY_SHARE
            self.mode = Mode.CONTACT if early or stays else Mode.FREE
            self.searched_s = 0.0
            return landed
        if self.mode is Mode.CONTACT:
            return False
        if touches:
            self.mode, self.searched_s = Mode.CONTACT, 0.0
            return True
        self.mode = Mode.SEARCH
        self.searched_s += dt_s
        return False

    @property
    def search_depth_m(self) -> float:
        """How far below its planned place it is looked for."""
        return min(SEARCH_SPEED * self.searched_s, SEARCH_DEPTH)
