"""Scenes made by rule: the built-in stepping stones, random scenes for measuring robustness, terrains for walks.

    python -m mcplan.files.generate stones > python/mcplan/data/scenes/stepping_stones.toml
    python -m mcplan.files.generate rubbles > python/mcplan/data/scenes/rubbles.toml
    python -m mcplan.files.generate random 17        # prints random_scene(17) as TOML

Sizes suit humanoid44 in 18 phases: ways of at most 2 m, foot strides of about 0.45 m. Python's own random numbers are
used because their sequence is fixed for ever.
"""

from __future__ import annotations

import math
import sys
from random import Random

import numpy as np

from mcplan._core import Scene, Stance, Surface
from mcplan.files.scenes import scene_to_dict
from mcplan.files.terrains import TERRAINS, terrain_text
from mcplan.files.toml import toml_text

KINDS = ("stairs", "gap", "stones", "slope")
GRAVITY = 9.8
STONES_SEED = 4
_FEET = ["foot"]


def random_scene(seed: int) -> Scene:
    """A scene that humanoid44 can cross by construction: stairs, gap, stones or slope, perhaps mirrored, turned, moved.

    Args:
        seed: Any integer; the same seed gives the same scene. Kinds take turns: seed modulo 4.
    """
    kind = KINDS[seed % len(KINDS)]
    rng = Random(seed)
    make = {"stairs": stairs, "gap": gap, "stones": stones, "slope": slope}[kind]
    scene = make(rng)
    if rng.random() < 0.5:
        scene = mirrored(scene)
    offset_W = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-0.5, 0.5)])
    scene = moved(scene, rng.uniform(-math.pi, math.pi), offset_W)
    scene.name = f"random_{kind}_{seed}"
    return scene


def stairs(rng: Random) -> Scene:
    """Two or three treads up: pitch 0.35 to 0.50 m, rise 0.05 to 0.12 m, treads at least 0.22 m deep."""
    pitch, rise, count = rng.uniform(0.35, 0.5), rng.uniform(0.05, 0.12), rng.randint(2, 3)
    depth = rng.uniform(0.22, min(pitch, 0.30))
    first = max(rng.uniform(0.3, 0.4), pitch - depth + 0.12)  # the ground ends 0.12 m ahead of the start or further
    surfaces = [_rectangle("ground", -1.0, first - pitch + depth, 0.0)]
    for i in range(count):
        begin = first + i * pitch
        surfaces.append(_rectangle(f"tread_{i + 1}", begin, begin + (depth if i < count - 1 else 0.8), (i + 1) * rise))
    return _scene(surfaces, first + (count - 1) * pitch + 0.2, count * rise, "ground", f"tread_{count}")


def gap(rng: Random) -> Scene:
    """A gap of 0.30 to 0.80 m."""
    begin, width = rng.uniform(0.35, 0.6), rng.uniform(0.3, 0.8)
    end = begin + width
    surfaces = [_rectangle("before", -1.0, begin, 0.0), _rectangle("after", end, end + 2.0, 0.0)]
    return _scene(surfaces, end + rng.uniform(0.4, 0.7), 0.0, "before", "after")


def slope(rng: Random) -> Scene:
    """A slope of 5 to 15 degrees, up or down, after level ground."""
    angle = math.radians(rng.uniform(5.0, 15.0)) * rng.choice((-1.0, 1.0))
    begin, goal = rng.uniform(0.2, 0.5), rng.uniform(1.2, 1.7)
    end = goal + 0.8
    ramp = _rectangle("slope", begin, end, 0.0)
    ramp.vertices_W[:, 2] = (ramp.vertices_W[:, 0] - begin) * math.tan(angle)
    return _scene(
        [_rectangle("ground", -1.0, begin, 0.0), ramp],
        goal,
        (goal - begin) * math.tan(angle),
        "ground",
        "slope",
    )


def stones(rng: Random, rows: int = 6, spacing: float = 0.22) -> Scene:
    """Two columns of stones, a foot's width apart, between two platforms.

    A stone every 0.22 m allows strides of 0.22 m and of 0.44 m. Heights lie within 0.06 m of each other, so that no step
    leaves the reach box of a foot whichever stones are used.

    Args:
        rng: Source of sizes, corners and heights.
        rows: Stones in each column.
        spacing: Distance of their centres [m].
    """
    surfaces = [_rectangle("start", -0.6, 0.14, 0.0, half_width=0.4)]
    for row in range(rows):
        for side, name in ((-1.0, "right"), (1.0, "left")):
            centre = (0.27 + spacing * row + rng.uniform(-0.01, 0.01), side * rng.uniform(0.10, 0.12))
            surfaces.append(_stone(rng, f"{name}_{row + 1}", centre, height=rng.uniform(0.0, 0.06)))
    end = 0.27 + spacing * rows - 0.08
    height = rng.uniform(0.0, 0.06)
    surfaces.append(_rectangle("end", end, end + 0.8, height, half_width=0.4))
    scene = _scene(surfaces, end + 0.25, height, "start", "end")
    scene.description = f"{2 * rows} stones at mixed heights"
    return scene


def mirrored(scene: Scene) -> Scene:
    """The scene with left and right exchanged (y -> -y), for robots that are the same on both sides.

    Permissions, contacts and rules must name kinds, not ends: names are kept as they are.
    """
    out = scene.__copy__()
    for surface in out.surfaces:
        surface.vertices_W = (surface.vertices_W * [1.0, -1.0, 1.0])[::-1]
    for stance in (out.start, out.goal):
        stance.position_W = stance.position_W * [1.0, -1.0, 1.0]
        stance.yaw = -stance.yaw
    return out


def moved(scene: Scene, yaw: float, offset_W: np.ndarray) -> Scene:
    """The scene turned about the world's z axis by yaw [rad], then moved by offset_W [m]."""
    turn = np.array([[math.cos(yaw), -math.sin(yaw), 0.0], [math.sin(yaw), math.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
    out = scene.__copy__()
    for surface in out.surfaces:
        surface.vertices_W = surface.vertices_W @ turn.T + offset_W
    for stance in (out.start, out.goal):
        stance.position_W = turn @ stance.position_W + offset_W
        stance.yaw = stance.yaw + yaw
    return out


def _scene(surfaces: list[Surface], goal_x: float, goal_z: float, first: str, last: str) -> Scene:
    return Scene(
        gravity=GRAVITY,
        surfaces=surfaces,
        start=Stance(contacts={"foot": first}),
        goal=Stance(position_W=np.array([goal_x, 0.0, goal_z]), contacts={"foot": last}),
    )


def _rectangle(name: str, begin: float, end: float, height: float, half_width: float = 1.0) -> Surface:
    corners = [[begin, -half_width], [end, -half_width], [end, half_width], [begin, half_width]]
    return Surface(name=name, vertices_W=[[x, y, height] for x, y in corners], end_effectors=_FEET)


def _stone(rng: Random, name: str, centre: tuple[float, float], height: float) -> Surface:
    """Hexagon with corners on an ellipse, which makes it convex whatever their angles are."""
    half_length, half_width = rng.uniform(0.085, 0.095), rng.uniform(0.075, 0.085)
    angles = [math.radians(60 * i + rng.uniform(-12, 12)) for i in range(6)]
    corners = [(centre[0] + half_length * math.cos(a), centre[1] + half_width * math.sin(a)) for a in angles]
    return Surface(
        name=name,
        vertices_W=[[round(x, 4), round(y, 4), round(height, 4)] for x, y in corners],
        end_effectors=_FEET,
    )


def stepping_stones() -> Scene:
    """The built-in scene of that name."""
    scene = stones(Random(STONES_SEED))
    scene.name = "stepping_stones"
    for stance in (scene.start, scene.goal):
        stance.position_W = stance.position_W.round(4)
    for surface in scene.surfaces:
        surface.vertices_W = surface.vertices_W.round(4)
    return scene


def stepping_stones_text() -> str:
    """The content of the built-in file."""
    header = (
        f"Two columns of stones between two platforms, made by mcplan.files.generate.stones(Random({STONES_SEED})):\n"
        "python -m mcplan.files.generate stones\n"
        "A stone every 0.22 m allows strides of 0.22 m and of 0.44 m; heights lie within 0.06 m of each other."
    )
    return toml_text(scene_to_dict(stepping_stones()), header)


def main(arguments: list[str]) -> None:
    if arguments == ["stones"]:
        sys.stdout.write(stepping_stones_text())
    elif len(arguments) == 2 and arguments[0] == "random":
        sys.stdout.write(toml_text(scene_to_dict(random_scene(int(arguments[1])))))
    elif len(arguments) == 1 and arguments[0] in TERRAINS:
        sys.stdout.write(terrain_text(arguments[0]))
    else:
        sys.exit(f"usage: python -m mcplan.files.generate stones | {' | '.join(TERRAINS)} | random SEED")


if __name__ == "__main__":
    main(sys.argv[1:])
