"""What a planar robot looks like: links as hulls of discs, limbs with a colour and a place beside each other."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import BODY, COOL, WARM, mix
from mcplan.view.shapes import circle

if TYPE_CHECKING:
    from mcplan._core import PlanarEndEffector, PlanarRobot

Array = NDArray[np.float64]

#: Limbs that are of no side, one after the other: blue, orange, green, purple. Neighbours stay apart for colour-blind readers.
CYCLE = (COOL[0], WARM[0], COOL[2], WARM[2])


@dataclass(frozen=True)
class Limb:
    """A chain of links from the trunk to a tip."""

    name: str
    bodies: tuple[int, ...]  # trunk's side first
    colour: str  # "#rrggbb"
    lane: float  # [-1, 1] beside the trunk: 1 is the left, away from who looks from the right


@dataclass(frozen=True)
class Shape:
    """Convex piece of a link: the hull of discs (x, y, radius) [m] in the link's frame."""

    body: int
    discs: Array  # (n, 3)
    colour: str
    lane: float

    def outline_B(self, sides: int = 24) -> Array:
        """Convex polygon (m, 2) [m], counter-clockwise."""
        ring = circle(sides)
        return convex_hull(np.vstack([disc[:2] + disc[2] * ring for disc in self.discs]))


def size_of(robot: PlanarRobot) -> float:
    """Longest path from the base along the joints to a contact frame [m], by which arrows and radii are scaled."""
    length = [0.0] * len(robot.bodies)
    for i, body in enumerate(robot.bodies[1:], start=1):
        length[i] = length[body.parent] + float(np.linalg.norm(body.joint_P))
    reach = [length[end.body] + float(np.linalg.norm(end.position_B)) for end in robot.end_effectors]
    return max([*reach, *length, 1e-3])


def limbs_of(robot: PlanarRobot) -> list[Limb]:
    """Chains that end at a tip, each as far up as no other branch joins; the rest is the trunk."""
    children = [[i for i, b in enumerate(robot.bodies) if i and b.parent == parent] for parent in range(_count(robot))]
    chains: list[tuple[int, ...]] = []
    for tip in range(1, _count(robot)):
        if children[tip]:
            continue
        upwards = [tip]
        while (parent := robot.bodies[upwards[-1]].parent) > 0 and len(children[parent]) == 1:
            upwards.append(parent)
        chains.append(tuple(reversed(upwards)))
    if len(chains) == 1:  # a lone chain: its base is all the trunk there is
        return [Limb(_name(robot, chains[0]), chains[0], COOL[0], 0.0)]
    limbs: list[Limb] = []
    with_sole = {int(end.body) for end in robot.end_effectors}
    counts = {"left": 0, "right": 0, "none": 0}
    for chain in chains:
        root = robot.bodies[chain[0]].parent
        siblings = [c for c in chains if robot.bodies[c[0]].parent == root]
        name = _name(robot, chain)
        side = _side(name)
        supports = bool(with_sole.intersection(chain))
        place = siblings.index(chain)
        lane = 1.0 - 2.0 * place / (len(siblings) - 1) if len(siblings) > 1 else 0.0
        if side is None and supports:
            colour = CYCLE[counts["none"] % len(CYCLE)]
            counts["none"] += 1
        elif side is None:  # an arm without contacts: its place says its side
            colour = mix((COOL if lane >= 0.0 else WARM)[0], BODY, 0.45)
        else:
            lane = 1.0 if side == "left" else -1.0
            palette = COOL if side == "left" else WARM
            colour = palette[counts[side] % len(palette)] if supports else mix(palette[0], BODY, 0.45)
            counts[side] += supports
        limbs.append(Limb(name, chain, colour, lane))
    return limbs


def end_colours(robot: PlanarRobot) -> list[str]:
    """One colour per end-effector, "#rrggbb": its limb's."""
    limbs = limbs_of(robot)
    return [next((limb.colour for limb in limbs if end.body in limb.bodies), BODY) for end in robot.end_effectors]


def shapes_of(robot: PlanarRobot) -> list[Shape]:
    """Pieces of all links, far limbs first, near ones last; capsules where a link has them, else joint to joint."""
    size = size_of(robot)
    limb_of = {body: limb for limb in limbs_of(robot) for body in limb.bodies}
    drawn = []
    for i in range(_count(robot)):
        limb = limb_of.get(i)
        tip = limb is not None and any(end.body == i for end in robot.end_effectors)
        colour = BODY if limb is None else limb.colour if tip else mix(limb.colour, "#ffffff", 0.30)
        lane = limb.lane if limb is not None else 0.0
        drawn += [Shape(i, discs, colour, lane) for discs in _discs(robot, i, limb, size)]
    return sorted(drawn, key=lambda shape: -shape.lane)


def convex_hull(points: Array) -> Array:
    """Convex hull of points (n, 2), counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in np.round(points, 9)})
    if len(ordered) < 3:
        return np.array(ordered)
    halves = []
    for run in (ordered, ordered[::-1]):
        half: list[tuple[float, float]] = []
        for p in run:
            while len(half) > 1 and _cross(half[-2], half[-1], p) <= 0.0:
                half.pop()
            half.append(p)
        halves.append(half[:-1])
    return np.array(halves[0] + halves[1])


def _discs(robot: PlanarRobot, i: int, limb: Limb | None, size: float) -> list[Array]:
    body = robot.bodies[i]
    tips = [end for end in robot.end_effectors if end.body == i]
    soles = np.array([row for end in tips for row in _sole(end, 0.012 * size)]).reshape(-1, 3)
    if body.capsules:
        pieces = [np.array([[*c.from_B, c.radius], [*c.to_B, c.radius]], float) for c in body.capsules]
        # A foot reaches from its joint to its sole, whatever part of it is checked for collisions.
        ankle = [[0.0, 0.0, 0.030 * size]]
        return [*pieces, np.vstack([ankle, soles])] if len(soles) else pieces
    joints = [np.asarray(child.joint_P, float) for child in robot.bodies[1:] if child.parent == i]
    if limb is None:
        own = [np.asarray(body.com_B, float)] if i == 0 else [np.zeros(2)]
        return [np.vstack([[[*p, 0.06 * size] for p in _distinct([*own, *joints])], soles])]
    # Limbs taper from the trunk to the tip.
    step = limb.bodies.index(i)
    radius = [(0.046 - 0.016 * k / max(len(limb.bodies) - 1, 1)) * size for k in (step, step + 1)]
    far = joints if joints else [] if tips else [2.0 * np.asarray(body.com_B, float)]
    return [np.vstack([[[0.0, 0.0, radius[0]]], [[*p, radius[1]] for p in far] or np.zeros((0, 3)), soles])]


def _sole(end: PlanarEndEffector, radius: float) -> list[list[float]]:
    """Small discs that rest on the contact frame's x axis, at the outermost points."""
    angle = float(end.angle_B)
    x, y = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    points = [float(p) for p in end.points]
    at = np.asarray(end.position_B, float)
    return [[*(at + p * x + radius * y), radius] for p in sorted({min(points), max(points)})]


def _distinct(points: list[Array]) -> list[Array]:
    kept: list[Array] = []
    for p in points:
        if all(np.linalg.norm(p - other) > 1e-6 for other in kept):
            kept.append(p)
    return kept


def _name(robot: PlanarRobot, chain: tuple[int, ...]) -> str:
    tips = [end.name for end in robot.end_effectors if end.body in chain]
    return str(tips[0] if tips else robot.bodies[chain[0]].name)


def _side(name: str) -> str | None:
    words = re.split(r"[_\W]+", name.lower())
    return next((side for side in ("left", "right") if side in words or side[0] in words), None)


def _count(robot: PlanarRobot) -> int:
    return len(robot.bodies)


def _cross(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
