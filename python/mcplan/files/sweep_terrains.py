"""Terrains that a sweep can ask for by name and parameters, and what it may change of any scene."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from random import Random
from typing import Any

import numpy as np

from mcplan._core import Robot, Scene, Stance, Surface
from mcplan.files.generate import GRAVITY, moved, random_scene, stones
from mcplan.files.scenes import SCALES, load_scene, scaled
from mcplan.files.solvable_scenes import solvable_scene
from mcplan.files.terrains import random_patches, stairs_up

_MAX_SEED = 2**53 - 1


@dataclass(frozen=True)
class Parameter:
    """A number that a terrain depends on.

    Attributes:
        low: Least legal value.
        high: Largest legal value.
        meaning: A line for people, with the unit.
        whole: Whether it is a whole number.
        default: Its value where a sweep says nothing; of a seed None: one that is drawn.
    """

    low: float
    high: float
    meaning: str
    whole: bool = False
    default: float | None = None

    def rule(self, value: Any) -> str:
        """What a value violates, or nothing."""
        if isinstance(value, bool) or not isinstance(value, int if self.whole else (int, float)):
            return "must be a whole number" if self.whole else "must be a number"
        return "" if self.low <= value <= self.high else f"must lie in [{self.low:.16g}, {self.high:.16g}]"


@dataclass(frozen=True)
class Generator:
    """A kind of terrain: how a robot and parameters make a scene."""

    make: Callable[..., Scene]
    parameters: Mapping[str, Parameter]


_SEED = Parameter(0, _MAX_SEED, "Seed of the terrain.", whole=True)

#: By the name that a sweep gives them.
GENERATORS: dict[str, Generator] = {
    "random": Generator(lambda robot, seed: random_scene(seed), {"seed": _SEED}),
    "solvable": Generator(lambda robot, seed: solvable_scene(seed, robot), {"seed": _SEED}),
    "random_patches": Generator(
        lambda robot, seed, columns: random_patches(seed, columns),
        {"seed": _SEED, "columns": Parameter(1, 40, "Number of columns, of two patches each.", True, 10)},
    ),
    "stepping_stones": Generator(
        lambda robot, seed, rows, spacing_m: _stepping_stones(seed, rows, spacing_m),
        {
            "seed": _SEED,
            "rows": Parameter(1, 40, "Stones in each of two columns.", True, 6),
            "spacing_m": Parameter(0.2, 1.0, "Distance of the stones' centres [m].", False, 0.22),
        },
    ),
    "stairs": Generator(
        lambda robot, count, rise_m, tread_m: stairs_up(count, rise_m, tread_m),
        {
            "count": Parameter(1, 40, "Number of risers.", True, 4),
            "rise_m": Parameter(0.01, 0.5, "Height of a riser [m].", False, 0.12),
            "tread_m": Parameter(0.2, 1.5, "Depth of a tread [m].", False, 0.30),
        },
    ),
    "gap": Generator(
        lambda robot, width_m, rise_m: _two_levels("gap", width_m, rise_m),
        {
            "width_m": Parameter(0.0, 5.0, "Distance from edge to edge [m].", False, 0.3),
            "rise_m": Parameter(-1.0, 1.0, "Height of the far side above the near one [m].", False, 0.0),
        },
    ),
    "slope": Generator(
        lambda robot, angle_deg: _slope(angle_deg),
        {"angle_deg": Parameter(-45.0, 45.0, "Angle of the ground, up or down [deg].", False, 10.0)},
    ),
}

#: What may be changed of any scene, built-in, from a file or generated; applied in this order.
CHANGES: dict[str, Parameter] = {
    "scale": Parameter(*SCALES, "Factor on all lengths of the scene."),
    "friction": Parameter(0.0, 10.0, "Friction coefficient of all surfaces."),
    "yaw_deg": Parameter(-360.0, 360.0, "Angle by which the scene is turned about the vertical [deg]."),
}


def parameters_of(generator: str | None) -> dict[str, Parameter]:
    """What a scene of a sweep takes; None: it is not generated."""
    return {**(GENERATORS[generator].parameters if generator else {}), **CHANGES}


def make_scene(generator: str | None, source: str, parameters: Mapping[str, Any], robot: Robot) -> Scene:
    """The scene of a task.

    Args:
        generator: Name of the terrain; None: the scene is loaded.
        source: Built-in name or path of the scene that is loaded.
        parameters: By name, all that the generator needs, and changes.
        robot: Whose scene it is.

    Raises:
        InvalidScene, UnknownScene: There is no such scene, or its file is malformed.
    """
    own = {name: value for name, value in parameters.items() if name not in CHANGES}
    scene = GENERATORS[generator].make(robot, **own) if generator else load_scene(source)
    if "scale" in parameters:
        scene = scaled(scene, parameters["scale"])
    if "friction" in parameters:
        scene = scene.__copy__()
        for surface in scene.surfaces:
            surface.friction = parameters["friction"]
    if "yaw_deg" in parameters:
        scene = moved(scene, math.radians(parameters["yaw_deg"]), np.zeros(3))
    return scene


def _stepping_stones(seed: int, rows: int, spacing_m: float) -> Scene:
    scene = stones(Random(seed), rows, spacing_m)
    scene.name = f"stepping_stones_{seed}"
    return scene


def _two_levels(name: str, width_m: float, rise_m: float) -> Scene:
    """Level ground, a gap, and level ground again."""
    begin, end = 0.5, 0.5 + width_m
    near, far = _rectangle("before", -1.0, begin, 0.0), _rectangle("after", end, end + 2.0, 0.0)
    far.vertices_W[:, 2] = rise_m
    return _scene(name, [near, far], (end + 0.6, rise_m))


def _slope(angle_deg: float) -> Scene:
    """Level ground, then a plane at an angle."""
    steep = math.tan(math.radians(angle_deg))
    return _scene(
        "slope", [_rectangle("before", -1.0, 0.4, 0.0), _rectangle("after", 0.4, 2.4, steep)], (1.6, 1.2 * steep)
    )


def _scene(name: str, surfaces: list[Surface], goal: tuple[float, float]) -> Scene:
    return Scene(
        name=name,
        gravity=GRAVITY,
        surfaces=surfaces,
        start=Stance(contacts={"foot": "before"}),
        goal=Stance(position_W=np.array([goal[0], 0.0, goal[1]]), contacts={"foot": "after"}),
    )


def _rectangle(name: str, begin: float, end: float, steep: float) -> Surface:
    corners = [[begin, -1.0], [end, -1.0], [end, 1.0], [begin, 1.0]]
    return Surface(name=name, vertices_W=[[x, y, steep * (x - begin)] for x, y in corners], end_effectors=["foot"])
