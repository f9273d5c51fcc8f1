"""What a plan asks of its contacts and of the robot's base, measured from its forces alone."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.kinematics.rotations import polygon_normal, with_axis_z

from .contact_replay import Array, Contacts, Replay, ReplayErrors, contacts, replay, replay_errors
from .criteria import alternate, flights

if TYPE_CHECKING:
    from mcplan import Plan

#: Forces below this have no direction to speak of [N].
_NO_FORCE = 1e-3


@dataclass(frozen=True)
class ContactLoad:
    """Measures of one end-effector's contacts. Zeros if it is never in contact.

    Attributes:
        name, kind: Name and kind of the end-effector.
        surfaces: Names of the surfaces of its contacts, in their order in the scene.
        peak_N, peak: Largest force, and over the weight.
        tangent: Largest |F_t1| / F_n or |F_t2| / F_n, the surface's two tangents apart: a cone as a pyramid of four sides.
        tangent_circle: Largest |F_t| / F_n. Both are infinite where the contact pulls.
        pull_N: Largest force towards the surface; 0: none.
        pressure_off_sole_m: Largest distance of the centre of pressure beyond the sole's rectangle.
        pressure_off_surface_m: Largest distance of the centre of pressure from the surface's polygon.
        slip_m: Largest displacement of a point of the sole since touch-down, at the knots.
        reach_m: Largest amount beyond the reach box while in contact.
        swing_stiffness: Largest modulus of the stiffness while free, in g / com_height.
    """

    name: str
    kind: str
    surfaces: tuple[str, ...]
    peak_N: float
    peak: float
    tangent: float
    tangent_circle: float
    pull_N: float
    pressure_off_sole_m: float
    pressure_off_surface_m: float
    slip_m: float
    reach_m: float
    swing_stiffness: float


@dataclass(frozen=True)
class HandsOnly:
    """A phase in which both feet are off and a hand is on.

    `vertical` is the mean vertical force over the weight, by name of each hand that is on.
    """

    phase: int
    duration_s: float
    vertical: dict[str, float]


@dataclass(frozen=True)
class ContactMeasures:
    """A plan sampled at 1 kHz from its forces.

    Attributes:
        replay: Differences of the integrated plan from its knots.
        end_effectors: A row for each end-effector.
        momentum_peak_Nms: Largest |L| about the CoM.
        roll_deg, pitch_deg: Largest moduli.
        com_height_knots_m, com_height_m: Lowest and highest CoM at the knots and at all samples.
        flights: Stretches without any contact.
        hands_only: The phases on hands alone.
        feet_alternate: Whether no foot swings twice in a row.
    """

    replay: ReplayErrors
    end_effectors: tuple[ContactLoad, ...]
    momentum_peak_Nms: float
    roll_deg: float
    pitch_deg: float
    com_height_knots_m: tuple[float, float]
    com_height_m: tuple[float, float]
    flights: int
    hands_only: tuple[HandsOnly, ...]
    feet_alternate: bool

    def largest(self, name: str, kind: str = "") -> float:
        """Largest value of a field of ContactLoad among the end-effectors of a kind ("": all); 0 if there are none."""
        return max((getattr(end, name) for end in self.end_effectors if kind in ("", end.kind)), default=0.0)

    def surfaces(self, kind: str = "") -> set[str]:
        """Names of the surfaces with which the end-effectors of a kind ("": all) are in contact."""
        return {name for end in self.end_effectors if kind in ("", end.kind) for name in end.surfaces}

    def to_dict(self) -> dict[str, Any]:
        """Nested dicts and lists of plain values."""
        return asdict(self)


def measure_contacts(plan: Plan, sample_s: float = 1e-3) -> ContactMeasures:
    """Measure a plan without forces at points.

    Args:
        plan: A plan of at least one phase.
        sample_s: Longest time between samples [s].

    Raises:
        InvalidInput: A phase has forces at points.
    """
    given, replayed = contacts(plan), replay(plan, sample_s)
    sequence = plan.contact_sequence()
    feet = [e for e, end in enumerate(plan.robot.end_effectors) if end.kind == "foot"]
    roll = np.arctan2(replayed.rotation_WB[..., 2, 1], replayed.rotation_WB[..., 2, 2])
    pitch = np.arcsin(np.clip(-replayed.rotation_WB[..., 2, 0], -1.0, 1.0))
    heights = [float(knot.com_W[2]) for knot in plan.knots]
    return ContactMeasures(
        replay=replay_errors(plan, replayed),
        end_effectors=tuple(_load(plan, given, replayed, e) for e in range(plan.end_effector_count())),
        momentum_peak_Nms=float(np.linalg.norm(replayed.momentum_W, axis=-1).max()),
        roll_deg=float(np.rad2deg(np.abs(roll).max())),
        pitch_deg=float(np.rad2deg(np.abs(pitch).max())),
        com_height_knots_m=(min(heights), max(heights)),
        com_height_m=(float(replayed.com_W[..., 2].min()), float(replayed.com_W[..., 2].max())),
        flights=len(flights(sequence)),
        hands_only=tuple(_hands_only(plan, given, replayed)),
        feet_alternate=alternate(sequence, feet),
    )


def hands_only_phases(plan: Plan) -> list[int]:
    """Phases in which both feet are off and a hand is on."""
    kinds = np.array([end.kind for end in plan.robot.end_effectors])
    on = np.array(plan.contact_sequence()) >= 0
    return [k for k, row in enumerate(on) if (kinds == "foot").any() and row.any() and set(kinds[row]) == {"hand"}]


def _load(plan: Plan, given: Contacts, replayed: Replay, e: int) -> ContactLoad:
    end = plan.robot.end_effectors[e]
    weight = float(plan.robot.mass) * float(plan.scene.gravity)
    free = given.surfaces[:, e] < 0
    phases = [int(k) for k in np.flatnonzero(~free)]
    forces = replayed.forces_W[:, :, e]
    tangent = circle = pull = off_sole = off_surface = 0.0
    for k in phases:
        surface = plan.scene.surfaces[given.surfaces[k, e]]
        vertices = np.asarray(surface.vertices_W, float)
        along = _along(forces[k], polygon_normal(vertices))
        tangent, circle = max(tangent, along[0]), max(circle, along[1])
        pull = max(pull, along[2])
        off_surface = max(off_surface, _off_polygon(given.pressure_W[k, e], vertices))
        off_sole = max(off_sole, _off_sole(plan, given, k, e, polygon_normal(vertices)))
    peak = float(np.linalg.norm(forces[phases], axis=-1).max(initial=0.0))
    rigidity = float(plan.scene.gravity) / float(plan.robot.com_height)
    down = sorted(set(given.surfaces[phases, e].tolist()))
    return ContactLoad(
        name=end.name,
        kind=end.kind,
        surfaces=tuple(plan.scene.surfaces[i].name for i in down),
        peak_N=peak,
        peak=peak / weight,
        tangent=tangent,
        tangent_circle=circle,
        pull_N=pull,
        pressure_off_sole_m=off_sole,
        pressure_off_surface_m=off_surface,
        slip_m=_slip(plan, given, e),
        reach_m=_beyond_reach(plan, replayed, phases, e),
        swing_stiffness=float(np.abs(given.stiffness[free, e]).max(initial=0.0)) / rigidity,
    )


def _along(forces: Array, normal: Array) -> tuple[float, float, float]:
    """Largest tangential over normal force, by tangent and in the plane, and largest pull [N], of forces (S, 3)."""
    forces = forces[np.linalg.norm(forces, axis=1) > _NO_FORCE]
    first = np.eye(3)[0 if abs(normal[0]) < 0.9 else 1]  # as the planner's pyramid has its sides
    first = first - normal * (normal @ first)
    first /= np.linalg.norm(first)
    pressing = forces @ normal
    sideways = np.abs(forces @ np.array([first, np.cross(normal, first)]).T)
    pull = float((-pressing).max(initial=0.0))
    if pull > 0.0:
        return np.inf, np.inf, pull
    ratio = sideways / pressing[:, None]
    return float(ratio.max(initial=0.0)), float(np.linalg.norm(ratio, axis=1).max(initial=0.0)), 0.0


def _off_polygon(point: Array, vertices: Array) -> float:
    """Distance of a point from a convex polygon."""
    normal = polygon_normal(vertices)
    height = float(normal @ (point - vertices[0]))
    flat = point - height * normal
    edges = np.roll(vertices, -1, axis=0) - vertices
    if np.all(np.cross(edges, flat - vertices) @ normal >= 0.0):
        return abs(height)
    fraction = np.clip(np.sum(edges * (flat - vertices), axis=1) / np.sum(edges**2, axis=1), 0.0, 1.0)
    beside = np.linalg.norm(vertices + fraction[:, None] * edges - flat, axis=1).min()
    return float(np.hypot(beside, height))


def _off_sole(plan: Plan, given: Contacts, k: int, e: int, normal: Array) -> float:
    """Distance of the centre of pressure beyond the sole's rectangle, which lies in the surface and heads where it does."""
    yaw = _yaws(plan, k)[e]
    sole = with_axis_z(normal, np.array([np.cos(yaw), np.sin(yaw), 0.0]))
    offset = sole.T @ (given.pressure_W[k, e] - plan.knots[k].end_effectors_W[e])
    half = np.asarray(plan.robot.end_effectors[e].half_size)
    return float(np.linalg.norm(np.maximum(np.abs(offset[:2]) - half, 0.0)))


def _yaws(plan: Plan, k: int) -> Array:
    """Heading of every sole at a knot; that of the base where the knot does not say."""
    knot = plan.knots[k]
    own = np.asarray(knot.end_effector_yaw, float)
    return own if own.size else np.full(plan.end_effector_count(), float(knot.base_rpy[2]))


def _slip(plan: Plan, given: Contacts, e: int) -> float:
    """Displacement of the sole's centre, and of its corners by yaw, from touch-down to each later knot of the contact.

    Soles of plans that do not say where they head yaw with the base, of which no slip is made here.
    """
    corner = float(np.linalg.norm(plan.robot.end_effectors[e].half_size))
    says = all(len(knot.end_effector_yaw) > 0 for knot in plan.knots)
    largest, down = 0.0, 0
    for k, surface in enumerate(given.surfaces[:, e]):
        if k == 0 or surface != given.surfaces[k - 1, e]:
            down = k
        if surface < 0:
            continue
        displacement = float(np.linalg.norm(plan.knots[k + 1].end_effectors_W[e] - plan.knots[down].end_effectors_W[e]))
        rotation = float(abs(_yaws(plan, k + 1)[e] - _yaws(plan, down)[e])) if says else 0.0
        largest = max(largest, displacement + corner * rotation)
    return largest


def _beyond_reach(plan: Plan, replayed: Replay, phases: list[int], e: int) -> float:
    """Largest component of R^T (p_l - p) outside the reach box or a face that cuts it, at all samples of the phases."""
    if not phases:
        return 0.0
    end = plan.robot.end_effectors[e]
    places = np.array([plan.knots[k].end_effectors_W[e] for k in phases])
    relative = np.einsum("ksji,ksj->ksi", replayed.rotation_WB[phases], places[:, None] - replayed.com_W[phases])
    beyond = np.maximum(relative - np.asarray(end.reach_max_B), np.asarray(end.reach_min_B) - relative)
    if end.reach_cut.given:
        over = relative @ np.asarray(end.reach_cut.A).T - np.asarray(end.reach_cut.b)
        return float(max(beyond.max(initial=0.0), over.max(initial=0.0)))
    return float(beyond.max(initial=0.0))


def _hands_only(plan: Plan, given: Contacts, replayed: Replay) -> list[HandsOnly]:
    weight = float(plan.robot.mass) * float(plan.scene.gravity)
    found = []
    for k in hands_only_phases(plan):
        vertical = replayed.forces_W[k, :, :, 2]
        means = 0.5 * (vertical[1:] + vertical[:-1]).mean(axis=0) / weight  # trapezoids: the mean over time
        on = {plan.robot.end_effectors[e].name: float(means[e]) for e in np.flatnonzero(given.surfaces[k] >= 0)}
        found.append(HandsOnly(k, float(given.durations_s[k]), on))
    return found
