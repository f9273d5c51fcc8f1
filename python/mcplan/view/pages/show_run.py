"""Pages of runs: what a robot did in simulation, beside what its plan asks for."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.kinematics.rotations import pose
from mcplan.kinematics.samples import Interval, contact_intervals
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Recording, TrackingResult
from mcplan.view.colours import ASSIST, COM, PLANNED, PUSH, TEXT, TOUCH, end_effector_colours
from mcplan.view.extent import extent_of, scale_of
from mcplan.view.plan_drawing import (
    WEIGHT_ARROW,
    ForceArrow,
    contact_plate,
    draw_arrow,
    draw_contact,
    draw_figure,
    draw_forces,
)
from mcplan.view.robot_urdf import mesh_figure
from mcplan.view.run_samples import RunFrames, frames_of, push_text, pushes_of, stretches_of
from mcplan.view.runs import Run, from_zero, ground_shift_of, recording_of, was_replanned
from mcplan.view.scene_drawing import draw_surfaces, raised, surface_drawings
from mcplan.view.shapes import ellipsoid, tube
from mcplan.view.stage import Stage, node
from mcplan.view.viewpoint import camera_direction, sun_direction, view_points

from .overlay import Bars, caption, entry, plan_legend, timeline
from .page import Page
from .run_text import run_lines
from .show import annotated

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]

#: [1/s] frames of the animation; the browser blends between them.
FRAME_RATE = 30.0


def show_run(run: Run) -> Page:
    """Draw a run for the browser: the robot's meshes as simulated, the simulator's contacts and forces, and what was
    planned.

    Paths as simulated lie inside of paler, wider tubes: the planned ones. Planned footholds are grey; contacts light up
    in the end-effector's colour where and while the simulator has them. Below the timeline's bars are thin lines: the
    planned contacts.

    Args:
        run: A recording; or the result of tracking, whose measures the caption names.

    Raises:
        MissingExtra: meshcat or Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    recorded, shift = recording_of(run), ground_shift_of(run)
    recording = from_zero(recorded)
    require("mcplan.view.show_run", "view", "meshcat", "pinocchio")
    measures = run.measures if isinstance(run, TrackingResult) else None
    plan = recording.plan
    scene, robot = recording.scene, recording.simulated_robot
    replanned = was_replanned(run)
    colours = end_effector_colours(robot)
    urdf_model = load_model(robot)
    frames = frames_of(recording, urdf_model, FRAME_RATE)
    samples = frames.samples
    extent = extent_of(scene, robot, samples, length=0.6, width=0.6)
    drawings = [raised(drawing, shift) for drawing in surface_drawings(scene, extent)]
    stage = Stage(scale_of(robot))
    draw_surfaces(stage, drawings)
    draw_figure(stage, samples, mesh_figure(urdf_model, frames.configurations, colours))
    _draw_com(stage, recording, frames, robot)
    _draw_ends(stage, recording, frames, robot, colours, shift)
    draw_forces(stage, samples, scene, robot, on_top=True)
    per_metre = float(robot.mass) * float(scene.gravity) / (WEIGHT_ARROW * float(robot.com_height))
    legend = plan_legend(scene, robot, colours, per_metre)
    text = "as planned: paths; as first planned: footholds" if replanned else "as planned: paths, footholds"
    legend[1:1] = [entry("planned", "line", PLANNED, text)]
    legend += _draw_helpers(stage, frames, robot)
    duration = float(samples.times_s[-1])
    expected = _followed_contacts(recording) if replanned else contact_intervals(plan, plan.scene, robot)
    knots_s = _contact_changes(recording) if replanned else plan.knot_times()
    within = [replace(i, end_s=min(i.end_s, duration)) for i in expected if i.start_s < duration]
    contacts = Bars(samples.intervals, within, _events(recording, recorded.fell_at_s))
    bars = timeline(recording.scene_by_plan, robot, contacts, colours, duration)
    direction = camera_direction(extent)
    points, labels = annotated(stage, drawings, view_points(drawings, samples, robot), direction)
    return Page(
        title=f"{scene.name}, {robot.name}, simulated",
        payload=stage.payload(),
        overlay=caption(f"{scene.name}, simulated", run_lines(recorded, measures), legend) + bars,
        points_W=points,
        direction_W=direction,
        sun_W=sun_direction(extent),
        duration_s=duration,
        knots_s=[t for t in knots_s if t < duration] + [duration],
        labels=labels,
    )


def _followed_contacts(recording: Recording) -> list[Interval]:
    """Contacts of the plans of a run with replanning, each as it was planned while it lasted."""
    found, times = [], recording.times_s
    for end in range(recording.contacts_plan.shape[1]):
        planned = recording.contacts_plan[:, end]
        for surface in np.unique(planned[planned >= 0]):
            for start, stop in stretches_of(planned == surface):
                until = float(times[min(stop, len(times) - 1)])
                place = recording.end_effectors_plan_W[start, end]
                found.append(Interval(end, int(surface), float(times[start]), until, place, np.eye(3)))
    return found


def _contact_changes(recording: Recording) -> list[float]:
    """The begin, and when contacts were to change by the plans that were followed."""
    changes = np.flatnonzero(np.any(np.diff(recording.contacts_plan, axis=0) != 0, axis=1)) + 1
    return [0.0, *(float(t) for t in recording.times_s[changes])]


def _draw_com(stage: Stage, recording: Recording, frames: RunFrames, robot: Robot) -> None:
    scale = float(robot.com_height) / 0.7
    samples = frames.samples
    stage.mesh("com/ball", ellipsoid((0.024 * scale,) * 3), COM, glow=0.3, on_top=True)
    stage.move("com/ball", samples.times_s, pose(np.eye(3), samples.com_W))
    stage.mesh("paths/com", tube(samples.com_W, 0.007 * scale), COM, glow=0.25)
    planned = recording.com_plan_W[:: max(1, len(recording.times_s) // samples.count)]
    stage.mesh("planned/com", tube(planned, 0.016 * scale), PLANNED, 0.4, glow=0.2)


def _draw_ends(
    stage: Stage, recording: Recording, frames: RunFrames, robot: Robot, colours: list[str], shift: float
) -> None:
    plan, samples = recording.plan, frames.samples
    scale = float(robot.com_height) / 0.7
    every = max(1, len(recording.times_s) // samples.count)
    for number, colour in enumerate(colours):
        if not (recording.contacts_plan[:, number] >= 0).any():
            continue  # hands without contact: their paths would only clutter
        name = robot.end_effectors[number].name
        stage.mesh(
            f"paths/{node(name)}", tube(samples.positions_W[:, number], 0.004 * scale, sides=6), colour, glow=0.25
        )
        wide = tube(recording.end_effectors_plan_W[::every, number], 0.009 * scale, sides=6)
        stage.mesh(f"planned/paths/{node(name)}", wide, PLANNED, 0.35, glow=0.2)
    for number, interval in enumerate(contact_intervals(plan, plan.scene, robot)):
        path = f"planned/footholds/{number}"
        stage.mesh(path, contact_plate(robot, interval.end_effector), PLANNED, 0.6)
        stage.place(path, pose(interval.rotation_W, interval.position_W + np.array([0.0, 0.0, shift])))
    for number, interval in enumerate(samples.intervals):
        draw_contact(stage, number, interval, samples, robot, colours[interval.end_effector])


def _draw_helpers(stage: Stage, frames: RunFrames, robot: Robot) -> list[str]:
    """Arrows of pushes and of the assistance, whose tips are at the base; their legend entries."""
    legend = []
    height = float(robot.com_height)
    for path, force_W, colour, text in (
        ("pushes", frames.pushes_W, PUSH, "push"),
        ("assist", frames.assist_W, ASSIST, "assistance"),
    ):
        size = np.linalg.norm(force_W, axis=1)
        largest = float(size.max(initial=0.0))
        if largest < 1e-6:
            continue
        # Far smaller than the weight: an arrow of the largest is as long as one of the weight.
        away = force_W * (WEIGHT_ARROW * height + 0.1 * height * (path == "pushes")) / largest
        at = frames.base_W - away if path == "pushes" else frames.base_W
        arrow = ForceArrow(frames.samples.times_s, at, force_W, largest, height, colour)
        draw_arrow(stage, path, arrow, on_top=True)
        legend.append(entry(path, "line", colour, f"{text} (up to {largest:.0f} N)"))
    return legend


def _events(recording: Recording, fell_at_s: float) -> list[tuple[float, float, str, str]]:
    """Pushes, contacts that nobody planned, and the fall, for the timeline; the fall with its time of the run."""
    times = recording.times_s
    events = []
    for start, stop in pushes_of(recording):
        until = float(times[min(stop, len(times) - 1)])
        events.append((float(times[start]), until, PUSH, push_text(recording, start, stop)))
    shortest = 0.003 * float(times[-1])  # to be seen
    for touch in recording.touches:
        until = min(max(touch.end_s, touch.start_s + shortest), float(times[-1]))
        events.append((touch.start_s, until, TOUCH, str(touch)))
    if recording.fell_at_s <= times[-1]:
        events.append((0.995 * float(times[-1]), float(times[-1]), TEXT, f"fell at {fell_at_s:.2f} s"))
    return events
