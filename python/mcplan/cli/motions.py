"""mcplan motions"""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from mcplan._core import PlanarClearance, PlanarContact, PlanarPhase, PlanarPose, PlanarTask


def motions(
    name: Annotated[str | None, typer.Argument(metavar="[NAME]", help="Built-in name or TOML file.")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="TOML file to write.")] = None,
) -> None:
    """List the built-in motions of planar robots, or print or copy one.

    Example: mcplan motions stairs

    Example: mcplan motions walking -o my.toml
    """
    from mcplan.cli.table import print_table
    from mcplan.errors import InvalidInput
    from mcplan.files.motions import list_motions, load_motion, save_motion
    from mcplan.files.outputs import TOML, require_target

    if name is None:
        if output is not None:
            raise InvalidInput("--output", "needs the NAME of a motion")
        loaded = [load_motion(entry) for entry in list_motions()]
        print_table([motion.name, motion.robot.name, motion.description] for motion in loaded)
        return
    require_target("--output", output, TOML)
    motion = load_motion(name)
    if output is None:
        _print_motion(motion)
    else:
        save_motion(motion, output, f"Made by: mcplan motions {name} -o {output}")
        say(f"Wrote {output}")


def _print_motion(motion: PlanarTask) -> None:
    from mcplan.cli.table import print_table

    say(f"{motion.name}: {motion.description}" if motion.description else motion.name)
    robot = motion.robot
    say(f"robot {robot.name}, {robot.joint_count()} joints, {motion.interval_count()} intervals")
    say()
    rows = [
        [
            surface.name,
            _numbers(surface.origin_W),
            f"{math.degrees(surface.angle):g}",
            f"{surface.from_:g} .. {surface.to:g}",
            f"{surface.friction:g}",
        ]
        for surface in motion.surfaces
    ]
    print_table(rows, ["surface", "origin [m]", "angle [deg]", "extent [m]", "friction"])
    say()
    rows = [
        [
            str(k),
            str(phase.intervals),
            f"{phase.min_duration:g} .. {phase.max_duration:g}",
            ", ".join(_contact(contact, motion) for contact in phase.contacts),
            ", ".join(_demands(phase, motion)) or "-",
        ]
        for k, phase in enumerate(motion.phases)
    ]
    print_table(rows, ["phase", "intervals", "duration [s]", "contacts", "besides"])


def _contact(contact: PlanarContact, motion: PlanarTask) -> str:
    who, surface = motion.robot.end_effectors[contact.end_effector].name, motion.surfaces[contact.surface].name
    return f"{who} on {surface} ({_numbers(contact.position_W)})"


def _demands(phase: PlanarPhase, motion: PlanarTask) -> list[str]:
    return [_clearance(entry, phase, motion) for entry in phase.clearances] + [
        _pose(pose, motion) for pose in phase.poses
    ]


def _clearance(entry: PlanarClearance, phase: PlanarPhase, motion: PlanarTask) -> str:
    who, surface = motion.robot.end_effectors[entry.end_effector].name, motion.surfaces[entry.surface].name
    end = phase.intervals if entry.end_interval < 0 else entry.end_interval
    text = f"{who} clear of {surface}"
    if (entry.first_interval, end) != (0, phase.intervals):
        text += f" in intervals {entry.first_interval} to {end - 1}"
    if math.isfinite(entry.middle_height):
        text += f", {entry.middle_height:g} m off it in the middle"
    return text


def _pose(pose: PlanarPose, motion: PlanarTask) -> str:
    return f"{motion.robot.bodies[pose.body].name} held at {100 * pose.fraction:g} %"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.3f}" for value in values)
