"""Pages of motions: the robot with its joints, its contact forces, and what its joints are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.extras import require
from mcplan.kinematics.rotations import pose
from mcplan.view.colours import COM, PLANNED, PUSH, TEXT, end_effector_colours
from mcplan.view.extent import extent_of, scale_of
from mcplan.view.motion_samples import motion_frames
from mcplan.view.plan_drawing import WEIGHT_ARROW, draw_contact, draw_figure, draw_footprint, draw_forces
from mcplan.view.robot_urdf import mesh_figure
from mcplan.view.scene_drawing import draw_surfaces, surface_drawings
from mcplan.view.shapes import ellipsoid, tube
from mcplan.view.stage import Stage, node
from mcplan.view.viewpoint import camera_direction, sun_direction, view_points
from mcplan.wb.certificate import MotionTolerances
from mcplan.wb.certificate.curves import MotionCurves, curves_of

from .joint_maps import JointMap, Line, joint_panel
from .overlay import Bars, caption, entry, plan_legend, timeline
from .page import Page
from .show import annotated

if TYPE_CHECKING:
    from mcplan._core import Robot
    from mcplan.kinematics.samples import Samples
    from mcplan.wb import Motion, MotionCheckResult

#: [1/s] frames of the animation; the browser blends between them.
FRAME_RATE = 30.0
#: Ends of the axes of distances [m].
NEAR_M, HIGH_M = 0.05, 0.15


def show_motion(motion: Motion, check: MotionCheckResult | None = None) -> Page:
    """Draw a motion for the browser: the robot's meshes, contact forces at their centres of pressure, paths of CoM and
    end-effectors beside the plan's CoM; maps of torque and speed of all joints over time, and distances.

    Args:
        motion: The motion.
        check: What the certificate says of it, for the caption; None: without.

    Raises:
        MissingExtra: meshcat or Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    require("mcplan.view.show_motion", "view", "meshcat", "pinocchio")
    plan = motion.plan
    scene, robot = plan.scene, plan.robot
    colours = end_effector_colours(robot)
    samples, configurations = motion_frames(motion, FRAME_RATE)
    curves = curves_of(motion)
    extent = extent_of(scene, robot, samples, length=0.6, width=0.6)
    drawings = surface_drawings(scene, extent)
    stage = Stage(scale_of(robot))
    draw_surfaces(stage, drawings)
    draw_figure(stage, samples, mesh_figure(motion.model.complete, configurations, colours))
    _draw_paths(stage, motion, samples, robot, colours)
    draw_forces(stage, samples, scene, robot, on_top=True)
    per_metre = float(robot.mass) * float(scene.gravity) / (WEIGHT_ARROW * float(robot.com_height))
    legend = plan_legend(scene, robot, colours, per_metre)
    legend[1:1] = [entry("planned", "line", PLANNED, "centre of mass as planned")]
    duration = float(samples.times_s[-1])
    marks = [(start, end, TEXT, f"flight of {end - start:.2f} s") for start, end in curves.flights]
    marks += _violations(check, duration)
    direction = camera_direction(extent)
    points, labels = annotated(stage, drawings, view_points(drawings, samples, robot), direction)
    overlay = caption(f"{scene.name}, motion", motion_lines(motion, curves, check), legend)
    overlay += timeline(scene, robot, Bars(samples.intervals, (), marks), colours, duration)
    return Page(
        title=f"{scene.name}, {robot.name}, motion",
        payload=stage.payload(),
        overlay=overlay + _panel(motion, curves, colours),
        points_W=points,
        direction_W=direction,
        sun_W=sun_direction(extent),
        duration_s=duration,
        knots_s=plan.knot_times(),
        labels=labels,
    )


def motion_lines(motion: Motion, curves: MotionCurves, check: MotionCheckResult | None) -> list[str]:
    """A motion in words, in a few lines."""
    off_mm = 1e3 * curves.com_off_m
    torque, speed = (100.0 * uses.max(initial=0.0) for uses in (curves.torque_use, curves.speed_use))
    lines = [
        f"{motion.plan.robot.name}: {motion.duration():.2f} s, {len(motion.joints)} joints",
        f"CoM off the plan by {np.sqrt(np.mean(off_mm**2)):.1f} mm rms, {off_mm.max():.1f} mm at most",
        f"torques up to {torque:.0f} %, speeds up to {speed:.0f} % of limits",
    ]
    if check is not None:
        found = check.violations()
        lines.append("certified at 1 kHz" if not found else f"not certified: {found[0]}")
    return lines


def _draw_paths(stage: Stage, motion: Motion, samples: Samples, robot: Robot, colours: list[str]) -> None:
    scale = float(robot.com_height) / 0.7
    stage.mesh("com/ball", ellipsoid((0.024 * scale,) * 3), COM, glow=0.3, on_top=True)
    stage.move("com/ball", samples.times_s, pose(np.eye(3), samples.com_W))
    stage.mesh("paths/com", tube(samples.com_W, 0.007 * scale), COM, glow=0.25)
    planned = np.asarray(motion.plan.sample(samples.times_s).com_W)
    stage.mesh("planned/com", tube(planned, 0.016 * scale), PLANNED, 0.4, glow=0.2)
    for number, colour in enumerate(colours):
        if (motion.contacts[:, number] >= 0).any():
            name = robot.end_effectors[number].name
            path = tube(samples.positions_W[:, number], 0.004 * scale, sides=6)
            stage.mesh(f"paths/{node(name)}", path, colour, glow=0.25)
    for number, interval in enumerate(samples.intervals):
        draw_footprint(stage, number, interval, robot, colours[interval.end_effector])
        draw_contact(stage, number, interval, samples, robot, colours[interval.end_effector])


def _violations(check: MotionCheckResult | None, duration: float) -> list[tuple[float, float, str, str]]:
    """Places where the certificate fails, wide enough to be seen."""
    wide = 0.004 * duration
    return [(v.time_s, v.time_s + wide, PUSH, str(v)) for v in (check.violations() if check is not None else [])]


def _panel(motion: Motion, curves: MotionCurves, colours: list[str]) -> str:
    limits, lines = MotionTolerances(), []
    if np.isfinite(curves.distance_m).any():
        nearest = int(np.argmin(curves.distance_m))
        least = f"{1e3 * curves.distance_m[nearest]:.1f} mm, {curves.links[nearest]}"
        title = f"nearest links, up to {100.0 * NEAR_M:.0f} cm: {least}"
        near = np.minimum(curves.distance_m, NEAR_M)
        lines.append(Line(title, curves.distance_times_s, near, NEAR_M, limits.self_distance_m, TEXT))
    for e, end in enumerate(motion.plan.robot.end_effectors):
        heights = curves.height_m[:, e]
        if end.kind == "foot" and np.isfinite(heights).any():
            title = f"{end.name.replace('_', ' ')} over the terrain, up to {100.0 * HIGH_M:.0f} cm"
            lines.append(
                Line(title, curves.times_s, np.minimum(heights, HIGH_M), HIGH_M, limits.mid_swing_m, colours[e])
            )
    maps = [
        JointMap(f"torque, up to {100.0 * curves.torque_use.max(initial=0.0):.0f} %", curves.torque_use),
        JointMap(f"speed, up to {100.0 * curves.speed_use.max(initial=0.0):.0f} %", curves.speed_use),
    ]
    return joint_panel(curves.joints, maps, lines, motion.duration())
