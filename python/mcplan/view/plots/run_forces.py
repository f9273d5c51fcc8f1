"""Plots of a run: contact forces beside the plan's, joint torques against their limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal
from mcplan.tracking import Recording
from mcplan.tracking.measures import rms
from mcplan.view.colours import PLANNED, TEXT, end_effector_colours, plain
from mcplan.view.runs import LEAST_S
from mcplan.view.sheets import QUIET, label, sheet

from .run_axes import finish, shade_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

#: Joints that use more of their torque are named in bold.
MUCH = 0.6


def plot_run_forces(recording: Recording) -> Figure:
    """Normal force at every end-effector in contact, as planned and as simulated, and the simulated
    tangential force."""
    robot, scene = recording.simulated_robot, recording.plan.scene
    used = [
        e
        for e in range(recording.contacts.shape[1])
        if recording.contacts[:, e].any() or (recording.contacts_plan[:, e] >= 0).any()
    ]
    rows = max(len(used), 1)
    figure, axes = sheet(rows, 1, size=(11.0, 1.4 + 1.75 * rows), sharex=True)
    colours = end_effector_colours(robot)
    weight = float(robot.mass) * float(scene.gravity)
    tallest = 0.0
    for row, end in enumerate(used):
        chart = axes[row, 0]
        shade_run(chart, recording)
        normals = contact_normals(recording, end)
        planned = np.sum(recording.forces_plan_W[:, end] * normals, axis=1)
        simulated = np.sum(recording.forces_W[:, end] * normals, axis=1)
        tangential = np.linalg.norm(recording.forces_W[:, end] - simulated[:, None] * normals, axis=1)
        chart.axhline(weight, color=QUIET, linewidth=0.9, linestyle=":", label="weight")
        chart.plot(recording.times_s, planned, color=PLANNED, linewidth=3.2, alpha=0.75, label="planned, normal")
        chart.plot(recording.times_s, simulated, color=colours[end], linewidth=1.3, label="simulated, normal")
        chart.plot(recording.times_s, tangential, color=TEXT, linewidth=0.8, label="simulated, tangential")
        # Impacts last milliseconds: they may leave the picture, so that the rest can be read.
        tallest = max(tallest, float(np.percentile(simulated, 99.5)), float(planned.max()))
        off = rms(np.linalg.norm(recording.forces_W[:, end] - recording.forces_plan_W[:, end], axis=1))
        ratio = 100.0 * off / weight
        name = plain(robot.end_effectors[end].name)
        label(chart, y="[N]", title=f"{name}: off the plan by {off:.0f} N rms ({ratio:.1f} % of the weight)")
    for row in range(len(used)):
        axes[row, 0].set_ylim(-0.03 * weight, 1.1 * max(tallest, 0.2 * weight))
    finish(figure, axes, recording, axes[0, 0])
    return figure


def plot_run_torques(recording: Recording) -> Figure:
    """Ratio of each joint's torque to its limit over time; joints with large ratios are in bold."""
    ratio = np.abs(recording.torques) / recording.torque_limits
    ratio = np.where(np.isfinite(ratio), ratio, 0.0)
    max_ratio = ratio.max(axis=0)
    joints = len(recording.joints)
    figure, axes = sheet(1, 1, size=(11.0, 1.3 + 0.2 * joints))
    chart = axes[0, 0]
    # The largest within each pixel's stretch: a peak of one step is not to be lost.
    count = min(len(recording.times_s), 900)
    starts = np.linspace(0, len(recording.times_s), count, endpoint=False).astype(int)
    largest = np.maximum.reduceat(ratio, starts, axis=0)
    last = max(float(recording.times_s[-1]), LEAST_S)
    image = chart.imshow(
        largest.T,
        aspect="auto",
        interpolation="nearest",
        cmap="magma_r",
        vmin=0.0,
        vmax=1.0,
        extent=(0.0, last, joints - 0.5, -0.5),
    )
    chart.grid(False)
    names = [f"{_short(joint)}   {100.0 * m:.0f} %" for joint, m in zip(recording.joints, max_ratio, strict=True)]
    chart.set_yticks(range(joints), names, fontsize=8)
    for text, m in zip(chart.get_yticklabels(), max_ratio, strict=True):
        text.set_fontweight("bold" if m > MUCH else "normal")
        text.set_color(TEXT if m > MUCH else QUIET)
    chart.tick_params(axis="y", length=0)
    bar = figure.colorbar(image, ax=chart, pad=0.012, fraction=0.03)
    bar.outline.set_visible(False)  # type: ignore[operator,unused-ignore]
    bar.ax.tick_params(labelsize=8, colors=QUIET, labelcolor=TEXT)
    title = f"joint torque over its limit, at most as written; bold: above {100.0 * MUCH:.0f} %"
    label(chart, x="time [s]", title=title)
    return figure


def contact_normals(recording: Recording, end: int) -> Array:
    """(n, 3) normal of the surface of an end-effector's contact, else of its next or its last one; up if none."""
    surfaces = recording.contacts_plan[:, end]
    known = np.flatnonzero(surfaces >= 0)
    if not len(known):
        return np.tile([0.0, 0.0, 1.0], (len(surfaces), 1))
    after = known[np.minimum(np.searchsorted(known, np.arange(len(surfaces))), len(known) - 1)]
    every = np.array([polygon_normal(np.asarray(s.vertices_W)) for s in recording.plan.scene.surfaces])
    return np.asarray(every[surfaces[after]])


def _short(joint: str) -> str:
    return joint.removesuffix("_joint").replace("_", " ")
