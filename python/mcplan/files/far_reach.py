"""How far ahead and back legs reach beyond the box in which every point is reached.

A box ends where its highest or its lowest edge does: one whose soles can be lifted is short. What cuts it short is known: how
long a leg is (``LimbLimits``) and how high a sole is lifted (``reach_cut``). Within these two a leg reaches further, and steps
over a curb are as long as that. No further than the limits of joints hold for what random postures there ask of them: they are
fitted to the box.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from mcplan._core import EndEffector, Robot
from mcplan.files.leg_geometry import LegModel, hip_place, limits_of, max_length, postures
from mcplan.files.limb_limits import POSTURES, draw
from mcplan.files.reach import Limb
from mcplan.files.reach_cut import below_cut

Array = NDArray[np.float64]

#: Farthest that is looked for, over the height of the CoM: strides of 0.57 of it.
FARTHEST = 0.285
#: Use of a joint that random postures may come to within its limits. Within the box it is 1.05; of 9,000 draws of TALOS two lie
#: between the two, with a foot 0.21 and 0.24 m ahead, and a reach of 0.21 m makes its steps over curbs ten times as dear.
MOST_USE = 1.07
#: What is gained over the length of the box, below which it is not worth a search of its own.
LEAST_GAIN = 0.1


def add_far_reach(robot: Robot, urdf: LegModel, step: float, seed: int = 0) -> None:
    """Let feet whose legs have joint limits reach further along x; what they had before becomes ``usual_reach``.

    Args:
        robot: With boxes, their cuts, and ``limb``.
        urdf: Its legs.
        step: Distance of the points that are looked at [m].
        seed: Of the random postures.
    """
    feet = [end for end in robot.end_effectors if end.limb.given and urdf.limbs[end.name].flat]
    usual = {end.name: (float(end.reach_min_B[0]), float(end.reach_max_B[0])) for end in feet}
    if not usual:
        return
    farthest = FARTHEST * float(robot.com_height)
    back, ahead = (
        min(_further(robot, end, urdf.limbs[end.name], step, side, farthest) for end in feet) for side in (-1.0, 1.0)
    )
    shortest = min(high - low for low, high in usual.values())
    while back + ahead >= LEAST_GAIN * shortest:
        _widen(robot, usual, back, ahead)
        beyond = _places_beyond_limits(robot, urdf, seed)
        behind = np.array([usual[name][0] - x for name, x in beyond if name in usual and x < usual[name][0]])
        before = np.array([x - usual[name][1] for name, x in beyond if name in usual and x > usual[name][1]])
        if not len(behind) and not len(before):
            return
        back, ahead = _shorter(back, behind, step), _shorter(ahead, before, step)
    _widen(robot, usual, 0.0, 0.0)


def _shorter(most: float, beyond: Array, step: float) -> float:
    """By how much further feet reach [m], in steps, so that none of the places beyond is reached; all of it without any."""
    if not len(beyond):
        return most
    return max(min(most - step, float(np.floor(beyond.min() / step)) * step), 0.0)


def _widen(robot: Robot, usual: Mapping[str, tuple[float, float]], back: float, ahead: float) -> None:
    """Let feet reach so much further than their usual range of x [m]."""
    ends = list(robot.end_effectors)
    for end in ends:
        if end.name in usual:
            low, high = np.array(end.reach_min_B), np.array(end.reach_max_B)
            low[0], high[0] = round(usual[end.name][0] - back, 3), round(usual[end.name][1] + ahead, 3)
            end.reach_min_B, end.reach_max_B = low, high
            end.usual_reach = usual[end.name] if back + ahead > 0.0 else [-np.inf, np.inf]
    robot.end_effectors = ends


def _places_beyond_limits(robot: Robot, urdf: LegModel, seed: int) -> list[tuple[str, float]]:
    """Feet and their places x [m] in random postures in which a leg's limits ask for more of a joint than it has."""
    data, rng, found = urdf.model.createData(), np.random.default_rng(seed), []
    for posture in postures(urdf, robot, POSTURES, seed):
        for number, name in enumerate(urdf.legs):
            drawn = draw(urdf, data, robot, name, posture, rng)
            limited = np.isfinite(limits_of(robot.end_effectors[robot.end_effector_index(name)].limb))
            if drawn is not None and max(drawn.speed, np.max(drawn.torques[limited], initial=0.0)) > MOST_USE:
                found.append((name, float(posture.feet[number][0] - posture.com[0])))
    return found


def leg_reaches(robot: Robot, end: EndEffector, place: Array) -> bool:
    """Whether a leg is long enough for a place of its foot, relative to the CoM [m], with other feet where they stand."""
    feet = {other.name: np.asarray(other.nominal_B) for other in robot.end_effectors} | {end.name: place}
    hip = hip_place(robot, end, np.zeros(3), feet)
    length = float(np.linalg.norm(hip - place - np.asarray(end.limb.ankle)))
    return length + float(end.limb.margin) <= max_length(end.limb)


def _further(robot: Robot, end: EndEffector, limb: Limb, step: float, side: float, farthest: float) -> float:
    """By how much further its foot comes [m], in steps: all that its leg is long enough for is reached there."""
    low, high = np.asarray(end.reach_min_B), np.asarray(end.reach_max_B)
    edge = float(high[0] if side > 0.0 else low[0])
    postures: dict[tuple[int, int], Array] = {}
    grid, count = _grid(low, high, step), 0
    while abs(x := edge + side * (count + 1) * step) <= farthest and _reached(robot, end, limb, x, grid, postures):
        count += 1
    return count * step


def _grid(low: Array, high: Array, step: float) -> list[tuple[tuple[int, int], float, float]]:
    """Points across a box: their indices, y and z, from the middle outwards."""
    y, z = (np.linspace(low[a], high[a], int((high[a] - low[a]) / step) + 2) for a in (1, 2))
    index = itertools.product(range(len(y)), range(len(z)))
    middle = np.array([len(y), len(z)]) / 2
    return [((i, j), float(y[i]), float(z[j])) for i, j in sorted(index, key=lambda at: float(abs(at - middle).sum()))]


def _reached(
    robot: Robot,
    end: EndEffector,
    limb: Limb,
    x: float,
    grid: Iterable[tuple[tuple[int, int], float, float]],
    postures: dict[tuple[int, int], Array],
) -> bool:
    """Whether inverse kinematics reaches all points of a grid at x that a leg is long enough for, from its neighbours."""
    for (i, j), y, z in grid:
        place = np.array([x, y, z])
        if not below_cut(end, place) or not leg_reaches(robot, end, place):
            continue
        near = [postures[at] for at in ((i, j), (i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)) if at in postures]
        found = next((q for start in [*near, limb.nominal] if (q := limb.solve(place, start)) is not None), None)
        if found is None:
            return False
        postures[i, j] = found
    return True
