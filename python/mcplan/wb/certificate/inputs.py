"""What the certificate reads of a motion: its numbers, and what it says of its states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mcplan._core import Plan

Array = NDArray[np.float64]


class CertifiedMotion(Protocol):
    """A motion, as ``mcplan.wb.Motion`` documents it."""

    @property
    def plan(self) -> Plan: ...
    @property
    def urdf(self) -> str: ...
    @property
    def joints(self) -> tuple[str, ...]: ...
    @property
    def locked(self) -> Mapping[str, float]: ...
    @property
    def times_s(self) -> Array: ...
    @property
    def coefficients(self) -> Array: ...
    @property
    def corner_points_S(self) -> Array: ...
    @property
    def corner_forces_S(self) -> Array: ...
    @property
    def contacts(self) -> NDArray[np.int32]: ...
    def duration(self) -> float: ...
    def sample(self, times: ArrayLike) -> Any: ...
