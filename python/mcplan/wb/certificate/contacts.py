"""Contacts: which there are, where end-effectors stand, and what forces they take."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .footholds import Foothold, beyond_polygon, normal_of, standing
from .inputs import CertifiedMotion
from .result import RATIO, MotionViolation, largest, worse
from .states import States
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: A contact with less normal force than this has no centre of pressure to speak of [N].
BEARS_N = 1.0


def contact_times(motion: CertifiedMotion, tolerances: MotionTolerances) -> MotionViolation:
    """Time in which an end-effector's contact is not that of the plan."""
    plan, ends = motion.plan, motion.plan.robot.end_effectors
    knots = np.array(plan.knot_times())
    cuts = np.unique(np.concatenate([knots, motion.times_s]))
    middles = 0.5 * (cuts[1:] + cuts[:-1])
    planned = np.array([[contact.surface for contact in phase.contacts] for phase in plan.phases])
    phases = np.clip(np.searchsorted(knots, middles, side="right") - 1, 0, len(plan.phases) - 1)
    nodes = np.clip(np.searchsorted(motion.times_s, middles, side="right") - 1, 0, len(motion.contacts) - 1)
    differ = planned[phases] != motion.contacts[nodes]
    worst = MotionViolation("contacts", 0.0, tolerances.contacts_s, "s")
    for end in range(len(ends)):
        wrong = differ[:, end]
        value = float(np.diff(cuts)[wrong].sum())
        time = float(middles[wrong][0]) if wrong.any() else 0.0
        worst = worse(worst, replace(worst, value=value, time_s=time, end_effector=ends[end].name))
    return worst


def drift(
    motion: CertifiedMotion, states: States, footholds: list[Foothold], tolerances: MotionTolerances
) -> list[MotionViolation]:
    """How far end-effectors in contact are from their footholds, how soles are turned, how fast their points move.

    Footholds are where the plan's contacts are made; where its later knots have them elsewhere, that counts as well.
    """
    knots = np.array(motion.plan.knot_times())
    planned_W = np.array([knot.end_effectors_W for knot in motion.plan.knots], float)
    ends = motion.plan.robot.end_effectors
    distance = MotionViolation("drift", 0.0, tolerances.drift_m, "m")
    angle = MotionViolation("drift_angle", 0.0, tolerances.drift_deg, "deg")
    speed = MotionViolation("drift_speed", 0.0, tolerances.drift_speed, "m/s")
    for foothold in footholds:
        e = foothold.end_effector
        inside = standing(states.times, foothold)
        times, name = states.times[inside], ends[e].name
        off = np.linalg.norm(states.positions_W[inside, e] - foothold.position_W, axis=1)
        distance = worse(distance, largest(replace(distance, value=0.0, end_effector=name), off, times))
        lasting = standing(knots, foothold)
        slips = np.linalg.norm(planned_W[lasting, e] - foothold.position_W, axis=1)
        distance = worse(distance, largest(replace(distance, value=0.0, end_effector=name), slips, knots[lasting]))
        levers = states.corners_W[inside, e] - states.positions_W[inside, None, e]
        moving = states.twists_W[inside, e, None, :3] + np.cross(states.twists_W[inside, e, None, 3:], levers)
        fastest = np.linalg.norm(moving, axis=2).max(axis=1)
        speed = worse(speed, largest(replace(speed, value=0.0, end_effector=name), fastest, times))
        if ends[e].kind == "foot" and np.asarray(ends[e].half_size).all():
            turned = np.degrees(angles_between(foothold.rotation_W, states.rotations_W[inside, e]))
            angle = worse(angle, largest(replace(angle, value=0.0, end_effector=name), turned, times))
    return [distance, angle, speed]


def angles_between(rotation: Array, others: Array) -> Array:
    """(k,) angles [rad] from one rotation to others (k, 3, 3): |R - R'|_F = 2 sqrt 2 sin(angle / 2)."""
    chord = np.linalg.norm(others - rotation, axis=(1, 2)) / (2.0 * np.sqrt(2.0))
    return np.asarray(2.0 * np.arcsin(np.clip(chord, 0.0, 1.0)))


def forces(motion: CertifiedMotion, states: States, tolerances: MotionTolerances) -> list[MotionViolation]:
    """Friction and pull at every corner, forces of end-effectors that are free, and those beyond what one may take."""
    scene, ends = motion.plan.scene, motion.plan.robot.end_effectors
    friction = MotionViolation("friction", 0.0, tolerances.friction_N, "N")
    pull = MotionViolation("pull", 0.0, tolerances.pull_N, "N")
    free = MotionViolation("free_force", 0.0, tolerances.pull_N, "N")
    cap = MotionViolation("force_cap", 0.0, tolerances.force_use, RATIO)
    for e, end in enumerate(ends):
        uses = np.linalg.norm(states.corner_forces_W[:, e].sum(axis=1), axis=1) / float(end.max_force)
        cap = worse(cap, largest(replace(cap, value=0.0, end_effector=end.name), uses, states.times))
        for surface in np.unique(states.contacts[:, e]):
            here = states.contacts[:, e] == surface
            corner_forces, times = states.corner_forces_W[here, e], states.times[here]
            if surface < 0:
                size = np.linalg.norm(corner_forces, axis=2).sum(axis=1)
                free = worse(free, largest(replace(free, value=0.0, end_effector=end.name), size, times))
            elif not scene.surfaces[surface].grasp:
                normal, tangential = split(corner_forces, normal_of(scene, int(surface)))
                slips = (tangential - scene.surfaces[surface].friction * normal).max(axis=1)
                pulls = -normal.min(axis=1)
                friction = worse(friction, largest(replace(friction, value=0.0, end_effector=end.name), slips, times))
                pull = worse(pull, largest(replace(pull, value=0.0, end_effector=end.name), pulls, times))
    return [friction, pull, free, cap]


def split(forces_W: Array, normal: Array) -> tuple[Array, Array]:
    """Normal force and size of the tangential one of forces (..., 3)."""
    along = forces_W @ normal
    return along, np.asarray(np.linalg.norm(forces_W - along[..., None] * normal, axis=-1))


def pressure(motion: CertifiedMotion, states: States, tolerances: MotionTolerances) -> list[MotionViolation]:
    """Centres of pressure outside of soles, corners outside of them, and centres outside of surfaces."""
    scene, ends = motion.plan.scene, motion.plan.robot.end_effectors
    sole = MotionViolation("center_of_pressure", 0.0, tolerances.center_of_pressure_m, "m")
    polygon = MotionViolation("polygon", 0.0, tolerances.polygon_m, "m")
    for e, end in enumerate(ends):
        half, points = np.asarray(end.half_size, float), motion.corner_points_S[e]
        outside = max(float((np.abs(points[:, :2]) - half).max()), float(np.abs(points[:, 2]).max()))
        normal_S = states.corner_forces_S[:, e, :, 2]
        total = normal_S.sum(axis=1)
        bears = (total > BEARS_N) & (states.contacts[:, e] >= 0)
        if not bears.any():
            continue
        sole = worse(sole, replace(sole, value=outside, end_effector=end.name))
        ratios = normal_S[bears] / total[bears, None]
        centres = ratios @ points[:, :2]
        times = states.times[bears]
        beyond = (np.abs(centres) - half).max(axis=1)
        sole = worse(sole, largest(replace(sole, value=0.0, end_effector=end.name), beyond, times))
        centres_W = np.einsum("kp,kpj->kj", ratios, states.corners_W[bears, e])
        for surface in np.unique(states.contacts[bears, e]):
            here = states.contacts[bears, e] == surface
            off = beyond_polygon(scene, int(surface), centres_W[here])
            polygon = worse(polygon, largest(replace(polygon, value=0.0, end_effector=end.name), off, times[here]))
    return [sole, polygon]
