"""Pages of whole-body plans of planar robots."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import COM
from mcplan.view.pages.overlay import Bars, caption, entry, force_text, timeline
from mcplan.view.pages.page import Page
from mcplan.view.plan_drawing import WEIGHT_ARROW
from mcplan.view.stage import Stage, node

from .annotations import PLANAR_AXES, annotated_planar, corners_of, planar_legend
from .drawing import (
    contact_intervals,
    draw_cones,
    draw_forces,
    draw_ground,
    draw_paths,
    draw_robot,
    ground_solid,
    into_space,
    side_direction,
)
from .figure import Shape, end_colours, shapes_of, size_of
from .ground import Slab, slabs_of
from .samples import PlanarSamples, frame_times, rotated, sample_whole_body

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan, PlanarRobot, Report
    from mcplan.view.pages.annotations import Label

Array = NDArray[np.float64]

#: [1/s] frames of the animation: whole-body motions are faster than walks.
FRAME_RATE = 60.0


def show_whole_body(plan: PlanarPlan, report: Report | None = None) -> Page:
    """Draw a whole-body plan for the browser, from the side: robot, ground, CoM, forces at their points, their cones.

    Args:
        plan: The plan.
        report: Named in the caption.

    Raises:
        MissingExtra: meshcat is not installed.
        InvalidPlan: The plan's arrays do not fit together.
    """
    plan.validate()
    task = plan.task
    robot = task.robot
    size = size_of(robot)
    stage = Stage(size)
    weight = float(robot.mass()) * float(robot.gravity)
    colours = end_colours(robot)
    shapes = shapes_of(robot)
    duration = float(plan.duration())
    samples = sample_whole_body(plan, frame_times(duration, FRAME_RATE))
    reached = reached_by(samples, shapes)
    slabs = slabs_of(task, reached, 0.12 * size, 0.09 * size)
    intervals = contact_intervals(plan)
    draw_ground(stage, slabs, size)
    draw_robot(stage, samples, robot, shapes, size)
    draw_paths(stage, samples, robot, colours, size)
    draw_cones(stage, plan, intervals, colours, size)
    draw_forces(stage, samples, robot, weight, size)

    phases = len(task.phases)
    lines = [f"{robot.name}: {phases} phase{'' if phases == 1 else 's'}, {duration:.2f} s"]
    if report is not None:
        lines.append(f"{report.status}: {report.iterations} iterations, {report.time_s:.2f} s of planning")
        lines.append(f"cost {report.cost:.4g}")
    legend = [entry("com paths/com", "ball", COM, "centre of mass")]
    legend += common_legend(robot, colours, weight / (WEIGHT_ARROW * size))
    view = seen_on(stage, slabs, reached, size)
    overlay = caption(task.name, lines, legend) + timeline(task, robot, Bars(intervals), colours, duration)
    return planar_page(f"{task.name}, {robot.name}", stage, overlay, view, plan, duration)


def reached_by(samples: PlanarSamples, shapes: list[Shape]) -> Array:
    """(n, 2) [m] corners of boxes around all that a robot's limbs cover at the samples."""
    return np.vstack(
        [
            samples.positions_W[:, s.body] + rotated(samples.angles[:, s.body], disc[:2]) + edge
            for s in shapes
            for disc in s.discs
            for edge in disc[2] * np.array([[-1.0, -1.0], [1.0, 1.0]])
        ]
    )


def common_legend(robot: PlanarRobot, colours: list[str], newton_per_metre: float) -> list[str]:
    """Entries of paths, forces, cones, robot and space."""
    legend = [
        entry(f"paths/{node(end.name)}", "line", colour, end.name.replace("_", " "))
        for end, colour in zip(robot.end_effectors, colours, strict=True)
    ]
    legend.append(entry("forces", "arrow", "", force_text("contact forces", newton_per_metre)))
    legend.append(entry("cones", "", "#c3cad2", "friction cones"))
    legend.append(entry("robot", "", "#98a2ae", "robot"))
    return legend + planar_legend()


def seen_on(stage: Stage, slabs: list[Slab], reached: Array, size: float) -> tuple[Array, list[Label]]:
    """Put axes and a scale bar onto a page; the points (n, 3) [m] to be seen with them, and all labels."""
    ground = [ground_solid(slab, size).vertices for slab in slabs if len(slab.outline_W)]
    return annotated_planar(stage, slabs, np.vstack([*ground, into_space(corners_of(reached))]), size)


def planar_page(
    title: str, stage: Stage, overlay: str, view: tuple[Array, list[Label]], plan: PlanarPlan, duration_s: float
) -> Page:
    """The page of a stage that is looked at from the side."""
    points, labels = view
    return Page(
        title=title,
        payload=stage.payload(),
        overlay=overlay,
        points_W=points,
        direction_W=side_direction(),
        sun_W=np.array([0.5, -0.8, 1.5]),
        duration_s=duration_s,
        knots_s=[t for t in plan.knot_times() if t < duration_s] + [duration_s],
        labels=labels,
        axes=PLANAR_AXES,
        rate_hz=FRAME_RATE,
    )
