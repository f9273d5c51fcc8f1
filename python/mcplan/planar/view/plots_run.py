"""Plots of runs of planar robots: contact forces and joints beside the plan's, feedback beside feed-forward."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.tracking.measures import rms
from mcplan.view.colours import BODY, PLANNED, TEXT, mix
from mcplan.view.sheets import QUIET, label, legend, save_figures, sheet

from .figure import end_colours, limbs_of
from .plots import LIMIT, PHASE, shade_phases
from .run_samples import axes_of
from .runs import PlanarRun, planar_recording_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan.planar.tracking import PlanarRecording

Array = NDArray[np.float64]


def save_planar_run_plots(run: PlanarRun, folder: str | Path) -> list[Path]:
    """Write the plots of a run of a planar robot: forces.png, joints.png, torques.png and drift.png.

    Args:
        run: A recording, or the result of tracking.
        folder: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        OSError: The folder cannot be written to.
    """
    recording = planar_recording_of(run)
    figures = {
        "forces": plot_planar_run_forces(recording),
        "joints": plot_planar_run_joints(recording),
        "torques": plot_planar_run_torques(recording),
        "drift": plot_planar_run_drift(recording),
    }
    return save_figures(figures, folder)


def plot_planar_run_forces(recording: PlanarRecording) -> Figure:
    """Normal and tangential contact force of every end-effector, the sum over its points: planned and simulated."""
    robot = recording.plan.task.robot
    colours = end_colours(robot)
    used = [e for e in range(len(robot.end_effectors)) if _sums(recording)[1][:, e].any()]
    rows = max(len(used), 1)
    figure, axes = sheet(rows, 2, size=(12.0, 1.2 + 1.8 * rows), sharex=True, sharey="col")
    normals, tangents = axes_of(recording, np.arange(len(recording.times_s)))
    simulated, planned = _sums(recording)
    peaks: list[list[float]] = [[], []]
    for row, end in enumerate(used):
        error = np.linalg.norm(simulated[:, end] - planned[:, end], axis=1)[recording.within_plan]
        scale = np.linalg.norm(planned[:, end], axis=1)[recording.within_plan]
        off, ratio = rms(error), rms(error) / max(rms(scale), 1e-9)
        for column, (direction, name) in enumerate(((normals, "normal"), (tangents, "tangential"))):
            chart = axes[row, column]
            shade_phases(chart, recording.plan)
            expected = np.sum(planned[:, end] * direction[:, end], axis=1)
            found = np.sum(simulated[:, end] * direction[:, end], axis=1)
            chart.plot(recording.times_s, expected, color=PLANNED, linewidth=3.2, alpha=0.75, label="planned")
            chart.plot(recording.times_s, found, color=colours[end], linewidth=1.2, label="simulated")
            peaks[column] += [*np.percentile(found, [0.3, 99.7]), expected.min(), expected.max()]
            label(chart, y="[N]")
            title = f"{recording.end_effectors[end].replace('_', ' ')}, {name}"
            label(chart, title=title + (f": off by {off:.1f} N rms ({100.0 * ratio:.1f} %)" if not column else ""))
    for column in range(2):
        if peaks[column]:  # impacts may leave the picture, so that the rest can be read
            low, high = min(peaks[column]), max(peaks[column])
            axes[0, column].set_ylim(low - 0.08 * (high - low), high + 0.1 * (high - low))
    _finish(figure, axes, recording)
    return figure


def plot_planar_run_joints(recording: PlanarRecording) -> Figure:
    """How far base and joints are off the plan."""
    figure, axes = sheet(3, 1, size=(12.0, 6.6), sharex=True)
    position, angle, joints = axes[:, 0]
    off = recording.base - recording.base_plan
    for chart in axes[:, 0]:
        shade_phases(chart, recording.plan)
        chart.axhline(0.0, color=QUIET, linewidth=0.7)
    position.plot(recording.times_s, 1e3 * off[:, 0], color="#0072B2", linewidth=1.5, label="x")
    position.plot(recording.times_s, 1e3 * off[:, 1], color="#D55E00", linewidth=1.5, label="y")
    inside = recording.within_plan
    largest = 1e3 * float(np.linalg.norm(off[inside, :2], axis=1).max())
    label(position, y="[mm]", title=f"base off the plan: {largest:.1f} mm at most")
    legend(position, loc="upper left", ncol=2)
    angle.plot(recording.times_s, np.degrees(off[:, 2]), color=TEXT, linewidth=1.5)
    label(angle, y="[degree]", title="angle of the base off the plan")
    errors = joint_error_deg(recording)
    colour_of = _joint_colours(recording)
    for joint, name in enumerate(recording.joints):
        style = "-" if joint % 2 == 0 else (0, (5, 2))
        text = name.replace("_", " ")
        joints.plot(
            recording.times_s, errors[:, joint], color=colour_of[joint], linewidth=1.3, linestyle=style, label=text
        )
    worst = int(np.argmax(np.abs(errors[inside]).max(axis=0)))
    largest = float(np.abs(errors[inside, worst]).max())
    worst_name = recording.joints[worst].replace("_", " ")
    title = f"joints off the plan: {rms(errors[inside]):.2f} degrees rms, {largest:.2f} at most ({worst_name})"
    label(joints, y="[degree]", title=title)
    label(joints, x="time [s]")
    joints.set_xlim(0.0, recording.times_s[-1])
    handles, names = joints.get_legend_handles_labels()
    legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=min(len(names), 7))
    return figure


def plot_planar_run_torques(recording: PlanarRecording) -> Figure:
    """Feed-forward and feedback of every joint; titles say how large the feedback is beside it."""
    columns = 3
    count = len(recording.joints)
    rows = max(-(-count // columns), 1)
    figure, axes = sheet(rows, columns, size=(12.0, 0.9 + 1.75 * rows), sharex=True)
    colour_of = _joint_colours(recording)
    charts: list[Any] = list(axes.flat)
    for joint, chart in enumerate(charts[:count]):
        shade_phases(chart, recording.plan)
        limit = float(recording.torque_limits[joint])
        largest = float(np.abs(np.stack([recording.torques, recording.feedforward])[:, :, joint]).max())
        if np.isfinite(limit) and limit < 1.6 * largest:
            for edge in (-limit, limit):
                chart.axhline(edge, color=LIMIT, linewidth=1.0)
        chart.plot(recording.times_s, recording.feedforward[:, joint], color=PLANNED, linewidth=3.0, alpha=0.75)
        chart.plot(recording.times_s, recording.torques[:, joint], color=colour_of[joint], linewidth=1.2)
        chart.plot(recording.times_s, recording.feedback[:, joint], color=TEXT, linewidth=0.8)
        ratio = 100.0 * feedback_ratio(recording)[joint]
        label(chart, title=f"{recording.joints[joint].replace('_', ' ')}: feedback {ratio:.0f} %")
        chart.set_xlim(0.0, recording.times_s[-1])
    for chart in axes[:, 0]:
        label(chart, y="torque [N m]")
    for chart in charts[count:]:
        chart.set_visible(False)
    for column in range(min(columns, count)):
        lowest = axes[(count - 1 - column) // columns, column]
        lowest.tick_params(labelbottom=True)
        label(lowest, x="time [s]")
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=PLANNED, linewidth=3.0, alpha=0.75, label="feed-forward (planned)"),
        Line2D([], [], color=colour_of[0], linewidth=1.2, label="applied"),
        Line2D([], [], color=TEXT, linewidth=0.8, label="feedback"),
        Line2D([], [], color=LIMIT, linewidth=1.0, label="limit, where it is near"),
    ]
    legend(figure, handles=handles, loc="outside lower center", ncol=4)
    return figure


def plot_planar_run_drift(recording: PlanarRecording) -> Figure:
    """How far the contact points of every end-effector are from where the plan's contacts put them."""
    figure, axes = sheet(1, 1, size=(12.0, 3.2))
    chart = axes[0, 0]
    shade_phases(chart, recording.plan)
    drift = 1e3 * point_drift(recording)
    for end, colour in enumerate(end_colours(recording.plan.task.robot)):
        if np.isfinite(drift[:, end]).any():
            name = recording.end_effectors[end].replace("_", " ")
            chart.plot(recording.times_s, drift[:, end], color=colour, linewidth=1.6, label=name)
    largest = float(np.nanmax(drift, initial=0.0))
    chart.set_ylim(0.0, 1.1 * max(largest, 1e-3))
    label(chart, x="time [s]", y="[mm]", title=f"contact points off the plan's contacts: {largest:.1f} mm at most")
    chart.set_xlim(0.0, recording.times_s[-1])
    handles, names = chart.get_legend_handles_labels()
    if handles:
        legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=max(len(names), 1))
    return figure


def point_drift(recording: PlanarRecording) -> Array:
    """(n, e) [m] largest distance of an end-effector's points from where the plan's contact puts them; NaN: no contact."""
    away = np.linalg.norm(recording.points_W - recording.points_contact_W, axis=3)
    known = np.isfinite(away).any(axis=2)
    return np.where(known, np.max(np.nan_to_num(away), axis=2, initial=0.0), np.nan)


def force_error(recording: PlanarRecording) -> tuple[float, float]:
    """Root mean square [N] of the error of the end-effectors' forces, and its ratio to the planned forces'."""
    simulated, planned = _sums(recording)
    inside = recording.within_plan
    off = rms(np.linalg.norm(simulated - planned, axis=2)[inside])
    return off, off / max(rms(np.linalg.norm(planned, axis=2)[inside]), 1e-9)


def joint_error_deg(recording: PlanarRecording) -> Array:
    """(n, j) [degree] by which joints are off the plan."""
    return np.asarray(np.degrees(recording.q - recording.q_plan))


def feedback_ratio(recording: PlanarRecording) -> Array:
    """(j,) root mean square of each joint's feedback over that of its feed-forward."""
    inside = recording.within_plan
    back, forward = (np.sqrt(np.mean(t[inside] ** 2, axis=0)) for t in (recording.feedback, recording.feedforward))
    return np.asarray(back / np.maximum(forward, 1e-9))


def _sums(recording: PlanarRecording) -> tuple[Array, Array]:
    """Forces (n, e, 2) of the end-effectors, summed over points: simulated, planned."""
    return np.nansum(recording.forces_W, axis=2), np.nansum(recording.forces_plan_W, axis=2)


def _joint_colours(recording: PlanarRecording) -> list[str]:
    colours = [mix(BODY, TEXT, 0.45)] * len(recording.joints)
    for limb in limbs_of(recording.plan.task.robot):
        for place, body in enumerate(limb.bodies):
            colours[body - 1] = mix(limb.colour, "#ffffff", 0.16 * place)
    return colours


def _finish(figure: Figure, axes: Any, recording: PlanarRecording) -> None:
    from matplotlib.patches import Patch

    for chart in axes[-1]:
        label(chart, x="time [s]")
    axes[0, 0].set_xlim(0.0, recording.times_s[-1])
    handles = axes[0, 0].get_legend_handles_labels()[0] + [Patch(color=PHASE, label="every second phase")]
    legend(figure, handles=handles, loc="outside lower center", ncol=len(handles))
