"""Caption, legend and timeline of a page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

from mcplan.errors import printable
from mcplan.kinematics.samples import Interval
from mcplan.view.colours import COM, GRASP
from mcplan.view.scene_drawing import for_hands
from mcplan.view.stage import node

from .annotations import length_text

if TYPE_CHECKING:
    from mcplan._core import PlanarRobot, PlanarTask, Robot, Scene


#: Buttons below the timeline.
CONTROLS = (
    '<div id="controls"><button id="before" title="phase before (shift and left)">|&#9664;</button>'
    '<button id="play" title="play, pause (space)"></button>'
    '<button id="after" title="next phase (shift and right)">&#9654;|</button><span id="clock"></span>'
    '<select id="speed" title="speed (+, -)" aria-label="speed">'
    + "".join(
        f'<option value="{s:g}"{" selected" if s == 1 else ""}>{s:g}&times;</option>' for s in (0.1, 0.25, 0.5, 1, 2)
    )
    + '</select><span id="phase"></span><span id="keys">space: play &middot; &larr; &rarr;: frames, with shift phases '
    '&middot; + &minus;: speed &middot; l: legend &middot; <span id="joints" hidden>j: joints &middot; </span>'
    "r: view</span></div>"
)


def as_shown(text: str) -> str:
    """Text from a file as the page shows it: markup and control characters written out."""
    return escape(printable(text))


def caption(title: str, lines: list[str], entries: list[str]) -> str:
    """Panel at the top left: a title, lines of text, legend entries."""
    text = "".join(f"<p>{as_shown(line)}</p>" for line in lines)
    name = as_shown(title)
    head = (
        f'<div id="head"><h1 title="{name}">{name}</h1><svg id="gizmo" viewBox="0 0 46 46"></svg>'
        '<button id="fold" title="legend (l)" aria-label="legend">&#10005;</button></div>'
    )
    return f'<div class="panel" id="caption">{head}<div id="facts">{text}{"".join(entries)}</div></div>'


def plan_legend(scene: Scene, robot: Robot, colours: list[str], newton_per_metre: float) -> list[str]:
    """Legend entries for a plan; a click hides what they name."""
    entries = [entry("com paths/com", "ball", COM, "centre of mass")]
    for end, colour in zip(robot.end_effectors, colours, strict=True):
        own = f"paths/{node(end.name)} contacts/{node(end.name)}"
        entries.append(entry(own, "line", colour, end.name.replace("_", " ")))
    entries.append(entry("forces", "arrow", "", force_text("contact force", newton_per_metre, float(robot.com_height))))
    entries.append(entry("robot", "", "#98a2ae", "robot"))
    names = entry(":surface", "text", "", "names of surfaces", shown=False)
    return [*entries, *scene_legend(scene), *space_legend(), names]


def scene_legend(scene: Scene) -> list[str]:
    """Legend entries for surfaces that are special."""
    special = [([s.name for s in scene.surfaces if s.grasp], GRASP, "may be held"), *for_hands(scene)]
    return [
        entry(" ".join(f"scene/{node(name)}" for name in names), "", colour, text)
        for names, colour, text in special
        if names
    ]


def space_legend() -> list[str]:
    """Legend entry of the world's axes and the scale bar."""
    return [entry("axes scale :axis :scale", "text", "", "world axes, scale")]


def force_text(what: str, newton_per_metre: float, size_m: float | None = None) -> str:
    """How long an arrow of a force is; `size_m`: of the robot, the power of ten below it is the length."""
    if size_m is not None:
        length = 10.0 ** math.floor(math.log10(size_m))
        return f"{what} ({newton_per_metre * length:.3g} N: {length_text(length)})"
    length = 0.1
    while not 5.0 <= newton_per_metre * length < 5e4 and 1e-9 < length < 1e9:
        length *= 10.0 if newton_per_metre * length < 5.0 else 0.1
    return f"{what} ({newton_per_metre * length:.3g} N: {length_text(length)})"


@dataclass(frozen=True)
class Bars:
    """What a timeline shows.

    Attributes:
        intervals: The contacts.
        planned: Contacts as they were planned: thin lines below the others.
        marks: Events across all rows: start [s], end [s], colour, text.
    """

    intervals: Sequence[Interval]
    planned: Sequence[Interval] = ()
    marks: Sequence[tuple[float, float, str, str]] = ()


def timeline(
    scene: Scene | PlanarTask, robot: Robot | PlanarRobot, bars: Bars, colours: list[str], duration_s: float
) -> str:
    """Panel at the bottom: contacts of every end-effector over time, and a cursor.

    Args:
        scene: Names the surfaces.
        robot: Names the end-effectors.
        bars: Contacts and events.
        colours: Colours of the end-effectors.
        duration_s: Length of the axis.
    """
    names, tracks = [], []
    for end, colour in zip(range(len(colours)), colours, strict=True):
        names.append(f'<div style="color: {colour}">{as_shown(robot.end_effectors[end].name.replace("_", " "))}</div>')
        own = []
        for interval in bars.intervals:
            if interval.end_effector != end:
                continue
            left = 100.0 * interval.start_s / duration_s
            width = 100.0 * (interval.end_s - interval.start_s) / duration_s
            name = as_shown(scene.surfaces[interval.surface].name)
            own.append(
                f'<div class="bar" style="left: {left:.3f}%; width: {width:.3f}%; background: {colour}" '
                f'title="{name}, {interval.start_s:.2f} to {interval.end_s:.2f} s">{name}</div>'
            )
        for interval in bars.planned:
            if interval.end_effector == end:
                left = 100.0 * interval.start_s / duration_s
                width = 100.0 * (interval.end_s - interval.start_s) / duration_s
                own.append(f'<div class="planned" style="left: {left:.3f}%; width: {width:.3f}%"></div>')
        tracks.append(f'<div class="track">{"".join(own)}</div>')
    events = "".join(
        f'<div class="event" style="left: {100.0 * start / duration_s:.3f}%; '
        f'width: {100.0 * (end_s - start) / duration_s:.3f}%; background: {colour}" title="{as_shown(text)}"></div>'
        for start, end_s, colour, text in bars.marks
    )
    return (
        f'<div class="panel" id="timeline"><div id="bars"><div id="names">{"".join(names)}</div><div id="tracks">'
        f'{"".join(tracks)}{events}<div id="axis">{_ticks(duration_s)}</div><div id="cursor"></div></div></div>'
        f"{CONTROLS}</div>"
    )


def _ticks(duration_s: float) -> str:
    """Labels of the time axis; where there is little space the page shows every third."""
    steps = [r * 10.0**p for p in range(-4, 7) for r in (1, 2, 5)]
    step = next((s for s in steps if duration_s / s <= 12), duration_s)
    ticks = [(i, i * step) for i in range(1, int(duration_s / step) + 1) if i * step < 0.985 * duration_s]
    return "".join(
        f"<span{' class=major' if i % 3 == 0 or len(ticks) < 3 else ''} "
        f'style="left: {100.0 * t / duration_s:.3f}%">{t:g} s</span>'
        for i, t in ticks
    )


def entry(nodes: str, shape: str, colour: str, text: str, shown: bool = True) -> str:
    """Legend entry that hides and shows nodes, or behind a colon kinds of labels.

    Args:
        nodes: Their paths, with blanks between.
        shape: Shape of its swatch: "line", "ball", "arrow", "text", or "" for a patch.
        colour: Colour of the swatch.
        text: What they are.
        shown: From the start.
    """
    style = f' style="background: {colour}"' if colour else ""
    checked = " checked" if shown else ""
    return (
        f'<label><input type="checkbox"{checked} data-nodes="{as_shown(nodes)}">'
        f'<span class="swatch {shape}"{style}>{"A" if shape == "text" else ""}</span>{as_shown(text)}</label>'
    )
