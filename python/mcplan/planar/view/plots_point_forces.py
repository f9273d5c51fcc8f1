"""Plots of the contact forces of a whole-body plan: over time at every point, and in their friction cones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.view.colours import BODY, TEXT, mix, plain
from mcplan.view.sheets import label, legend, sheet

from .figure import end_colours
from .plots import LIMIT, RATE, curve, shade_phases
from .samples import sample_phases

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import PlanarPlan


def plot_point_forces(plan: PlanarPlan) -> Figure:
    """Normal and tangential force at every point of every end-effector; the tangential one stays in the band of plus and
    minus the coefficient of friction times the normal one."""
    samples = sample_phases(plan, RATE)
    end_effectors, colours = plan.task.robot.end_effectors, end_colours(plan.task.robot)
    columns = max((len(end.points) for end in end_effectors), default=1)
    figure, axes = sheet(
        max(len(end_effectors), 1),
        columns,
        size=(12.0, 1.0 + 1.9 * max(len(end_effectors), 1)),
        sharex=True,
        sharey=True,
    )
    for row, end in enumerate(end_effectors):
        for column in range(columns):
            chart = axes[row, column]
            if column >= len(end.points):
                chart.set_visible(False)
                continue
            shade_phases(chart, plan)
            normal, tangential = samples.normal[:, row, column], samples.tangential[:, row, column]
            cone = samples.friction[:, row] * normal
            chart.fill_between(
                curve(samples, cone)[0],
                -curve(samples, cone)[1],
                curve(samples, cone)[1],
                color=colours[row],
                alpha=0.14,
                linewidth=0,
                label="friction cone",
            )
            chart.plot(*curve(samples, normal), color=colours[row], linewidth=1.8, label="normal")
            chart.plot(
                *curve(samples, tangential),
                color=TEXT,
                linewidth=1.1,
                linestyle=(0, (4, 1.5)),
                label="tangential",
            )
            name = plain(end.name)
            label(chart, title=f"{name}, point at {1e3 * float(end.points[column]):+.0f} mm")
        label(axes[row, 0], y="force [N]")
    if len(end_effectors):
        # The band of a firm contact is wide; what is to be read are the forces in it.
        forces = np.concatenate([samples.normal.ravel(), samples.tangential.ravel()])
        top, bottom = float(np.nanmax(forces, initial=1.0)), float(np.nanmin(forces, initial=0.0))
        axes[0, 0].set_ylim(min(bottom, 0.0) - 0.25 * top, 1.1 * top)
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    for chart in axes[-1]:
        label(chart, x="time [s]")
    handles, names = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=max(len(names), 1))
    return figure


def plot_cones(plan: PlanarPlan) -> Figure:
    """Normal over tangential force of every end-effector, a curve for each point, within the cone of its surface."""
    samples = sample_phases(plan, RATE)
    end_effectors, colours = plan.task.robot.end_effectors, end_colours(plan.task.robot)
    top = 1.06 * float(np.nanmax(samples.normal, initial=1.0))
    side = 1.15 * max(float(np.nanmax(np.abs(samples.tangential), initial=0.0)), 0.3 * top)
    count = max(len(end_effectors), 1)
    width = min(
        4.0, 12.0 / count
    )  # inches of a panel; both axes have one scale, so that cones look as wide as they are
    height = 1.5 + (width - 0.6) * top / (2.0 * side)
    figure, axes = sheet(1, count, size=(0.6 + width * count, height), sharex=True, sharey=True)
    shades = {}
    for chart, end, colour in zip(axes[0], range(len(end_effectors)), colours, strict=False):
        for friction in sorted({float(f) for f in samples.friction[:, end] if np.isfinite(f)}):
            edge = np.array([-side, 0.0, side])
            chart.fill_between(edge, np.abs(edge) / max(friction, 1e-6), top, color=colour, alpha=0.08, linewidth=0)
            chart.plot(edge, np.abs(edge) / max(friction, 1e-6), color=LIMIT, linewidth=1.1, label="friction cone")
        for point, at in enumerate(end_effectors[end].points):
            name, shade = f"point at {1e3 * float(at):+.0f} mm", "#000000" if point else "#ffffff"
            shades[name] = mix(BODY, shade, 0.35)
            _, tangential = curve(samples, samples.tangential[:, end, point])
            _, normal = curve(samples, samples.normal[:, end, point])
            chart.plot(tangential, normal, color=mix(colour, shade, 0.35), linewidth=1.3, label=name)
        chart.set_aspect("equal")
        label(chart, x="tangential force [N]", title=plain(end_effectors[end].name))
    label(axes[0, 0], y="normal force [N]")
    axes[0, 0].set_xlim(-side, side)
    axes[0, 0].set_ylim(-0.04 * top, top)
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=LIMIT, linewidth=1.1, label="friction cone")]
    handles += [Line2D([], [], color=shade, linewidth=2.0, label=name) for name, shade in shades.items()]
    legend(figure, handles=handles, loc="outside lower center", ncol=len(handles))
    return figure
