"""Caption, legend and timeline of a page."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from mcplan.kinematics.samples import Interval

from .colours import COM, GRASP

if TYPE_CHECKING:
    from mcplan import Robot, Scene
    from mcplan._core import PlanarMotion, PlanarRobot


def caption(title: str, lines: list[str], entries: list[str]) -> str:
    """Panel at the top left: a title, lines of text, legend entries."""
    text = "".join(f"<p>{escape(line)}</p>" for line in lines)
    return f'<div class="panel" id="caption"><h1>{escape(title)}</h1>{text}{"".join(entries)}</div>'


def plan_legend(scene: Scene, robot: Robot, colours: list[str], newton_per_metre: float) -> list[str]:
    """Legend entries for a plan; a click hides what they name."""
    entries = [entry("com paths/com", "ball", COM, "centre of mass")]
    for end, colour in zip(robot.end_effectors, colours, strict=True):
        entries.append(entry(f"paths/{end.name} contacts/{end.name}", "line", colour, end.name.replace("_", " ")))
    entries.append(entry("forces", "arrow", "", f"contact force ({0.1 * newton_per_metre:.0f} N: 10 cm)"))
    entries.append(entry("robot", "", "#98a2ae", "robot"))
    return entries + scene_legend(scene)


def scene_legend(scene: Scene) -> list[str]:
    """Legend entries for surfaces that are special."""
    grasps = [surface.name for surface in scene.surfaces if surface.grasp]
    return [entry(" ".join(f"scene/{name}" for name in grasps), "", GRASP, "may be held")] if grasps else []


def timeline(
    scene: Scene | PlanarMotion,
    robot: Robot | PlanarRobot,
    intervals: list[Interval],
    colours: list[str],
    duration_s: float,
    planned: list[Interval] | None = None,
    marks: list[tuple[float, float, str, str]] | None = None,
) -> str:
    """Panel at the bottom: contacts of every end-effector over time, and a cursor.

    Args:
        scene: Names the surfaces.
        robot: Names the end-effectors.
        intervals: The contacts.
        colours: Of the end-effectors.
        duration_s: Length of the axis.
        planned: Contacts as they were planned: thin lines below the others.
        marks: Events across all rows: start [s], end [s], colour, text.
    """
    names, tracks = [], []
    for end, colour in zip(range(len(colours)), colours, strict=True):
        names.append(f'<div style="color: {colour}">{escape(robot.end_effectors[end].name.replace("_", " "))}</div>')
        bars = []
        for interval in intervals:
            if interval.end_effector != end:
                continue
            left = 100.0 * interval.start_s / duration_s
            width = 100.0 * (interval.end_s - interval.start_s) / duration_s
            name = escape(scene.surfaces[interval.surface].name)
            bars.append(
                f'<div class="bar" style="left: {left:.3f}%; width: {width:.3f}%; background: {colour}" '
                f'title="{name}, {interval.start_s:.2f} to {interval.end_s:.2f} s">{name}</div>'
            )
        for interval in planned or []:
            if interval.end_effector == end:
                left = 100.0 * interval.start_s / duration_s
                width = 100.0 * (interval.end_s - interval.start_s) / duration_s
                bars.append(f'<div class="planned" style="left: {left:.3f}%; width: {width:.3f}%"></div>')
        tracks.append(f'<div class="track">{"".join(bars)}</div>')
    events = "".join(
        f'<div class="event" style="left: {100.0 * start / duration_s:.3f}%; '
        f'width: {100.0 * (end_s - start) / duration_s:.3f}%; background: {colour}" title="{escape(text)}"></div>'
        for start, end_s, colour, text in marks or []
    )
    step = next(s for s in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 1e9) if duration_s / s <= 12)
    ticks = [i * step for i in range(1, int(duration_s / step) + 1)]
    labels = "".join(
        f'<span style="left: {100.0 * t / duration_s:.3f}%">{t:g} s</span>' for t in ticks if t < 0.99 * duration_s
    )
    return (
        f'<div class="panel" id="timeline"><div id="names">{"".join(names)}<button id="play"></button></div>'
        f'<div id="tracks">{"".join(tracks)}{events}<div id="axis">{labels}</div><div id="cursor"></div></div></div>'
    )


def entry(nodes: str, shape: str, colour: str, text: str) -> str:
    """Legend entry that hides and shows nodes; its swatch is a "line", "ball", "arrow", or a patch."""
    style = f' style="background: {colour}"' if colour else ""
    return (
        f'<label><input type="checkbox" checked data-nodes="{escape(nodes)}">'
        f'<span class="swatch {shape}"{style}></span>{escape(text)}</label>'
    )
