"""Terrains for walks on given steps: Wang et al.'s three, stairs, and random patches.

    python -m mcplan.files.generate rubbles > python/mcplan/data/scenes/rubbles.toml
    mcplan scenes random_patches --seed 3 -o my.toml

A robot with feet left_foot and right_foot starts on level ground and swings its left foot first. Wang's terrains have
five columns of 0.6 m, each of a right and a left patch 0.5 m wide whose edges lie 0.06 m above and below z = 0, which
tilts them by 11.31 degrees about y or 13.50 degrees about x.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from random import Random

import numpy as np

from mcplan._core import Scene, Stance, Step, Surface
from mcplan.files.scenes import scene_to_dict
from mcplan.files.toml import toml_text

GRAVITY = 9.80665
FRICTION = 0.3
COLUMN_M, HALF_WIDTH_M = 0.6, 0.5  # length of a column; right and left patch are HALF_WIDTH_M wide each
EDGE_M = 0.06  # of patch edges above and below z = 0
PATCHES_SEED = 3
MIN_TILT_RAD, MAX_TILT_RAD = math.radians(5.0), math.radians(15.0)  # of random patches
MAX_JUMP_M = 0.12  # between corners of neighbouring random patches
MAX_HEIGHT_M = 0.10  # of a random patch's centre

# Slope of a patch: dz/dx and dz/dy in units of its steepest one.
_UP, _DOWN, _LEFT_UP, _RIGHT_UP = (1, 0), (-1, 0), (0, 1), (0, -1)
_FEET = ["foot"]
# (right, left) patch of each column
_COLUMNS = {
    "up_and_down": [(_UP, _UP), (_DOWN, _DOWN), (_UP, _UP), (_DOWN, _DOWN), (_UP, _UP)],
    "v_shape": [(_RIGHT_UP, _LEFT_UP), (_LEFT_UP, _RIGHT_UP)] * 2 + [(_RIGHT_UP, _LEFT_UP)],
    "rubbles": [
        (_RIGHT_UP, _DOWN),
        (_LEFT_UP, _UP),
        (_DOWN, _RIGHT_UP),
        (_LEFT_UP, _UP),
        (_RIGHT_UP, _DOWN),
    ],
}
_DESCRIPTIONS = {
    "up_and_down": "Five ramps up and down by 11.3 degrees, then level ground",
    "v_shape": "Ten patches tilted sideways by 13.5 degrees, in turn towards and away from each other",
    "rubbles": "Ten patches tilted forwards, backwards or sideways by 11.3 and 13.5 degrees",
}

_ORIGINS = {
    **dict.fromkeys(_COLUMNS, "Terrain of Wang et al."),
    "stairs_up": "Closed stairs",
    "random_patches": f"Patches of seed {PATCHES_SEED}; others: mcplan scenes random_patches --seed SEED -o FILE",
}

Slope = tuple[float, float]
Patch = tuple[float, Slope]  # height of the centre [m], slope [-]


def wang_terrain(name: str) -> Scene:
    """One of the three terrains of Wang et al.

    Args:
        name: "up_and_down", "v_shape" or "rubbles".
    """
    steepest = (2 * EDGE_M / COLUMN_M, 2 * EDGE_M / HALF_WIDTH_M)
    columns = [tuple((0.0, (x * steepest[0], y * steepest[1])) for x, y in column) for column in _COLUMNS[name]]
    return _patched(name, _DESCRIPTIONS[name], columns)


def random_patches(seed: int, columns: int = 10) -> Scene:
    """Two rows of patches tilted by 5 to 15 degrees in any direction, between two level grounds.

    Corners of neighbouring patches lie at most 0.12 m above each other, centres within 0.10 m of the level ground.

    Args:
        seed: Any integer; the same seed gives the same scene.
        columns: Number of columns, of two patches each.
    """
    rng = Random(seed)
    laid: list[tuple[Patch, Patch]] | None = None
    while laid is None:
        laid = _lay(rng, columns)
    return _patched("random_patches", f"{2 * columns} patches tilted by 5 to 15 degrees at mixed heights", laid)


def stairs_up(count: int = 6, rise: float = 0.12, tread: float = 0.30) -> Scene:
    """Stairs without gaps, one foot on each tread.

    Args:
        count: Number of risers.
        rise: [m]
        tread: [m]
    """
    first = 0.15  # x of the first riser: a foot of 0.22 m stands at x = 0
    surfaces = [_ground("ground", -1.0, first, 0.0)]
    for i in range(1, count):
        begin = first + (i - 1) * tread
        surfaces.append(_ground(f"tread_{i}", begin, begin + tread, i * rise))
    begin = first + (count - 1) * tread
    surfaces.append(_ground("landing", begin, begin + 4.0, count * rise))
    for surface in surfaces[1:]:
        surface.thickness = rise  # closed risers
    return Scene(
        name="stairs_up",
        description=f"{count} steps of {rise:.2f} m on treads of {tread:.2f} m, one foot on each",
        gravity=GRAVITY,
        surfaces=surfaces,
        start=Stance(contacts={"foot": "ground"}),
        goal=Stance(position_W=np.array([begin + 1.0, 0.0, count * rise]).round(4), contacts={"foot": "landing"}),
        steps=_in_turn([*(s.name for s in surfaces[1:]), "landing"]),
    )


TERRAINS: dict[str, Callable[[], Scene]] = {
    **{name: partial(wang_terrain, name) for name in _COLUMNS},
    "stairs_up": stairs_up,
    "random_patches": lambda: random_patches(PATCHES_SEED),
}


def terrain_text(name: str) -> str:
    """The content of the built-in file of a terrain."""
    header = f"{_ORIGINS[name]}\nMade by: python -m mcplan.files.generate {name}"
    return toml_text(scene_to_dict(TERRAINS[name]()), header)


def _patched(name: str, description: str, columns: Sequence[Sequence[Patch]]) -> Scene:
    """Level ground to x = 1, the columns' patches, level ground to x = 50; the feet take a patch each."""
    end = 1.0 + COLUMN_M * len(columns)
    surfaces = [_ground("start", -1.0, 1.0, 0.0)]
    for column, patches in enumerate(columns):
        for side, patch in zip(("right", "left"), patches, strict=True):
            corners = [[*corner, _height(column, side, patch, corner)] for corner in _corners(column, side)]
            surfaces.append(_surface(f"{side}_{column + 1}", corners))
    surfaces.append(_ground("end", end, 50.0, 0.0))
    return Scene(
        name=name,
        description=description,
        gravity=GRAVITY,
        surfaces=surfaces,
        start=Stance(position_W=[0.6, 0.0, 0.0], contacts={"foot": "start"}),
        goal=Stance(position_W=[20.0, 0.0, 0.0], contacts={"foot": "end"}),
        steps=_in_turn([*(surface.name for surface in surfaces), "end"]),
    )


def _lay(rng: Random, columns: int) -> list[tuple[Patch, Patch]] | None:
    """Patches drawn one after the other, each fitting those before it; None where one does not fit in 100 draws."""
    laid: list[list[Patch]] = []
    for column in range(columns):
        laid.append([])
        for side in ("right", "left"):
            for _ in range(100):
                tilt, direction = rng.uniform(MIN_TILT_RAD, MAX_TILT_RAD), rng.uniform(-math.pi, math.pi)
                slope = (math.tan(tilt) * math.cos(direction), math.tan(tilt) * math.sin(direction))
                low, high = _heights_that_fit(laid, columns, column, side, slope)
                if low <= high:
                    laid[-1].append((rng.uniform(low, high), slope))
                    break
            else:
                return None
    return [(right, left) for right, left in laid]


def _heights_that_fit(
    laid: Sequence[Sequence[Patch]], columns: int, column: int, side: str, slope: Slope
) -> tuple[float, float]:
    """Lowest and highest centre [m] of the next patch, whose slope is given; the first above the second: none."""
    neighbours: list[tuple[Slope, float]] = []  # corner, height there
    for corner in _corners(column, side):
        for other_column, patches in enumerate(laid):
            for other_side, patch in zip(("right", "left"), patches, strict=False):
                if any(math.dist(corner, other) < 1e-9 for other in _corners(other_column, other_side)):
                    neighbours.append((corner, _height(other_column, other_side, patch, corner)))
        if (column == 0 and corner[0] < 1.0 + 1e-9) or (column == columns - 1 and corner[0] > _begin(columns) - 1e-9):
            neighbours.append((corner, 0.0))
    low, high = -MAX_HEIGHT_M, MAX_HEIGHT_M
    for corner, height in neighbours:
        centre = height - _height(column, side, (0.0, slope), corner)
        low, high = max(low, centre - MAX_JUMP_M), min(high, centre + MAX_JUMP_M)
    return low, high


def _begin(column: int) -> float:
    return 1.0 + COLUMN_M * column


def _corners(column: int, side: str) -> list[Slope]:
    """(x, y) of a patch's corners [m], counter-clockwise."""
    y = -HALF_WIDTH_M if side == "right" else 0.0
    x0, x1 = _begin(column), _begin(column + 1)
    return [(x0, y), (x1, y), (x1, y + HALF_WIDTH_M), (x0, y + HALF_WIDTH_M)]


def _height(column: int, side: str, patch: Patch, point: Slope) -> float:
    centre = np.mean(_corners(column, side), axis=0)
    return patch[0] + patch[1][0] * (point[0] - centre[0]) + patch[1][1] * (point[1] - centre[1])


def _in_turn(surfaces: Sequence[str]) -> list[Step]:
    """A step onto each surface, the left foot first."""
    feet = ("left_foot", "right_foot")
    return [Step(end_effector=feet[i % 2], surface=surface) for i, surface in enumerate(surfaces)]


def _ground(name: str, begin: float, end: float, height: float) -> Surface:
    corners = [(begin, -0.5), (end, -0.5), (end, 0.5), (begin, 0.5)]
    return _surface(name, [[x, y, height] for x, y in corners])


def _surface(name: str, corners: list[list[float]]) -> Surface:
    rounded = np.round(corners, 6) + 0.0  # + 0.0: no negative zeros
    return Surface(name=name, vertices_W=rounded, friction=FRICTION, end_effectors=_FEET)
