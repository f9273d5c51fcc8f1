"""How far ahead and back legs reach beyond the box in which every point is reached.

A box ends where its highest or its lowest edge does: one whose soles can be lifted is short. What cuts it short is known: how
long a leg is (``LimbLimits``) and how high a sole is lifted (``reach_cut``). Within these two a leg reaches further, and steps
over a curb are as long as that. No further than the limits of joints hold for what random postures there ask of them: they are
fitted to the box.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable

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
    if not feet:
        return
    farthest = FARTHEST * float(robot.com_height)
    back, ahead = (
        min(_further(robot, end, urdf.limbs[end.name], step, side, farthest) for end in feet) for side in (-1.0, 1.0)
    )
    usual = [float(feet[0].reach_min_B[0]), float(feet[0].reach_max_B[0])]
    while back + ahead >= LEAST_GAIN * (usual[1] - usual[0]):
        _set_range(robot, feet, (usual[0] - back, usual[1] + ahead), usual)
        beyond = _places_beyond_limits(robot, urdf, seed)
        behind, before = usual[0] - beyond[beyond < usual[0]], beyond[beyond > usual[1]] - usual[1]
        if not len(behind) and not len(before):
            return
        back, ahead = _shorter(back, behind, step), _shorter(ahead, before, step)
    _set_range(robot, feet, (usual[0], usual[1]), [-np.inf, np.inf])


def _shorter(most: float, beyond: Array, step: float) -> float:
    """By how much further feet reach [m], in steps, so that none of the places beyond is reached; all of it without any."""
    if not len(beyond):
        return most
    return max(min(most - step, float(np.floor(beyond.min() / step)) * step), 0.0)


def _set_range(robot: Robot, feet: list[EndEffector], x: tuple[float, float], usual: list[float]) -> None:
    """The range of x of the reach of feet, and what of it is usual [m]."""
    names, ends = {foot.name for foot in feet}, list(robot.end_effectors)
    for end in ends:
        if end.name in names:
            low, high = np.array(end.reach_min_B), np.array(end.reach_max_B)
            low[0], high[0] = round(x[0], 3), round(x[1], 3)
            end.reach_min_B, end.reach_max_B, end.usual_reach = low, high, usual
    robot.end_effectors = ends


def _places_beyond_limits(robot: Robot, urdf: LegModel, seed: int) -> Array:
    """Places x [m] of feet in random postures that the limits of a leg ask for more of a joint than it has."""
    data, rng, found = urdf.model.createData(), np.random.default_rng(seed), []
    for posture in postures(urdf, robot, POSTURES, seed):
        for number, name in enumerate(urdf.legs):
            drawn = draw(urdf, data, robot, name, posture, rng)
            limited = np.isfinite(limits_of(robot.end_effectors[robot.end_effector_index(name)].limb))
            if drawn is not None and max(drawn.speed, np.max(drawn.torques[limited], initial=0.0)) > MOST_USE:
                found.append(float(posture.feet[number][0] - posture.com[0]))
    return np.array(found)


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
    for count in itertools.count(1):
        x = edge + side * count * step
        if abs(x) > farthest or not _reached(robot, end, limb, x, _grid(low, high, step), postures):
            return (count - 1) * step
    raise AssertionError


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
