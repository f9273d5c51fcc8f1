"""A plan on a page: paths, footholds, contacts that light up, force arrows, robot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import pose, with_axis_z
from mcplan.kinematics.samples import Interval, Samples

from .colours import COM, FORCE
from .extent import scale_of
from .figure import Figure
from .shapes import Mesh, circle, cone, disc, ellipsoid, loft, plate, tube
from .stage import node

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

    from .stage import Stage

Array = NDArray[np.float64]

#: Ratio of the length of a force arrow as large as the weight to the CoM height.
WEIGHT_ARROW = 0.55
#: [s] that a new contact takes to settle from its flash.
FLASH = 0.25


def draw_plan(stage: Stage, samples: Samples, scene: Scene, robot: Robot, figure: Figure, colours: list[str]) -> None:
    """Put a plan onto a page: nodes "robot", "com", "paths", "contacts" and "forces"."""
    scale = float(robot.com_height) / 0.7
    draw_figure(stage, samples, figure)
    ball = ellipsoid((0.028 * scale,) * 3)
    stage.mesh("com/ball", ball, COM, glow=0.3, on_top=True)
    stage.move("com/ball", samples.times_s, pose(np.eye(3), samples.com_W))
    stage.mesh("paths/com", tube(samples.com_W, 0.011 * scale), COM, glow=0.25)
    for end, colour in enumerate(colours):
        name = robot.end_effectors[end].name
        stage.mesh(f"paths/{node(name)}", tube(samples.positions_W[:, end], 0.005 * scale, sides=6), colour, glow=0.25)
    for number, interval in enumerate(samples.intervals):
        draw_footprint(stage, number, interval, robot, colours[interval.end_effector])
        draw_contact(stage, number, interval, samples, robot, colours[interval.end_effector])
    draw_forces(stage, samples, scene, robot)


def draw_forces(stage: Stage, samples: Samples, scene: Scene, robot: Robot, on_top: bool = False) -> None:
    """Put the contact forces onto a page, an arrow for each end-effector; `on_top`: legs do not hide them."""
    weight, height = float(robot.mass) * float(scene.gravity), float(robot.com_height)
    for number, end in enumerate(robot.end_effectors):
        at, force = samples.pressure_W[:, number], samples.forces_W[:, number]
        draw_arrow(stage, f"forces/{node(end.name)}", ForceArrow(samples.times_s, at, force, weight, height), on_top)


def draw_figure(stage: Stage, samples: Samples, figure: Figure) -> None:
    """Put a robot onto a page; parts that move together may have one node."""
    nodes: dict[str, int] = {}
    for number, part in enumerate(figure.parts):
        link, _, rest = part.name.partition("/")
        path = f"robot/{node(link)}"
        stage.mesh(f"{path}/{node(rest)}" if rest else path, part.mesh, part.colour)
        if link not in nodes:
            nodes[link] = number
            stage.move(path, samples.times_s, part.poses)


def contact_plate(robot: Robot, end: int, margin: float = 0.0) -> Mesh:
    """Patch [m] that marks a contact: the sole's rectangle, or a disc for a point; a margin around it is that of a
    robot of usual size."""
    half_size = np.asarray(robot.end_effectors[end].half_size, float)
    scale = float(robot.com_height) / 0.7
    margin, thickness = margin * scale_of(robot), 0.004 * scale_of(robot)
    if half_size.all():
        return plate((half_size[0] + margin, half_size[1] + margin), thickness)
    return disc(0.035 * scale + margin, thickness)


def draw_footprint(
    stage: Stage, number: int, interval: Interval, robot: Robot, colour: str, parent: str = "contacts"
) -> None:
    """Put a plate that stays where a contact is onto a page, below a node."""
    path = f"{parent}/{node(robot.end_effectors[interval.end_effector].name)}/{number}/print"
    stage.mesh(path, contact_plate(robot, interval.end_effector), colour, 0.45)
    stage.place(path, pose(interval.rotation_W, interval.position_W))


def draw_contact(stage: Stage, number: int, interval: Interval, samples: Samples, robot: Robot, colour: str) -> None:
    """Put a plate that lights up while a contact lasts onto a page."""
    end = interval.end_effector
    at = pose(interval.rotation_W, interval.position_W)
    path = f"contacts/{node(robot.end_effectors[end].name)}/{number}"
    stage.mesh(f"{path}/active", contact_plate(robot, end, margin=0.02), colour, 0.85, glow=0.6)
    stage.place(f"{path}/active", at)
    # Flash from one and a half times its size; the first contacts of a plan are there from the start.
    times = {0.0: 1.0, float(samples.times_s[-1]): 1.0}
    if interval.start_s > 0.0:
        for fraction in np.linspace(0.0, 1.0, 9):
            times[min(interval.start_s + FLASH * fraction, float(samples.times_s[-1]))] = (
                1.0 + 0.6 * (1.0 - fraction) ** 2
            )
    moments = np.array(sorted(times))
    scales = np.array([[times[t], times[t], 1.0] for t in moments])
    stage.move(f"{path}/active", moments, scales=scales)
    last = float(samples.times_s[-1])
    switches = np.unique([0.0, interval.start_s, min(interval.end_s, last), last])
    on = (switches >= interval.start_s) & ((switches < interval.end_s) | (interval.end_s >= last - 1e-9))
    stage.move(f"{path}/active", switches, visible=on)


@dataclass(frozen=True)
class ForceArrow:
    """A force over time.

    Attributes:
        times_s: (n,) [s].
        start_W: (n, 3) where it acts [m].
        force_W: (n, 3) [N].
        weight: Weight of the robot [N]; an arrow of this size is WEIGHT_ARROW times the height long.
        height: Height of the robot [m].
        colour: "#rrggbb".
    """

    times_s: Array
    start_W: Array
    force_W: Array
    weight: float
    height: float
    colour: str = FORCE


def draw_arrow(stage: Stage, path: str, arrow: ForceArrow, on_top: bool = False) -> None:
    """Put a force arrow onto a page, unless it is never seen.

    Args:
        stage: The page's.
        path: Node; "shaft" and "head" hang below it.
        arrow: The force.
        on_top: Seen through whatever lies in front.
    """
    times_s, start_W, force_W = arrow.times_s, arrow.start_W, arrow.force_W
    weight, height, colour = arrow.weight, arrow.height, arrow.colour
    size = np.linalg.norm(force_W, axis=1)
    if size.max() < 1e-3 * weight:
        return
    length = WEIGHT_ARROW * height * size / weight
    head = 0.085 * height
    frames = []
    frame = np.eye(3)
    for f, s in zip(force_W, size, strict=True):
        if s > 1e-3 * weight:
            frame = with_axis_z(f, frame[:, 0])
        frames.append(frame)
    rotation = np.array(frames)
    shrink = np.clip(length / (2.0 * head), 1e-3, 1.0)
    shaft = np.maximum(length - head * shrink, 1e-4 * height)
    seen = length > 0.02 * height
    ring = 0.011 * height * circle(10)
    bar = loft(np.array([np.column_stack([ring, np.full(10, z)]) for z in (0.0, 1.0)]))
    stage.mesh(f"{path}/shaft", bar, colour, glow=0.15, on_top=on_top)
    stage.move(f"{path}/shaft", times_s, pose(rotation, start_W), np.column_stack([shrink, shrink, shaft]), seen)
    stage.mesh(f"{path}/head", cone(0.032 * height, head), colour, glow=0.15, on_top=on_top)
    tip = start_W + rotation[:, :, 2] * shaft[:, None]
    stage.move(f"{path}/head", times_s, pose(rotation, tip), shrink[:, None].repeat(3, axis=1), seen)


def draw_standing(stage: Stage, name: str, samples: Samples, figure: Figure, opacity: float) -> None:
    """Put a robot that does not move onto a page, under "stances"."""
    for part in figure.parts:
        path = f"stances/{name}/{node(part.name)}"
        stage.mesh(path, part.mesh, part.colour, opacity)
        stage.place(path, part.poses[0])
