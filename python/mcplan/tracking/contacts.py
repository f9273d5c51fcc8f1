"""Which end-effectors are in contact: the plan's timing, corrected by the measured forces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: A foot in contact after this fraction of its swing has landed early; before, it has not left yet.
EARLY_FRACTION = 0.7
#: After a late landing the other feet stay on the ground for so long, though the plan lifts them [s].
TOGETHER_S = 0.06
#: An end-effector that has landed and is no farther from there stands there, whatever it bears [m]. Chosen.
STAYS_M = 0.01
#: Speed at which a foot that is late is lowered onto the ground [m/s], and how far [m].
SEARCH_SPEED, SEARCH_DEPTH = 0.3, 0.08


class Mode(Enum):
    """Mode of an end-effector."""

    FREE = "free"
    CONTACT = "contact"
    SEARCH = "search"  # the plan has it on the ground, the ground is not there yet


@dataclass
class Contact:
    """An end-effector's state.

    Attributes:
        mode: Its mode.
        position_W, rotation_W: Where the contact was made; in Mode.SEARCH: where the search for the ground began.
        searched_s: Time spent in Mode.SEARCH.
    """

    mode: Mode = Mode.FREE
    position_W: Array = field(default_factory=lambda: np.zeros(3))
    rotation_W: Array = field(default_factory=lambda: np.eye(3))
    searched_s: float = 0.0

    def update(self, planned: bool, in_contact: bool, swing_fraction: float, dt_s: float) -> bool:
        """Move on by a control step.

        Args:
            planned: The plan has it in contact now.
            in_contact: The measured force says that it is.
            swing_fraction: Fraction of the planned swing that has passed.
            dt_s: Duration of the control step.

        Returns:
            Whether it came into contact just now: its place is that of the contact.
        """
        if not planned:
            early = in_contact and swing_fraction > EARLY_FRACTION
            landed = early and self.mode is not Mode.CONTACT
            stays = self.mode is Mode.CONTACT and swing_fraction > EARLY_FRACTION
            self.mode = Mode.CONTACT if early or stays else Mode.FREE
            self.searched_s = 0.0
            return landed
        if self.mode is Mode.CONTACT:
            return False
        if in_contact:
            self.mode, self.searched_s = Mode.CONTACT, 0.0
            return True
        self.mode = Mode.SEARCH
        self.searched_s += dt_s
        return False

    def stands(self, firmly: bool, in_contact: bool, moved_m: float) -> bool:
        """Whether it stands, for a planner: sooner than forces say for certain.

        One that is being lifted has left, though its force is not yet gone. One that has landed stays where it came to
        stand, whether it bears anything or not: taken to be in the air again it would land anew in every plan, and the
        step from it would be put off by all of them.

        Args:
            firmly: Its force says so for certain.
            in_contact: Its force says so now.
            moved_m: Its distance from where the contact was made [m].
        """
        if self.mode is Mode.FREE:
            return False
        return firmly or (self.mode is Mode.CONTACT and (in_contact or moved_m < STAYS_M))

    @property
    def search_depth_m(self) -> float:
        """Depth below the place where it was due at which the ground is searched."""
        return min(SEARCH_SPEED * self.searched_s, SEARCH_DEPTH)

    @property
    def search_speed(self) -> float:
        """Speed at which that depth grows [m/s]."""
        return SEARCH_SPEED if SEARCH_SPEED * self.searched_s < SEARCH_DEPTH else 0.0


class LateLandings:
    """Keeps feet on the ground while one that should carry by now is still on its way down, and shortly after.

    A plan goes on with time: without this the next foot would be lifted before there is another one to stand on.
    """

    def __init__(self) -> None:
        self._keeps_s = 0.0

    def update(self, contacts: Sequence[Contact], planned: Sequence[bool], dt_s: float) -> list[bool]:
        """Whether each end-effector is to be in contact now.

        Args:
            contacts: As they were a control step ago.
            planned: Whether the plan has each in contact.
            dt_s: Duration of the control step.
        """
        late = any(on and contact.mode is Mode.SEARCH for contact, on in zip(contacts, planned, strict=True))
        self._keeps_s = TOGETHER_S if late else max(self._keeps_s - dt_s, 0.0)
        if self._keeps_s <= 0.0:
            return list(planned)
        return [on or contact.mode is Mode.CONTACT for contact, on in zip(contacts, planned, strict=True)]
