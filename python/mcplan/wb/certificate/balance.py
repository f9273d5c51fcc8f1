"""Balance of the base: what the shipped contact forces leave, and what is left once they are corrected."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .correction import Correction
from .result import MotionViolation, largest
from .states import States
from .tolerances import MotionTolerances

Array = NDArray[np.float64]


def balance(states: States, correction: Correction, tolerances: MotionTolerances) -> list[MotionViolation]:
    """Largest force and moment on the base that no contact gives, where there is one; flights are integrated instead."""
    supported = (states.contacts >= 0).any(axis=1)
    found = []
    for prefix, wrenches, force_limit, moment_limit in (
        ("residual", states.residual_W, tolerances.residual_N, tolerances.residual_Nm),
        ("corrected", correction.left_W, tolerances.corrected_N, tolerances.corrected_Nm),
    ):
        for part, name, limit, unit in (
            (slice(0, 3), "force", force_limit, "N"),
            (slice(3, 6), "moment", moment_limit, "N m"),
        ):
            sizes = np.linalg.norm(wrenches[supported, part], axis=1)
            about = MotionViolation(f"{prefix}_{name}", 0.0, limit, unit)
            found.append(largest(about, sizes, states.times[supported]))
    return found


def off_the_plan(states: States, com_W: Array, tolerances: MotionTolerances) -> list[MotionViolation]:
    """Distance of the CoM from the plan's: root of the mean square, and largest."""
    off = np.linalg.norm(states.com_W - com_W, axis=1)
    worst = largest(MotionViolation("com_max", 0.0, tolerances.com_max_m, "m"), off, states.times)
    rms = float(np.sqrt(np.mean(off**2)))
    return [replace(worst, name="com_rms", value=rms, limit=tolerances.com_rms_m), worst]
