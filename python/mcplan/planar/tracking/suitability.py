"""Whether a whole-body plan was made to be tracked: told from the plan itself, before a simulation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .prepare import PLANNING

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan, PlanarState

#: [1/s] rate of the instants at which a plan is evaluated, beside those around its knots.
RATE = 200.0
#: [m] by which points in contact may move in a plan that is to be tracked: five times the tube that such plans ask for.
#: A tube of this width has cost 19 to 28 % of the contact forces (docs/tracking_planar.md, "What a plan needs").
DRIFT_M = 5.0 * PLANNING["tube_m"]
#: [N] that every point in contact has to carry at least: a fifth of what such plans ask for.
MIN_N = 0.2 * PLANNING["min_normal_force"]


@dataclass(frozen=True)
class Suitability:
    """Measures of how well a simulated robot can follow a plan.

    Attributes:
        drift_m: Largest distance of a point under load from where the plan's contact puts it.
        min_N: Smallest normal force at a point in contact.
    """

    drift_m: float
    min_N: float

    @property
    def least_N(self) -> float:
        """Earlier name of ``min_N``, for one release."""
        return self.min_N

    def ok(self) -> bool:
        """Whether contacts are at rest and carry force throughout."""
        return self.drift_m <= DRIFT_M and self.min_N >= MIN_N

    @property
    def verdict(self) -> str:
        """In a sentence: what is wrong, and what to do about it."""
        if self.ok():
            return "contacts are at rest and carry weight throughout"
        found = []
        if self.drift_m > DRIFT_M:
            found.append(f"its contacts move by up to {1e3 * self.drift_m:.2g} mm while they carry weight")
        if self.min_N < MIN_N:
            found.append(f"points in contact carry as little as {max(self.min_N, 0.0):.2g} N")
        return f"the plan was not made to be tracked: {' and '.join(found)}; plan it by mcplan sip --trackable"


def suitability(plan: PlanarPlan) -> Suitability:
    """Look at the contacts of a plan.

    Args:
        plan: A valid plan of a planar robot.
    """
    knots = np.asarray(plan.knot_times(), float)
    duration = float(plan.duration())
    times = np.concatenate([np.linspace(0.0, duration, max(2, round(RATE * duration))), knots, knots - 1e-6])
    drift, lowest = 0.0, np.inf
    for time_s in np.unique(np.clip(times, 0.0, duration)):
        moved, carried = _at(plan, plan.at(float(time_s)))
        drift, lowest = max(drift, moved), min(lowest, carried)
    return Suitability(drift, lowest)


def _at(plan: PlanarPlan, state: PlanarState) -> tuple[float, float]:
    """Largest distance [m] of a point under load from its place, and the smallest normal force [N], at an instant."""
    task = plan.task
    contacts = {contact.end_effector: contact for contact in task.phases[state.phase].contacts}
    drift, lowest = 0.0, np.inf
    for force in state.forces:
        contact = contacts[force.end_effector]
        along = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        offset = float(task.robot.end_effectors[force.end_effector].points[force.point])
        angle = float(task.surfaces[contact.surface].angle)
        drift = max(drift, float(np.linalg.norm(force.position_W - contact.position_W - offset * along)))
        lowest = min(lowest, float(force.force_W @ [-np.sin(angle), np.cos(angle)]))
    return drift, lowest
