"""mcplan tasks"""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from mcplan._core import PlanarClearance, PlanarContact, PlanarPhase, PlanarPose, PlanarTask


def tasks(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="Planar task: built-in name or TOML file.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="TOML file for the task.")
    ] = None,
) -> None:
    """List, print or copy planar tasks: robot, ground and stances.

    Example: mcplan tasks stairs

    Example: mcplan tasks walking -o my.toml
    """
    from mcplan.cli.table import print_table
    from mcplan.errors import InvalidInput
    from mcplan.files.outputs import TOML, require_target
    from mcplan.files.planar_tasks import list_planar_tasks, load_planar_task, save_planar_task

    if name is None:
        if output is not None:
            raise InvalidInput("--output", "needs the NAME of a task")
        built_in = [load_planar_task(entry) for entry in list_planar_tasks()]
        print_table([task.name, task.robot.name, task.description] for task in built_in)
        return
    require_target("--output", output, TOML)
    task = load_planar_task(name)
    if output is None:
        _print_task(task)
    else:
        save_planar_task(task, output, f"Made by: mcplan tasks {name} -o {output}")
        say(f"Wrote {output}")


def _print_task(task: PlanarTask) -> None:
    from mcplan.cli.table import print_table

    say(f"{task.name}: {task.description}" if task.description else task.name)
    robot = task.robot
    say(f"robot {robot.name}, {robot.joint_count()} joints, {task.interval_count()} intervals")
    say()
    rows = [
        [
            surface.name,
            _numbers(surface.origin_W),
            f"{math.degrees(surface.angle):g}",
            f"{surface.from_:g} .. {surface.to:g}",
            f"{surface.friction:g}",
        ]
        for surface in task.surfaces
    ]
    print_table(rows, ["surface", "origin [m]", "angle [deg]", "extent [m]", "friction"])
    say()
    rows = [
        [
            str(k),
            str(phase.intervals),
            f"{phase.min_duration:g} .. {phase.max_duration:g}",
            ", ".join(_contact(contact, task) for contact in phase.contacts),
            ", ".join(_demands(phase, task)) or "-",
        ]
        for k, phase in enumerate(task.phases)
    ]
    print_table(rows, ["phase", "intervals", "duration [s]", "contacts", "besides"])
    if task.no_clearance:
        say()
        pairs = [
            (task.robot.end_effectors[p.end_effector].name, task.surfaces[p.surface].name) for p in task.no_clearance
        ]
        say("no clearance is asked for of " + ", ".join(f"{end} and {surface}" for end, surface in pairs))


def _contact(contact: PlanarContact, task: PlanarTask) -> str:
    who, surface = task.robot.end_effectors[contact.end_effector].name, task.surfaces[contact.surface].name
    return f"{who} on {surface} ({_numbers(contact.position_W)})"


def _demands(phase: PlanarPhase, task: PlanarTask) -> list[str]:
    return [_clearance(entry, phase, task) for entry in phase.clearances] + [_pose(pose, task) for pose in phase.poses]


def _clearance(entry: PlanarClearance, phase: PlanarPhase, task: PlanarTask) -> str:
    who, surface = task.robot.end_effectors[entry.end_effector].name, task.surfaces[entry.surface].name
    end = phase.intervals if entry.end_interval < 0 else entry.end_interval
    text = f"{who} clear of {surface}"
    if (entry.first_interval, end) != (0, phase.intervals):
        text += f" in intervals {entry.first_interval} to {end - 1}"
    if math.isfinite(entry.middle_height):
        text += f", {entry.middle_height:g} m off it in the middle"
    return text


def _pose(pose: PlanarPose, task: PlanarTask) -> str:
    return f"{task.robot.bodies[pose.body].name} fixed at {100 * pose.fraction:g} %"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.3f}" for value in values)
