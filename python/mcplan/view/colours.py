"""Colours of pages, pictures and plots, chosen to stay apart for colour-blind readers.

End-effectors on the left are cool, those on the right warm; the first of a side is dark, the second light
(Okabe and Ito's palette). Surfaces in plots take Tol's muted palette, which does not meet the former.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

COOL = ("#0072B2", "#56B4E9", "#009E73", "#7FB7A3")
WARM = ("#D55E00", "#E69F00", "#CC79A7", "#A8563A")
SURFACES = ("#88A9C9", "#DDCC77", "#CC6677", "#117733", "#AA4499", "#44AA99", "#882255", "#6E6AB5", "#999933")

COM = "#7A1F5C"
GROUND = "#DADDE2"
WALL = "#9DB4CC"
GRASP = "#2AA889"
#: Surfaces for hands alone.
PAD = "#DDC94B"
OUTLINE = "#8A919C"
#: Axes of the world, as everywhere: x, y, z. Outward normals; start and goal of a scene.
AXES = ("#C8102E", "#1A8F3C", "#1F5FD1")
NORMAL = "#7A5C00"
START, GOAL = "#1A7F37", "#8250DF"
BODY = "#A9B2BD"
LIMB = "#98A2AE"
HEAD = "#B9C1CA"
VISOR = "#333A43"
FORCE = "#2B2F36"
TEXT = "#22262B"
#: What the plan asks for, beside what a run did; a push; the assistance's wrench.
PLANNED = "#8A919C"
PUSH = "#C8102E"
#: A contact that nobody planned.
TOUCH = "#B8860B"
#: Contact forces over a rendered robot, whose legs may be black.
FORCE_BRIGHT = "#17A55B"
ASSIST = "#6E40C9"


def end_effector_colours(robot: Robot) -> list[str]:
    """One colour per end-effector of the robot, "#rrggbb"."""
    counts = {True: 0, False: 0}
    colours = []
    for end in robot.end_effectors:
        left = float(end.nominal_B[1]) > 0.0
        palette = COOL if left else WARM
        colours.append(palette[counts[left] % len(palette)])
        counts[left] += 1
    return colours


def surface_colours(scene: Scene, used: Collection[int] | None = None) -> list[str]:
    """One colour per surface of the scene for plots, "#rrggbb"; grasps keep their accent.

    Args:
        scene: Its surfaces.
        used: Indices of those that a plot shows, which have different colours as far as there are any; None: all.
    """
    colours = [GRASP if surface.grasp else GROUND for surface in scene.surfaces]
    shown = range(len(colours)) if used is None else sorted(used)
    for number, i in enumerate(i for i in shown if not scene.surfaces[i].grasp):
        colours[i] = surface_colour(number)
    return colours


def surface_colour(number: int) -> str:
    """The colour of one of many surfaces in a plot, "#rrggbb": the palette, then darker, then lighter, then over again."""
    again, place = divmod(number, len(SURFACES))
    colour = SURFACES[place]
    return (colour, mix(colour, "#000000", 0.45), mix(colour, "#ffffff", 0.55))[again % 3]


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green, blue in [0, 1] of "#rrggbb"."""
    return tuple(int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))  # type: ignore[return-value]


def mix(colour: str, other: str, fraction: float) -> str:
    """`colour` with the given fraction of `other`, "#rrggbb"."""
    blend = [(1.0 - fraction) * a + fraction * b for a, b in zip(rgb(colour), rgb(other), strict=True)]
    return "#" + "".join(f"{round(255 * c):02x}" for c in blend)


def plain(name: str) -> str:
    """A name as matplotlib is to show it: no dollar begins a formula."""
    return name.replace("$", r"\$").replace("_", " ")
