"""Footholds from above: those of the plan that a run began with, and those that were made."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import Interval, contact_intervals
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Recording
from mcplan.view.colours import COM, PLANNED, PUSH, TEXT, end_effector_colours, plain
from mcplan.view.run_samples import frames_of, push_text, pushes_of
from mcplan.view.sheets import label, legend, sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Robot

Array = NDArray[np.float64]

#: [1/s] frames at which contacts are looked at.
FRAME_RATE = 50.0
#: Length of the arrow of a push [m], and radius of a foot that is a point [m].
PUSH_M, POINT_M = 0.25, 0.02


def plot_run_footholds(recording: Recording) -> Figure:
    """Contacts and path of the CoM from above: dashed as first planned, filled as made; arrows are pushes."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch, Polygon

    robot, until_s = recording.simulated_robot, float(recording.times_s[-1])
    made = frames_of(recording, load_model(robot), FRAME_RATE).samples.intervals
    planned = contact_intervals(recording.plan, recording.plan.scene, recording.plan.robot)
    colours = [plain(colour) for colour in end_effector_colours(robot)]
    corners = [_outline(robot, i) for i in (*planned, *made)]
    seen = np.vstack([*(outline for outline in corners), recording.com_W[:, :2]])
    pushes = pushes_of(recording)
    tails = [_tail(recording, *push) for push in pushes]
    seen = np.vstack([seen, *tails])
    low, high = seen.min(axis=0) - 0.08, seen.max(axis=0) + 0.08
    width = 11.0
    height = float(np.clip(width * (high[1] - low[1]) / max(high[0] - low[0], 1e-6) + 1.3, 2.6, 9.0))
    figure, axes = sheet(1, size=(width, height))
    chart = axes[0, 0]
    for number, interval in enumerate(planned):
        reached = interval.start_s <= until_s
        style: dict[str, Any] = {"linewidth": 1.3, "linestyle": (0, (3, 2)), "alpha": 1.0 if reached else 0.5}
        chart.add_patch(Polygon(corners[number], fill=False, edgecolor=PLANNED, **style))
    for number, interval in enumerate(made):
        colour = colours[interval.end_effector]
        chart.add_patch(
            Polygon(corners[len(planned) + number], facecolor=colour, edgecolor=colour, alpha=0.45, linewidth=1.2)
        )
        text = _made_at(recording, interval.start_s)
        chart.annotate(text, interval.position_W[:2], color=TEXT, fontsize=7, ha="center", va="center")
    times = np.linspace(0.0, recording.plan.duration(), 300)
    first = recording.plan.sample(times).com_W  # type: ignore[attr-defined]
    chart.plot(first[:, 0], first[:, 1], color=PLANNED, linewidth=1.2, linestyle=(0, (3, 2)))
    chart.plot(recording.com_W[:, 0], recording.com_W[:, 1], color=plain(COM), linewidth=1.6)
    handles: list[Any] = [
        Patch(color=c, alpha=0.45, label=e.name.replace("_", " ")) for c, e in _used(robot, made, colours)
    ]
    handles.append(Line2D([], [], color=plain(COM), linewidth=1.6, label="CoM"))
    handles.append(Line2D([], [], color=PLANNED, linestyle=(0, (3, 2)), label="as first planned"))
    for (start, stop), tail in zip(pushes, tails, strict=True):
        chart.annotate(
            "", recording.com_W[start, :2], tail, arrowprops={"arrowstyle": "-|>", "color": PUSH, "linewidth": 2.2}
        )
        lasts = recording.times_s[min(stop, len(recording.times_s) - 1)] - recording.times_s[start]
        text = f"{push_text(recording, start, stop)} for {lasts:.2g} s at {recording.times_s[start]:.4g} s"
        handles.append(Line2D([], [], color=PUSH, linewidth=2.2, label=text))
    chart.set_xlim(low[0], high[0])
    chart.set_ylim(low[1], high[1])
    chart.set_aspect("equal")
    label(chart, x="x [m]", y="y [m]", title="Footholds, with the time at which each was made [s]")
    legend(figure, handles=handles, loc="outside lower center", ncol=min(len(handles), 5))
    return figure


def _made_at(recording: Recording, start_s: float) -> str:
    """Time of a contact; of one that was there when what was kept of a run begins, only that it is older."""
    begins_s = float(recording.times_s[0])
    return f"< {begins_s:.1f}" if 0.0 < begins_s and start_s <= begins_s else f"{start_s:.1f}"


def _tail(recording: Recording, start: int, stop: int) -> Array:
    """Where the arrow of a push begins that ends at the CoM [m]."""
    force = recording.pushes_W[(start + stop) // 2, :2]
    return np.asarray(recording.com_W[start, :2] - PUSH_M * force / np.linalg.norm(force))


def _outline(robot: Robot, interval: Interval) -> Array:
    """(m, 2) outline of an end-effector in contact, from above [m]."""
    length, width = robot.end_effectors[interval.end_effector].half_size
    if length <= 0.0 or width <= 0.0:
        angles = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False)
        return np.asarray(interval.position_W[:2] + POINT_M * np.column_stack([np.cos(angles), np.sin(angles)]))
    corners = np.array([[length, width, 0.0], [-length, width, 0.0], [-length, -width, 0.0], [length, -width, 0.0]])
    return np.asarray((interval.position_W + corners @ interval.rotation_W.T)[:, :2])


def _used(robot: Robot, made: list[Interval], colours: list[str]) -> list[tuple[str, Any]]:
    ends = sorted({interval.end_effector for interval in made})
    return [(colours[end], robot.end_effectors[end]) for end in ends]
