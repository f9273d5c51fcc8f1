"""Contacts and the surfaces that they are on: how far from them, and whether those may be touched at all."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mcplan._core import may_touch

from .footholds import Foothold, height_over, standing
from .inputs import CertifiedMotion
from .result import MotionViolation, largest, worse
from .states import States
from .tolerances import MotionTolerances

#: Unit of what is forbidden: contacts of that kind.
CONTACTS = "contacts"


def on_surfaces(
    motion: CertifiedMotion, states: States, footholds: list[Foothold], tolerances: MotionTolerances
) -> list[MotionViolation]:
    """Distance of end-effectors in contact from the plane of their surface, and contacts that the scene does not permit.

    What stands where a plan begins at a measured state stands where it was measured: its distance is not looked at.
    """
    plan, ends = motion.plan, motion.plan.robot.end_effectors
    distance = MotionViolation("contact_distance", 0.0, tolerances.contact_distance_m, "m")
    permission = MotionViolation("contact_permission", 0.0, 0.0, CONTACTS)
    refused: dict[int, list[Foothold]] = {}
    for foothold in footholds:
        e, surface = foothold.end_effector, foothold.surface
        if not may_touch(plan.scene.surfaces[surface], ends[e]):
            refused.setdefault(e, []).append(foothold)
        if plan.measured_start and foothold.start_s <= 0.0:
            continue
        inside = standing(states.times, foothold)
        off = np.abs(height_over(plan.scene, surface, states.positions_W[inside, e]))
        about = replace(distance, value=0.0, end_effector=ends[e].name)
        distance = worse(distance, largest(about, off, states.times[inside]))
    for e, found in refused.items():
        about = replace(permission, value=float(len(found)), time_s=found[0].start_s, end_effector=ends[e].name)
        permission = worse(permission, about)
    return [distance, permission]
