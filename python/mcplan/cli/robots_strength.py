"""mcplan robots --strength: what arms can push"""

from __future__ import annotations

from typing import TYPE_CHECKING

from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from mcplan._core import Robot
    from mcplan.tracking.arm_strength import Strength

SAMPLES = 2000
#: [m/s^2], for the weight that forces are compared with.
GRAVITY = 9.81


def strengths(robot: Robot, seed: int) -> list[tuple[Strength, float]]:
    """The strength of every hand in six directions, each with half the robot's weight [N].

    Raises:
        InvalidRobot: It has no hands, or no URDF that can be read.
        MissingExtra: Pinocchio is not installed.
    """
    from mcplan.errors import InvalidRobot
    from mcplan.kinematics.urdf_model import load_model
    from mcplan.tracking.arm_strength import random_strengths

    urdf_model = load_model(robot)
    hands = [i for i, end in enumerate(robot.end_effectors) if end.kind == "hand"]
    if not hands:
        raise InvalidRobot("end_effectors", "must have one of kind 'hand' for --strength", source=robot.name)
    half = 0.5 * GRAVITY * sum(inertia.mass for inertia in urdf_model.model.inertias)
    return [(strength, half) for end in hands for strength in random_strengths(urdf_model, end, SAMPLES, seed)]


def print_strengths(found: list[tuple[Strength, float]]) -> None:
    """Median and 90th percentile, and their ratios to half the weight."""
    from mcplan.cli.table import print_table

    rows = []
    for strength, half in found:
        median, high = strength.quantile_N(0.5), strength.quantile_N(0.9)
        parts = [f"{median / half:.2f}", f"{high / half:.2f}"]
        rows.append([strength.end_effector, strength.direction, f"{median:.0f}", f"{high:.0f}", *parts])
    half = found[0][1]
    say()
    say(
        f"Push of a hand that the arm's torque limits allow, {SAMPLES} random postures; half the weight is {half:.0f} N"
    )
    parts = ["median / half weight", "90th / half weight"]
    print_table(rows, ["hand", "direction", "median [N]", "90th percentile [N]", *parts])
