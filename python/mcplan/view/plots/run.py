"""Plots of a run: CoM, base, swings and angular momentum beside the plan's; all of a run's plots written to a folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.tracking import Recording
from mcplan.tracking.measures import rms
from mcplan.view.colours import COM, PLANNED, PUSH, TEXT, end_effector_colours, plain
from mcplan.view.runs import Run, recording_of
from mcplan.view.sheets import QUIET, label, legend, save_figures, sheet

from .run_axes import finish, shade_run
from .run_footholds import plot_run_footholds
from .run_forces import plot_run_forces, plot_run_torques

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

#: Behind text that may lie over curves.
PLATE = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 1.5}


def save_run_plots(run: Run, folder: str | Path) -> list[Path]:
    """Write the plots of a run: com.png, errors.png, forces.png, torques.png, momentum.png, footholds.png if
    the robot was planned for while it walked, and assist.png if there was any assistance.

    Args:
        run: A recording, or the result of tracking.
        folder: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        OSError: The folder cannot be written to.
    """
    recording = recording_of(run)
    figures = {
        "com": plot_run_com(recording),
        "errors": plot_run_errors(recording),
        "forces": plot_run_forces(recording),
        "torques": plot_run_torques(recording),
        "momentum": plot_run_momentum(recording),
    }
    if len(getattr(run, "plans", ())) > 1:  # replanned while walking
        figures["footholds"] = plot_run_footholds(recording)
    if recording.assist.any():
        figures["assist"] = plot_run_assist(recording)
    return save_figures(figures, folder)


def plot_run_com(recording: Recording) -> Figure:
    """Position of the CoM as planned and as simulated, and the difference."""
    figure, axes = sheet(3, 2, size=(11.0, 6.2), sharex=True)
    error_mm = 1e3 * (recording.com_W - recording.com_plan_W)
    for i, name in enumerate("xyz"):
        position, error = axes[i]
        for chart in (position, error):
            shade_run(chart, recording)
        _both(position, recording, recording.com_plan_W[:, i], recording.com_W[:, i], COM)
        error.axhline(0.0, color=QUIET, linewidth=0.7)
        error.plot(recording.times_s, error_mm[:, i], color=COM, linewidth=1.4)
        label(position, y=f"{name} [m]")
        label(error, y=f"{name} [mm]")
        _note(error, f"{rms(error_mm[:, i]):.1f} mm rms")
    label(axes[0, 0], title="CoM")
    label(axes[0, 1], title="simulated less planned")
    finish(figure, axes, recording, axes[0, 0])
    return figure


def plot_run_errors(recording: Recording) -> Figure:
    """Distance of the CoM from the plan, angle of the base, distance of each end-effector while it swings."""
    figure, axes = sheet(3, 1, size=(11.0, 6.4), sharex=True)
    com, base, swing = axes[:, 0]
    for chart in (com, base, swing):
        shade_run(chart, recording)
    miss = 1e3 * np.linalg.norm(recording.com_W - recording.com_plan_W, axis=1)
    com.plot(recording.times_s, miss, color=COM, linewidth=1.6)
    label(com, y="[mm]", title=f"CoM off the plan: {rms(miss):.1f} mm rms, {miss.max():.1f} mm at most")
    angle = base_angle_deg(recording)
    base.plot(recording.times_s, angle, color=TEXT, linewidth=1.6)
    label(base, y="[degree]", title=f"base off the plan: {rms(angle):.2f} degrees rms, {angle.max():.2f} at most")
    free = swings(recording)
    parts = []
    for number, colour in enumerate(end_effector_colours(recording.simulated_robot)):
        if not free[:, number].any():
            continue
        away = 1e3 * np.linalg.norm(
            recording.end_effectors_W[:, number] - recording.end_effectors_plan_W[:, number], axis=1
        )
        name = plain(recording.simulated_robot.end_effectors[number].name)
        shown = np.where(free[:, number], away, np.nan)
        swing.plot(recording.times_s, shown, color=colour, linewidth=1.6, label=name)
        parts.append(away[free[:, number]])
    if parts:
        together = np.concatenate(parts)
        label(swing, title=f"swings off the plan: {rms(together):.1f} mm rms, {together.max():.1f} mm at most")
        legend(swing, loc="upper right", ncol=4)
    else:
        label(swing, title="no swings")
    label(swing, y="[mm]")
    for chart in (com, base, swing):
        chart.set_ylim(bottom=0.0)
    finish(figure, axes, recording)
    return figure


def plot_run_momentum(recording: Recording) -> Figure:
    """Angular momentum about the CoM, as planned and as simulated."""
    figure, axes = sheet(3, 1, size=(11.0, 5.8), sharex=True, sharey=True)
    for i, name in enumerate("xyz"):
        chart = axes[i, 0]
        shade_run(chart, recording)
        _both(chart, recording, recording.angular_momentum_plan_W[:, i], recording.angular_momentum_W[:, i], COM)
        label(chart, y=f"$L_{name}$ [kg m²/s]")
    label(axes[0, 0], title="angular momentum about the CoM")
    finish(figure, axes, recording, axes[0, 0])
    return figure


def plot_run_assist(recording: Recording) -> Figure:
    """Force and moment of the assistance on the base."""
    figure, axes = sheet(2, 1, size=(11.0, 4.6), sharex=True)
    colours = (PUSH, "#117733", "#0072B2")
    for chart, wrench, name, unit in (
        (axes[0, 0], recording.assist[:, :3], "force", "N"),
        (axes[1, 0], recording.assist[:, 3:], "moment", "N m"),
    ):
        shade_run(chart, recording)
        for i, axis in enumerate("xyz"):
            chart.plot(recording.times_s, wrench[:, i], color=colours[i], linewidth=1.4, label=axis)
        size = np.linalg.norm(wrench, axis=1)
        label(chart, y=f"{name} [{unit}]", title=f"{name} of the assistance: {rms(size):.1f} {unit} rms")
    legend(axes[0, 0], loc="upper right", ncol=3)
    finish(figure, axes, recording)
    return figure


def base_angle_deg(recording: Recording) -> Array:
    """(n,) angle [degree] between the base as simulated and as planned."""
    simulated = recording.configurations[:, 3:7]
    planned = recording.base_quat_xyzw_plan
    cosine = np.abs(np.sum(simulated * planned, axis=1))
    cosine /= np.linalg.norm(simulated, axis=1) * np.linalg.norm(planned, axis=1)
    return np.asarray(np.degrees(2.0 * np.arccos(np.clip(cosine, 0.0, 1.0))))


def swings(recording: Recording) -> NDArray[np.bool_]:
    """(n, e) whether an end-effector is in a swing between two contacts."""
    in_contact = recording.contacts_plan >= 0
    before = np.maximum.accumulate(in_contact, axis=0)
    after = np.maximum.accumulate(in_contact[::-1], axis=0)[::-1]
    # Hands that are never in contact have no path that a plan asks for; one that will be in contact is in a swing.
    used = in_contact.any(axis=0)
    return np.asarray(~in_contact & (before | after) & used)


def _both(chart: Any, recording: Recording, planned: Array, simulated: Array, colour: str) -> None:
    chart.plot(recording.times_s, planned, color=PLANNED, linewidth=3.2, alpha=0.75, label="planned")
    chart.plot(recording.times_s, simulated, color=colour, linewidth=1.4, label="simulated")


def _note(chart: Any, text: str) -> None:
    chart.text(0.99, 0.95, text, transform=chart.transAxes, ha="right", va="top", fontsize=9, color=TEXT, bbox=PLATE)
