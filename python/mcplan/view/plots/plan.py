"""Plots of a plan over time: CoM, angular momentum, base, contacts, forces, friction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal
from mcplan.kinematics.samples import Samples, contact_intervals, sample
from mcplan.view.colours import COM, TEXT, end_effector_colours, plain, surface_colours
from mcplan.view.sheets import QUIET, label, legend, shade_support, sheet, support_patches

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Plan

Array = NDArray[np.float64]

#: [1/s] sampling of curves.
RATE = 200.0


def plot_com(plan: Plan) -> Figure:
    """Position and velocity of the CoM; stretches in flight and on one contact are tinted."""
    samples = sample(plan, plan.scene, plan.robot, RATE)
    figure, axes = sheet(3, 2, size=(10.0, 6.0), sharex=True)
    for i, name in enumerate("xyz"):
        for column, (values, unit) in enumerate(((samples.com_W, "m"), (samples.com_velocity_W, "m/s"))):
            shade_support(axes[i, column], samples)
            axes[i, column].plot(samples.times_s, values[:, i], color=COM, linewidth=2.0)
            label(axes[i, column], y=f"{name} [{unit}]")
        axes[i, 0].plot(plan.knot_times(), [k.com_W[i] for k in plan.knots], "o", color=COM, markersize=3.5)
    label(axes[0, 0], title="CoM position")
    label(axes[0, 1], title="CoM velocity")
    for each in axes[2]:
        label(each, x="time [s]")
        each.set_xlim(0.0, samples.times_s[-1])
    figure.legend(
        handles=support_patches(),
        loc="outside lower center",
        ncol=2,
        frameon=False,
        fontsize=9,
        labelcolor=TEXT,
    )
    return figure


def plot_momentum(plan: Plan) -> Figure:
    """Angular momentum about the CoM; stretches in flight and on one contact are tinted."""
    samples = sample(plan, plan.scene, plan.robot, RATE)
    figure, axes = sheet(3, 1, size=(10.0, 5.6), sharex=True, sharey=True)
    for i, name in enumerate("xyz"):
        shade_support(axes[i, 0], samples)
        axes[i, 0].axhline(0.0, color=QUIET, linewidth=0.7)
        axes[i, 0].plot(samples.times_s, samples.angular_momentum_W[:, i], color=COM, linewidth=2.0)
        label(axes[i, 0], y=f"$L_{name}$ [kg m²/s]")
    largest = float(np.abs(samples.angular_momentum_W).max())
    if largest < 1e-2:  # a base as good as at rest: no axis in units of rounding
        axes[0, 0].set_ylim(-0.1, 0.1)
    label(axes[0, 0], title="angular momentum about the CoM")
    label(axes[2, 0], x="time [s]")
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    legend(figure, handles=support_patches(), loc="outside lower center", ncol=2)
    return figure


def plot_turning(plan: Plan) -> Figure:
    """Roll, pitch and yaw of the base; beside its yaw the headings of the soles in contact."""
    samples = sample(plan, plan.scene, plan.robot, RATE)
    states = [plan.at(float(t)) for t in samples.times_s]
    angles = np.degrees(np.array([state.base_rpy for state in states]))
    figure, axes = sheet(3, 1, size=(10.0, 5.6), sharex=True)
    for i, name in enumerate(("roll", "pitch", "yaw")):
        shade_support(axes[i, 0], samples)
        axes[i, 0].plot(samples.times_s, angles[:, i], color=COM, linewidth=2.0, label="base", zorder=3)
        label(axes[i, 0], y=f"{name} [deg]")
    for end, colour in enumerate(end_effector_colours(plan.robot)):
        end_effector = plan.robot.end_effectors[end]
        in_contact = samples.surfaces[:, end] >= 0
        if end_effector.half_size.all() and in_contact.any():
            heading = np.degrees([state.end_effectors[end].yaw for state in states])
            curve = np.where(in_contact, heading, np.nan)
            axes[2, 0].plot(samples.times_s, curve, color=colour, linewidth=1.4, label=plain(end_effector.name))
    for chart in axes[:, 0]:
        low, high = chart.get_ylim()
        if high - low < 1.0:  # no axis in units of rounding
            middle = 0.5 * (low + high)
            chart.set_ylim(middle - 0.5, middle + 0.5)
    label(axes[0, 0], title="orientation of the base")
    label(axes[2, 0], x="time [s]")
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    handles, _ = axes[2, 0].get_legend_handles_labels()
    handles += support_patches()
    legend(figure, handles=handles, loc="outside lower center", ncol=len(handles))
    return figure


def plot_gait(plan: Plan) -> Figure:
    """Contacts of every end-effector over time, coloured by surface."""
    from matplotlib.patches import Patch

    names = [plain(end.name) for end in plan.robot.end_effectors]
    intervals = contact_intervals(plan, plan.scene, plan.robot)
    used = sorted({interval.surface for interval in intervals})
    colours = surface_colours(plan.scene, used)
    figure, axes = sheet(1, 1, size=(10.0, 0.9 + 0.42 * len(names)))
    chart = axes[0, 0]
    for interval in intervals:
        chart.barh(
            interval.end_effector,
            interval.end_s - interval.start_s,
            left=interval.start_s,
            height=0.72,
            color=colours[interval.surface],
            edgecolor="white",
            linewidth=1.2,
        )
    for t in plan.knot_times():
        chart.axvline(t, color="#D5DADF", linewidth=0.6, zorder=0)
    chart.grid(False)
    chart.set_yticks(range(len(names)), names, fontsize=10)
    chart.set_ylim(len(names) - 0.45, -0.55)
    chart.set_xlim(0.0, plan.duration())
    label(chart, x="time [s]")
    if len(used) > 1:
        patches = [Patch(color=colours[s], label=plan.scene.surfaces[s].name.replace("$", r"\$")) for s in used]
        figure.legend(
            handles=patches,
            loc="outside upper center",
            ncol=min(len(used), 7),
            frameon=False,
            fontsize=9,
            labelcolor=TEXT,
        )
    return figure


def plot_forces(plan: Plan) -> Figure:
    """Normal and tangential force of every end-effector in contact, and the normal forces at its points
    where it has some."""
    samples = sample(plan, plan.scene, plan.robot, RATE)
    normal, tangential = contact_forces(plan, samples)
    at_points, _ = point_forces(plan, samples)
    used = [e for e in range(len(plan.robot.end_effectors)) if (samples.surfaces[:, e] >= 0).any()]
    colours = end_effector_colours(plan.robot)
    figure, axes = sheet(max(len(used), 1), 1, size=(10.0, 1.0 + 1.55 * max(len(used), 1)), sharex=True, sharey=True)
    weight = float(plan.robot.mass) * float(plan.scene.gravity)
    top = 1.08 * max(float(np.nanmax(normal, initial=0.0)), weight)
    for row, end in enumerate(used):
        chart = axes[row, 0]
        chart.axhline(weight, color=QUIET, linewidth=0.9, linestyle=":", label="weight")
        chart.fill_between(samples.times_s, np.nan_to_num(normal[:, end]), color=colours[end], alpha=0.18, linewidth=0)
        chart.plot(samples.times_s, normal[:, end], color=colours[end], linewidth=2.0, label="normal")
        chart.plot(samples.times_s, tangential[:, end], color=TEXT, linewidth=1.2, linestyle="--", label="tangential")
        if samples.has_points:
            lines = chart.plot(samples.times_s, at_points[:, end], color=colours[end], linewidth=0.8)
            lines[0].set_label("normal, at a point")
        cap = float(plan.robot.end_effectors[end].max_force)
        if np.isfinite(cap) and cap < 1.5 * top:
            chart.axhline(cap, color="#B00020", linewidth=0.9, label="cap of the force")
            top = max(top, 1.06 * cap)
        label(chart, y="force [N]", title=plain(plan.robot.end_effectors[end].name))
    axes[0, 0].set_ylim(0.0, top)
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    label(axes[-1, 0], x="time [s]")
    handles, names = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=len(names))
    return figure


def plot_friction(plan: Plan) -> Figure:
    """Ratio of tangential to normal force of every end-effector, and the friction coefficient of its surface.

    Surfaces that may be grasped have no cone and are drawn without a limit.
    """
    samples = sample(plan, plan.scene, plan.robot, RATE)
    normal, tangential = contact_forces(plan, samples)
    at_points = point_forces(plan, samples)
    weight = float(plan.robot.mass) * float(plan.scene.gravity)
    used = [e for e in range(len(plan.robot.end_effectors)) if (samples.surfaces[:, e] >= 0).any()]
    colours = end_effector_colours(plan.robot)
    figure, axes = sheet(max(len(used), 1), 1, size=(10.0, 1.0 + 1.45 * max(len(used), 1)), sharex=True)
    for row, end in enumerate(used):
        chart = axes[row, 0]
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(normal[:, end] > 1e-3 * weight, tangential[:, end] / normal[:, end], np.nan)
        limit = np.full(samples.count, np.nan)
        for s, surface in enumerate(plan.scene.surfaces):
            if not surface.grasp:
                limit[samples.surfaces[:, end] == s] = float(surface.friction)
        chart.plot(samples.times_s, limit, color="#B00020", linewidth=1.2, label="coefficient of friction")
        chart.plot(samples.times_s, ratio, color=colours[end], linewidth=2.0, label="tangential / normal")
        if samples.has_points:
            largest = largest_ratio(at_points[0][:, end], at_points[1][:, end], 1e-3 * weight)
            chart.plot(samples.times_s, largest, color=colours[end], linewidth=0.8, label="largest at a point")
            # A corner about to lift may show any ratio; the cone is what is to be read.
            ratio = np.append(ratio, np.minimum(largest, 2.0 * np.nanmax(np.append(limit, 0.1))))
        label(chart, y="ratio [-]", title=plain(plan.robot.end_effectors[end].name))
        chart.set_ylim(0.0, 1.15 * float(np.nanmax(np.append(np.concatenate([limit, ratio]), 0.1), initial=0.1)))
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    label(axes[-1, 0], x="time [s]")
    handles, names = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=len(names))
    return figure


def contact_forces(plan: Plan, samples: Samples) -> tuple[Array, Array]:
    """Normal and tangential force (n, end-effectors) [N] in the surfaces' frames; NaN without contact."""
    normals = np.array([polygon_normal(np.asarray(s.vertices_W)) for s in plan.scene.surfaces])
    in_contact = samples.surfaces >= 0
    along = normals[np.maximum(samples.surfaces, 0)]
    normal = np.sum(along * samples.forces_W, axis=2)
    tangential = np.linalg.norm(samples.forces_W - normal[..., None] * along, axis=2)
    return np.where(in_contact, normal, np.nan), np.where(in_contact, tangential, np.nan)


def point_forces(plan: Plan, samples: Samples) -> tuple[Array, Array]:
    """Normal and tangential force (n, end-effectors, points) [N] at the points of every contact; NaN where none is."""
    normals = np.array([polygon_normal(np.asarray(s.vertices_W)) for s in plan.scene.surfaces])
    along = normals[np.maximum(samples.surfaces, 0)][:, :, None]
    normal = np.sum(along * samples.point_forces_W, axis=3)
    return normal, np.linalg.norm(samples.point_forces_W - normal[..., None] * along, axis=3)


def largest_ratio(normal: Array, tangential: Array, min_N: float) -> Array:
    """Largest ratio (n,) of tangential to normal force of points (n, p) with at least `min_N` [N]; NaN without such."""
    ratio = np.where(normal > min_N, tangential / np.maximum(normal, min_N), -np.inf).max(axis=1)
    return np.where(ratio < 0.0, np.nan, ratio)
