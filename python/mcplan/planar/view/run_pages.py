"""Pages of runs of planar robots: what the robot did in simulation, beside its whole-body plan."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import Interval
from mcplan.view.colours import COM, PLANNED, TEXT
from mcplan.view.pages.overlay import Bars, caption, entry, timeline
from mcplan.view.pages.page import Page
from mcplan.view.plan_drawing import WEIGHT_ARROW
from mcplan.view.run_samples import joined_stretches
from mcplan.view.runs import ground_shift_of
from mcplan.view.shapes import tube
from mcplan.view.stage import Stage, node

from .drawing import (
    contact_intervals,
    draw_cones,
    draw_forces,
    draw_ground,
    draw_paths,
    draw_robot,
    into_space,
    lanes_of,
)
from .figure import end_colours, shapes_of, size_of
from .ground import slabs_of
from .pages import FRAME_RATE, common_legend, planar_page, reached_by, seen_on
from .plots_run import force_error, joint_error_deg, point_drift
from .run_samples import sample_planar_run
from .runs import PlanarRun, planar_recording_of
from .samples import PlanarSamples, frame_times, sample_whole_body

if TYPE_CHECKING:
    from mcplan._core import PlanarRobot
    from mcplan.planar.tracking import PlanarRecording

Array = NDArray[np.float64]


def show_planar_run(run: PlanarRun) -> Page:
    """Draw a run of a planar robot for the browser, from the side.

    Robot, CoM, paths and force arrows are the simulation's; grey, wider tubes are the planned paths. Bars of the timeline
    are the simulated contacts, thin lines below them the planned ones.

    Args:
        run: A recording, or the result of tracking.

    Raises:
        MissingExtra: meshcat is not installed.
    """
    recording, shift_m = planar_recording_of(run), ground_shift_of(run)
    plan = recording.plan
    task = plan.task
    robot = task.robot
    size = size_of(robot)
    stage = Stage(size)
    weight = float(robot.mass()) * float(robot.gravity)
    colours, shapes = end_colours(robot), shapes_of(robot)
    samples = sample_planar_run(recording, FRAME_RATE)
    planned = sample_whole_body(plan, frame_times(float(plan.duration()), FRAME_RATE))
    duration = float(samples.times_s[-1])
    reached = np.vstack([reached_by(samples, shapes), reached_by(planned, shapes)])
    slabs = slabs_of(task, reached, 0.12 * size, 0.09 * size)
    slabs = [replace(slab, outline_W=slab.outline_W + [0.0, shift_m]) for slab in slabs]
    expected = contact_intervals(plan)
    draw_ground(stage, slabs, size)
    draw_robot(stage, samples, robot, shapes, size)
    draw_paths(stage, samples, robot, colours, size)
    _draw_planned(stage, planned, robot, size)
    draw_cones(stage, plan, expected, colours, size)
    draw_forces(stage, samples, robot, weight, size)

    legend = [
        entry("com paths/com", "ball", COM, "centre of mass"),
        entry("planned", "line", PLANNED, "as planned: paths"),
    ]
    legend += common_legend(robot, colours, weight / (WEIGHT_ARROW * size))
    view = seen_on(stage, slabs, reached, size)
    within = [replace(i, end_s=min(i.end_s, duration)) for i in expected if i.start_s < duration]
    shown = Bars(_touching(recording), within, _marks(recording, duration))
    bars = timeline(task, robot, shown, colours, duration)
    overlay = caption(f"{task.name}, simulated", _lines(recording), legend) + bars
    return planar_page(f"{task.name}, {robot.name}, simulated", stage, overlay, view, plan, duration)


def _draw_planned(stage: Stage, planned: PlanarSamples, robot: PlanarRobot, size: float) -> None:
    stage.mesh("planned/com", tube(into_space(planned.com_W), 0.02 * size), PLANNED, 0.4, glow=0.2)
    for end, lane in enumerate(lanes_of(robot, size)):
        path = tube(into_space(planned.soles_W[:, end], lane), 0.011 * size, sides=6)
        stage.mesh(f"planned/paths/{node(robot.end_effectors[end].name)}", path, PLANNED, 0.35, glow=0.2)


def _marks(recording: PlanarRecording, duration_s: float) -> list[tuple[float, float, str, str]]:
    """For the timeline: where the robot left its plan."""
    left = float(recording.left_plan_at_s)
    return [(left, duration_s, TEXT, f"off its plan at {left:.2f} s")] if left <= duration_s else []


def _lines(recording: PlanarRecording) -> list[str]:
    plan = recording.plan
    end = f"{recording.times_s[-1]:.2f} s, all of the plan"
    if np.isfinite(recording.left_plan_at_s):
        end = f"off its plan at {recording.left_plan_at_s:.2f} s of {plan.duration():.2f} s"
    force, ratio = force_error(recording)
    drift = 1e3 * float(np.nanmax(point_drift(recording), initial=0.0))
    return [
        f"{plan.task.robot.name}: {end}",
        f"contact forces off by {force:.0f} N rms ({100.0 * ratio:.1f} %)",
        f"joints off by {np.sqrt(np.mean(joint_error_deg(recording) ** 2)):.2f}° rms",
        f"contact points off by {drift:.1f} mm at most",
    ]


def _touching(recording: PlanarRecording) -> list[Interval]:
    """Contacts as the simulator had them."""
    robot, times = recording.plan.task.robot, recording.times_s
    weight = float(robot.mass()) * float(robot.gravity)
    pressed = np.linalg.norm(np.nansum(recording.forces_W, axis=2), axis=2) > 0.005 * weight
    intervals = []
    for end in range(len(robot.end_effectors)):
        for start, stop in joined_stretches(pressed[:, end], times):
            planned = recording.surfaces_plan[start:stop, end]
            planned = planned[planned >= 0]
            surface = int(np.bincount(planned).argmax()) if len(planned) else 0
            until = float(times[min(stop, len(times) - 1)])
            intervals.append(Interval(end, surface, float(times[start]), until, np.zeros(3), np.eye(3)))
    return intervals
