"""Planar robots in mcplan robots."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from mcplan._core import PlanarBody, PlanarRobot
    from mcplan.files.planar_urdf import PlanarEnd


def is_planar(source: str) -> bool:
    """Whether a name or file is a planar robot's: files of those have bodies.

    Raises:
        UnknownRobot: Neither a name of the two kinds nor a file.
    """
    from mcplan.errors import InvalidRobot, UnknownRobot
    from mcplan.files.builtin import exists
    from mcplan.files.planar_robots import list_planar_robots
    from mcplan.files.robots import list_robots
    from mcplan.files.toml import read_toml

    spatial, planar = list_robots(), list_planar_robots()
    if source in spatial or source in planar:
        return source in planar
    if not exists(source):
        raise UnknownRobot(source, [*spatial, *planar])
    return "bodies" in read_toml(Path(source), InvalidRobot)


def print_planar_robot(robot: PlanarRobot) -> None:
    """Its bodies with their joints, and its end-effectors."""
    from mcplan.cli.table import print_table

    say(f"{robot.name} (planar): {robot.description}" if robot.description else f"{robot.name} (planar)")
    say(f"mass {robot.mass():g} kg, {robot.joint_count()} joints, gravity {robot.gravity:g} m/s^2")
    say()
    rows = [
        [
            body.name,
            robot.bodies[body.parent].name if body.parent >= 0 else "-",
            f"{body.mass:g}",
            _numbers(body.com_B),
            f"{body.inertia:.4g}",
            *_joint(body),
        ]
        for body in robot.bodies
    ]
    head = [
        "body",
        "parent",
        "mass [kg]",
        "CoM [m]",
        "inertia [kg m^2]",
        "joint [m]",
        "range [rad]",
        "[rad/s]",
        "[N m]",
    ]
    print_table(rows, head)
    say()
    rows = [
        [
            end.name,
            robot.bodies[end.body].name,
            _numbers(end.position_B),
            f"{math.degrees(end.angle_B):g}",
            _numbers(end.points),
        ]
        for end in robot.end_effectors
    ]
    print_table(rows, ["end-effector", "body", "position [m]", "angle [deg]", "points [m]"])
    if robot.collision_pairs:
        say()
        say(f"{len(robot.collision_pairs)} collision pairs")


def planar_robot_from_urdf(source: str, ends: list[str], output: Path | None) -> None:
    """Print or write the planar robot of a URDF."""
    from mcplan.files.outputs import TOML, require_target
    from mcplan.files.planar_robots import planar_robot_to_dict, save_planar_robot
    from mcplan.files.planar_urdf import planar_robot_from_urdf as read
    from mcplan.files.toml import toml_text

    require_target("--output", output, TOML)
    robot = read(source, [_parse_end(text) for text in ends])
    words = ["mcplan robots --planar --from-urdf", source, *(f"--end {text}" for text in ends)]
    comment = "Made by: " + " ".join([*words, *([f"-o {output}"] if output else [])])
    if output is None:
        print(toml_text(planar_robot_to_dict(robot), comment), end="")
    else:
        save_planar_robot(robot, output, comment)
        say(f"Wrote {output}")


def _parse_end(text: str) -> PlanarEnd:
    from mcplan.errors import InvalidInput, shown
    from mcplan.files.planar_urdf import PlanarEnd

    try:
        name, rest = text.split("=", 1)
        frame, _, points = rest.partition(":")
        return PlanarEnd(name, frame, tuple(float(point) for point in points.split(",")) if points else (0.0,))
    except ValueError:
        raise InvalidInput("--end", "must read NAME=FRAME[:POINT,...] with --planar", shown(text)) from None


def _joint(body: PlanarBody) -> list[str]:
    if body.parent < 0:
        return ["-"] * 4
    return [
        _numbers(body.joint_P),
        f"{body.position_min:g} .. {body.position_max:g}",
        f"{body.velocity_max:g}",
        f"{body.torque_max:g}",
    ]


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.3f}" for value in values)
