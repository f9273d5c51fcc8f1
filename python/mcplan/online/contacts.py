"""Which end-effectors are in contact, from forces: with hysteresis in force and in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ContactFilter:
    """Contacts of e end-effectors from the forces on them.

    A contact begins when the force has been above `on_N` for `begin_s`, and ends when it has been below `off_N` for `end_s`.

    Args:
        on_N: [N]
        off_N: [N], below `on_N`.
        begin_s, end_s: [s]
        in_contact: (e,) contacts at the beginning.
    """

    def __init__(
        self, in_contact: NDArray[np.bool_], on_N: float, off_N: float, begin_s: float = 0.004, end_s: float = 0.01
    ) -> None:
        self.on_N, self.off_N, self.begin_s, self.end_s = on_N, off_N, begin_s, end_s
        self.in_contact = np.array(in_contact, dtype=bool)
        self._since_s = np.full(len(self.in_contact), np.nan)  # when what speaks for a change began

    def update(self, time_s: float, forces_W: Array) -> NDArray[np.bool_]:
        """Contacts (e,) with forces (e, 3) [N] measured at a time [s], later than the last."""
        size = np.linalg.norm(forces_W, axis=1)
        changes = np.where(self.in_contact, size < self.off_N, size > self.on_N)
        self._since_s = np.where(changes, np.where(np.isnan(self._since_s), time_s, self._since_s), np.nan)
        lasts = np.where(self.in_contact, self.end_s, self.begin_s)
        with np.errstate(invalid="ignore"):
            changed = changes & (time_s - self._since_s >= lasts - 1e-9)
        self.in_contact = self.in_contact ^ changed
        self._since_s[changed] = np.nan
        return self.in_contact.copy()
