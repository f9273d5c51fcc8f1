"""Random scenes that a robot can cross by construction: laid out around a nominal walk, jump or lean of that robot.

Kinds take turns by a table, and every scene is turned and moved in the level:

- patches: a patch for every foothold of a walk, tilted by up to 15 degrees in any direction, at other heights, with gaps;
- strips: ground in strips as wide as two metres, tilted by up to 15 degrees, with gaps and risers that a step bridges;
- stairs: treads up or down, each large enough for both soles one behind the other or for one of them;
- jump: level ground with a gap beyond any step and within what this robot is known to jump;
- hold: a gap beyond any step with a pad for each hand, and the rule that both hands hold while both feet are off.

A walk keeps both feet, and the CoM in the middle between them, well within the reach boxes, whole soles on their surfaces,
and the line from either foothold to that CoM within the friction cone. Python's own random numbers are used because their
sequence is fixed for ever.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from random import Random

import numpy as np
from numpy.typing import NDArray

from mcplan._core import ContactRule, Robot, Scene, Stance, Surface
from mcplan.files.generate import GRAVITY, moved
from mcplan.files.reach_cut import top_at

Array = NDArray[np.float64]

FRICTION = 0.7
MAX_TILT_RAD = math.radians(15.0)
#: Room between a sole and the edges of its surface [m], and between two surfaces side by side.
_ROOM_M, _BESIDE_M = 0.02, 0.005
#: Ratios of a reach box that a step along, up and across uses at most, of the CoM's height that it does along.
_ALONG, _UP, _OF_HEIGHT = 0.55, 0.25, 0.30
#: Kinds by turns of ten; instead of a hold, robots whose hands do not bear half the weight have patches, and instead of a
#: jump those whose legs do not give way by a fifth of the CoM's height, or have joint limits: of 56 such jumps of talos none
#: was found, each missed its legs' reach by some centimetres.
KINDS = ("patches", "strips", "patches", "jump", "patches", "strips", "stairs", "patches", "hold", "patches")
#: Gap beyond the longest step, and CoM heights a gap may be long: humanoid44 jumps these on level ground.
_JUMP_OVER, _JUMP_HEIGHTS = 1.1, 1.1


@dataclass
class Laid:
    """A scene in its own frame, along x from the origin, and the footholds it was laid out for: centres of soles in turn."""

    surfaces: list[Surface]
    goal: tuple[float, float]  # x and height [m]
    kind: str
    footholds: list[tuple[str, Array]] = field(default_factory=list)  # surface and place [m]
    rules: list[ContactRule] = field(default_factory=list)


@dataclass(frozen=True)
class Gait:
    """What a robot's feet can do, from its reach boxes [m]."""

    half_sole: tuple[float, float]
    feet_y: float  # a foot's nominal distance from the middle
    box: Array  # size of the smaller reach box, along, across, up
    height: float  # CoM

    @property
    def stride(self) -> tuple[float, float]:
        """Shortest and longest way from a foothold to the next one of the other foot: soles one behind the other fit."""
        return self.half_sole[0] + _ROOM_M + 0.01, min(_ALONG * float(self.box[0]), _OF_HEIGHT * self.height)

    @property
    def rise(self) -> float:
        """Largest difference in height of two footholds in turn."""
        return _UP * float(self.box[2])


def gait_of(robot: Robot) -> Gait:
    """The gait of a robot with a left and a right foot."""
    feet = [end for end in robot.end_effectors if end.kind == "foot"]
    sizes = np.array([foot.usual_box()[1] - foot.usual_box()[0] for foot in feet])
    # Below the CoM: what faces let soles be lifted more ahead is not for every step.
    sizes[:, 2] = [top_at(foot, *foot.nominal_B[:2]) - foot.reach_min_B[2] for foot in feet]
    half = (float(feet[0].half_size[0]), float(feet[0].half_size[1]))
    y = float(abs(feet[0].nominal_B[1]))
    return Gait(half, y, sizes.min(axis=0), float(robot.com_height))


def solvable_scene(seed: int, robot: Robot) -> Scene:
    """The scene of a seed for a robot; the same seed and robot give the same scene."""
    rng = Random(seed)
    laid = lay(seed, robot, rng)
    stance = {"foot": laid.surfaces[0].name}
    scene = Scene(
        name=f"solvable_{laid.kind}_{seed}",
        gravity=GRAVITY,
        surfaces=laid.surfaces,
        start=Stance(contacts=stance),
        goal=Stance(position_W=np.array([laid.goal[0], 0.0, laid.goal[1]]), contacts={"foot": laid.surfaces[-1].name}),
    )
    # Pads for hands stand last in the list of what is laid out, and are no goal.
    ground = [surface for surface in laid.surfaces if "foot" in surface.end_effectors]
    scene.goal.contacts = {"foot": ground[-1].name}
    scene.rules = laid.rules
    name = scene.name
    offset_W = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-0.5, 0.5)])
    scene = moved(scene, rng.uniform(-math.pi, math.pi), offset_W)
    scene.name = name
    return scene


def kind_of(seed: int, robot: Robot) -> str:
    """The kind of a seed's scene for a robot."""
    kind = KINDS[seed % len(KINDS)]
    able = {"hold": _hands_bear(robot), "jump": _legs_give_way(robot)}
    return kind if able.get(kind, True) else "patches"


def lay(seed: int, robot: Robot, rng: Random) -> Laid:
    """A seed's scene in its own frame."""
    kind, gait = kind_of(seed, robot), gait_of(robot)
    make = {"patches": patches, "strips": strips, "stairs": stairs, "jump": jump, "hold": hold}[kind]
    laid = make(rng, gait)
    laid.kind = kind
    return laid


def _hands_bear(robot: Robot) -> bool:
    hands = [end for end in robot.end_effectors if end.kind == "hand"]
    return len(hands) == 2 and all(hand.max_force > 0.75 * robot.mass * GRAVITY for hand in hands)


def _legs_give_way(robot: Robot) -> bool:
    limited = any(end.limb.given for end in robot.end_effectors)
    return not limited and float(gait_of(robot).box[2]) > 0.2 * float(robot.com_height)


def patches(rng: Random, gait: Gait) -> Laid:
    """Four to eight patches, one for every foothold: right, left, right, ... or the other way about."""
    short, long = gait.stride
    count, first_side = rng.randint(4, 8), rng.choice((-1.0, 1.0))
    half_x, half_y = gait.half_sole
    start_end = half_x + _ROOM_M
    # The first of either column lies clear of the start's ground.
    x = max(rng.uniform(short, long), start_end + 0.01 + half_x + _ROOM_M)
    surfaces, footholds = [_level("start", -0.8, start_end, 0.0)], []
    z, column_end = 0.0, {-1.0: start_end, 1.0: start_end}
    strides = [rng.uniform(short, long) for _ in range(count)]
    for i in range(count):
        side = first_side * (-1.0) ** i
        # Ahead and behind in its column: half the way to the neighbours' centres, at most.
        ahead = (strides[i] + strides[i + 1] if i + 1 < count else 2.0 * long) / 2.0
        behind = x - column_end[side] if i < 2 else (strides[i] + strides[i - 1]) / 2.0
        room = min(ahead, behind) - _BESIDE_M
        half_length = rng.uniform(half_x + _ROOM_M, max(half_x + _ROOM_M, min(room, 0.25)))
        room_y = gait.feet_y - _BESIDE_M
        half_width = rng.uniform(min(half_y + _ROOM_M, room_y), room_y)
        z = _near(rng, z, gait.rise, 0.12)
        centre = np.array([x, side * gait.feet_y, z])
        surfaces.append(_tilted(rng, f"patch_{i + 1}", centre, half_length, half_width))
        footholds.append((surfaces[-1].name, centre))
        column_end[side] = x + half_length
        x += strides[i + 1] if i + 1 < count else 0.0
    end_x = max(column_end.values()) + 0.01
    z = _near(rng, z, gait.rise, 0.12)
    goal = max(x + rng.uniform(short, long), end_x + half_x + _ROOM_M)
    surfaces.append(_level("end", end_x, goal + 0.6, z))
    return Laid(surfaces, (goal, z), "patches", footholds)


def strips(rng: Random, gait: Gait) -> Laid:
    """Two to four strips of 0.4 to 0.8 m, each tilted, with gaps and risers of a step."""
    half_x = gait.half_sole[0]
    bridged = max(0.75 * float(gait.box[0]) - 2.0 * (half_x + _ROOM_M), 0.01)
    end = rng.uniform(0.25, 0.4)
    surfaces = [_level("start", -0.8, end, 0.0)]
    z = 0.0
    count = rng.randint(2, 4)
    before = (0.0, 0.0)
    for i in range(count + 1):
        begin = end + rng.uniform(0.0, min(bridged, 0.2))
        last = i == count
        length = 0.9 if last else rng.uniform(max(0.4, 4.0 * (half_x + _ROOM_M)), 0.8)
        while True:
            tilt = (0.0, 0.0) if last else _slope(rng)
            step = rng.uniform(-gait.rise, gait.rise)
            across = abs(tilt[1] - before[1]) * gait.feet_y
            if abs(step) + across <= 1.4 * gait.rise:
                break
        z += step
        surface = _rectangle("end" if last else f"strip_{i + 1}", (begin, begin + length), (-1.0, 1.0))
        for vertex in surface:
            vertex[2] = z + tilt[0] * (vertex[0] - begin) + tilt[1] * vertex[1]
        surfaces.append(
            Surface(
                name="end" if last else f"strip_{i + 1}", vertices_W=surface, end_effectors=["foot"], friction=FRICTION
            )
        )
        z += tilt[0] * length
        end, before = begin + length, tilt
    goal = end - 0.9 + half_x + 0.2
    return Laid(surfaces, (goal, z), "strips")


def stairs(rng: Random, gait: Gait) -> Laid:
    """Two to four treads, up or down."""
    half_x = gait.half_sole[0]
    depth = rng.uniform(2.0 * (half_x + _ROOM_M), max(2.0 * (half_x + _ROOM_M), 2.0 * gait.stride[1] - 0.02))
    rise = rng.choice((-1.0, 1.0)) * rng.uniform(0.3, 1.6) * gait.rise
    first, count = rng.uniform(half_x + _ROOM_M, 0.35), rng.randint(2, 4)
    surfaces = [_level("start", -0.8, first, 0.0)]
    for i in range(count):
        begin = first + i * depth
        last = i == count - 1
        surfaces.append(
            _level("end" if last else f"tread_{i + 1}", begin, begin + (1.2 if last else depth), (i + 1) * rise)
        )
    return Laid(surfaces, (first + (count - 1) * depth + half_x + 0.15, count * rise), "stairs")


def jump(rng: Random, gait: Gait) -> Laid:
    """A gap of 1.1 times the longest step to 1.1 CoM heights, between level grounds at most 0.05 m apart in height."""
    longest = _JUMP_OVER * float(gait.box[0])
    width = rng.uniform(longest, max(longest, min(_JUMP_HEIGHTS * gait.height, longest + 0.15)))
    begin, rise = rng.uniform(0.3, 0.6), rng.uniform(-0.05, 0.05)
    end = begin + width
    surfaces = [_level("before", -1.0, begin, 0.0), _level("after", end, end + 2.0, rise)]
    return Laid(surfaces, (end + rng.uniform(0.4, 0.7), rise), "jump")


def hold(rng: Random, gait: Gait) -> Laid:
    """The built-in gap_with_rail with a gap of 0.70 to 0.80 m and pads of other sizes a little elsewhere."""
    begin, width = rng.uniform(0.4, 0.6), rng.uniform(0.70, 0.80)
    end, middle = begin + width, begin + 0.5 * width + rng.uniform(-0.02, 0.02)
    half, height = rng.uniform(0.05, 0.08), rng.uniform(0.48, 0.52)
    surfaces = [_level("before", -1.0, begin, 0.0), _level("after", end, end + 2.0, 0.0)]
    for name, low, high in (("right_pad", -0.5, -0.25), ("left_pad", 0.25, 0.5)):
        corners = _rectangle(name, (middle - half, middle + half), (low, high))
        for corner in corners:
            corner[2] = height
        hand = name.replace("pad", "hand")
        surfaces.append(Surface(name=name, vertices_W=corners, end_effectors=[hand], friction=FRICTION))
    rule = ContactRule(when_free=["foot"], require=["right_hand", "left_hand"])
    return Laid(surfaces, (end + rng.uniform(0.5, 0.7), 0.0), "hold", rules=[rule])


def _near(rng: Random, value: float, change: float, largest: float) -> float:
    """The value changed by at most `change`, with a modulus of at most `largest`."""
    return min(max(value + rng.uniform(-change, change), -largest), largest)


def _slope(rng: Random) -> tuple[float, float]:
    """dz/dx and dz/dy of a plane tilted by up to 15 degrees in any direction."""
    steep, direction = math.tan(rng.uniform(0.0, MAX_TILT_RAD)), rng.uniform(-math.pi, math.pi)
    return steep * math.cos(direction), steep * math.sin(direction)


def _tilted(rng: Random, name: str, centre: Array, half_length: float, half_width: float) -> Surface:
    slope = _slope(rng)
    corners = []
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        dx, dy = x * half_length, y * half_width
        corners.append([centre[0] + dx, centre[1] + dy, centre[2] + slope[0] * dx + slope[1] * dy])
    return Surface(name=name, vertices_W=corners, end_effectors=["foot"], friction=FRICTION)


def _rectangle(name: str, x: tuple[float, float], y: tuple[float, float]) -> list[list[float]]:
    return [[x[0], y[0], 0.0], [x[1], y[0], 0.0], [x[1], y[1], 0.0], [x[0], y[1], 0.0]]


def _level(name: str, begin: float, end: float, height: float) -> Surface:
    corners = [[x, y, height] for x, y, _ in _rectangle(name, (begin, end), (-1.0, 1.0))]
    return Surface(name=name, vertices_W=corners, end_effectors=["foot"], friction=FRICTION)
