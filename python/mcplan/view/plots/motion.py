"""Plots of a motion: torque and speed of its joints, distances, balance, CoM beside the plan's."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import COM, PUSH, TEXT, end_effector_colours, plain
from mcplan.view.sheets import QUIET, label, legend, save_figures, sheet, support_patches
from mcplan.wb.certificate import MotionTolerances
from mcplan.wb.certificate.curves import MotionCurves, curves_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan.wb import Motion

Array = NDArray[np.float64]

#: Joints that use more of their limit are named in bold; columns of a map.
MUCH, COLUMNS = 0.6, 900
#: Ratios that no limit allows.
OVER = PUSH


def save_motion_plots(motion: Motion, folder: str | Path) -> list[Path]:
    """Write the plots of a motion: torques.png, speeds.png, distances.png, balance.png and com.png.

    Args:
        motion: The motion.
        folder: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib or Pinocchio is not installed.
        OSError: The folder cannot be written to.
    """
    curves = curves_of(motion)
    figures = {
        "torques": plot_motion_joints(curves, "torque", curves.torque_use),
        "speeds": plot_motion_joints(curves, "speed", curves.speed_use),
        "distances": plot_motion_distances(motion, curves),
        "balance": plot_motion_balance(motion, curves),
        "com": plot_motion_com(motion, curves),
    }
    return save_figures(figures, folder)


def plot_motion_joints(curves: MotionCurves, what: str, uses: Array) -> Figure:
    """Ratio of each joint's torque or speed to its limit over time; what is beyond is red.

    Args:
        curves: The motion's.
        what: "torque" or "speed", for the title.
        uses: (n, j) ratios.
    """
    from matplotlib import colormaps

    joints, largest = len(curves.joints), uses.max(axis=0, initial=0.0)
    figure, axes = sheet(1, 1, size=(11.0, 1.3 + 0.2 * joints))
    chart = axes[0, 0]
    count = min(len(curves.times_s), COLUMNS)
    starts = np.linspace(0, len(curves.times_s), count, endpoint=False).astype(int)
    image = chart.imshow(
        np.maximum.reduceat(uses, starts, axis=0).T,
        aspect="auto",
        interpolation="nearest",
        cmap=colormaps["magma_r"].with_extremes(over=OVER),
        vmin=0.0,
        vmax=1.0,
        extent=(0.0, float(curves.times_s[-1]), joints - 0.5, -0.5),
    )
    chart.grid(False)
    names = [f"{_short(joint)}   {100.0 * m:.0f} %" for joint, m in zip(curves.joints, largest, strict=True)]
    chart.set_yticks(range(joints), names, fontsize=8)
    for text, m in zip(chart.get_yticklabels(), largest, strict=True):
        text.set_fontweight("bold" if m > MUCH else "normal")
        text.set_color(OVER if m > 1.0 else TEXT if m > MUCH else QUIET)
    chart.tick_params(axis="y", length=0)
    bar = figure.colorbar(image, ax=chart, pad=0.012, fraction=0.03, extend="max")
    bar.outline.set_visible(False)  # type: ignore[operator,unused-ignore]
    bar.ax.tick_params(labelsize=8, colors=QUIET, labelcolor=TEXT)
    label(
        chart, x="time [s]", title=f"joint {what} over its limit, at most as written; bold: above {100.0 * MUCH:.0f} %"
    )
    return figure


def plot_motion_distances(motion: Motion, curves: MotionCurves) -> Figure:
    """Distance of the nearest links, heights of swinging feet, drift of those in contact, each with its limit."""
    limits, robot = MotionTolerances(), motion.plan.robot
    figure, axes = sheet(3, 1, size=(11.0, 7.0), sharex=True)
    links, heights, drift = axes[:, 0]
    for chart in axes[:, 0]:
        _shade(chart, motion)
    if np.isfinite(curves.distance_m).any():
        nearest = int(np.argmin(curves.distance_m))
        links.plot(curves.distance_times_s, 1e3 * curves.distance_m, color=TEXT, linewidth=1.6)
        title = f"{1e3 * curves.distance_m[nearest]:.1f} mm, {plain(curves.links[nearest])}"
    else:
        title = "not known: the URDF has no collision shapes"
    _limit(links, 1e3 * limits.self_distance_m)
    label(links, y="[mm]", title=f"nearest links that count: {title}")
    for e, colour in enumerate(end_effector_colours(robot)):
        name = plain(robot.end_effectors[e].name)
        if robot.end_effectors[e].kind == "foot" and np.isfinite(curves.height_m[:, e]).any():
            heights.plot(curves.times_s, 1e3 * curves.height_m[:, e], color=colour, linewidth=1.6, label=name)
        if np.isfinite(curves.drift_m[:, e]).any():
            drift.plot(curves.times_s, 1e3 * curves.drift_m[:, e], color=colour, linewidth=1.6, label=name)
    _limit(heights, 1e3 * limits.mid_swing_m)
    label(heights, y="[mm]", title="swinging soles over the terrain; the limit is that of the middle of a swing")
    _limit(drift, 1e3 * limits.drift_m)
    label(drift, y="[mm]", title="end-effectors in contact off their footholds")
    if drift.get_legend_handles_labels()[0]:
        legend(drift, loc="upper right", ncol=4)
    for chart in axes[:, 0]:
        chart.set_ylim(bottom=0.0)
    _finish(figure, axes, curves)
    return figure


def plot_motion_balance(motion: Motion, curves: MotionCurves) -> Figure:
    """Force and moment on the base that no contact gives, on a logarithmic axis."""
    limits = MotionTolerances()
    figure, axes = sheet(2, 1, size=(11.0, 4.8), sharex=True)
    for i, (name, unit, limit) in enumerate(
        (("force", "N", limits.residual_N), ("moment", "N m", limits.residual_Nm)),
    ):
        chart, values = axes[i, 0], np.maximum(curves.residual[:, i], 1e-6)
        _shade(chart, motion)
        chart.plot(curves.times_s, values, color=COM, linewidth=1.2)
        chart.set_yscale("log")
        _limit(chart, limit)
        label(chart, y=f"[{unit}]", title=f"{name} on the base that no contact gives: up to {values.max():.2g} {unit}")
    _finish(figure, axes, curves)
    return figure


def plot_motion_com(motion: Motion, curves: MotionCurves) -> Figure:
    """Distance of the CoM from the plan's."""
    limits = MotionTolerances()
    figure, axes = sheet(1, 1, size=(11.0, 2.8))
    chart, off_mm = axes[0, 0], 1e3 * curves.com_off_m
    _shade(chart, motion)
    chart.plot(curves.times_s, off_mm, color=COM, linewidth=1.6)
    _limit(chart, 1e3 * limits.com_max_m)
    rms = float(np.sqrt(np.mean(off_mm**2)))
    label(chart, y="[mm]", title=f"CoM off the plan: {rms:.1f} mm rms, {off_mm.max():.1f} mm at most")
    chart.set_ylim(bottom=0.0)
    _finish(figure, axes, curves)
    return figure


def _shade(chart: Any, motion: Motion) -> None:
    """Tint the stretches with no contact and with one."""
    count = (motion.contacts >= 0).sum(axis=1)
    for contacts, patch in enumerate(support_patches()):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], (count == contacts).astype(int), [0]])))
        for start, stop in zip(edges[::2], edges[1::2], strict=True):
            times = motion.times_s[[start, stop]]
            chart.axvspan(times[0], times[1], color=patch.get_facecolor(), linewidth=0, zorder=0)


def _limit(chart: Any, value: float) -> None:
    chart.axhline(value, color=OVER, linewidth=0.9, linestyle=":")


def _finish(figure: Figure, axes: Any, curves: MotionCurves) -> None:
    from matplotlib.lines import Line2D

    label(axes[-1, 0], x="time [s]")
    axes[0, 0].set_xlim(0.0, float(curves.times_s[-1]))
    handles = [*support_patches(), Line2D([], [], color=OVER, linewidth=0.9, linestyle=":", label="limit")]
    legend(figure, handles=handles, loc="outside lower center", ncol=len(handles))


def _short(joint: str) -> str:
    return joint.removesuffix("_joint").replace("_", " ")
