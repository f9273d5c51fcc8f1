"""The references that a controller was given, step by step: those of many plans in turn."""

from __future__ import annotations

import numpy as np

from mcplan.tracking.references import References

#: What a recording keeps of references.
KEPT = ("com_W", "momentum_W", "base_WB", "end_effectors_W", "forces_W", "surfaces")


class FollowedReferences:
    """Rows of references for at most `count` control steps, as ``tracking.recorder`` reads them."""

    def __init__(self, count: int, first: References) -> None:
        self.count, self.dt_s = count, first.dt_s
        like = {name: getattr(first, name) for name in KEPT}
        rows = {name: np.zeros((count, *value.shape[1:]), value.dtype) for name, value in like.items()}
        self.com_W, self.momentum_W, self.base_WB = rows["com_W"], rows["momentum_W"], rows["base_WB"]
        self.end_effectors_W, self.forces_W, self.surfaces = rows["end_effectors_W"], rows["forces_W"], rows["surfaces"]

    def add(self, n: int, window: References, k: int) -> None:
        """Row n is row k of a window."""
        for name in KEPT:
            getattr(self, name)[n] = getattr(window, name)[k]

    def drop(self, steps: int) -> None:
        """Forget the first rows: the others move to the front."""
        for name in KEPT:
            rows = getattr(self, name)
            rows[:-steps] = rows[steps:].copy()
