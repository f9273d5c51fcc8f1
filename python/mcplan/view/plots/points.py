"""Plots of where forces act in soles and of how long phases last: centre of pressure under every foot, durations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.kinematics.samples import sample
from mcplan.view.colours import TEXT, end_effector_colours, plain
from mcplan.view.sheets import QUIET, label, legend, shade_support, sheet

from .plan import RATE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Plan

#: Colour of phases on all feet, in the timing bars.
MANY = "#C3CAD2"


def plot_pressure(plan: Plan) -> Figure:
    """Centre of pressure of every end-effector with a sole, along its length and its width; the sole ends at the red
    lines. In metres where forces act at points, in parts of half the sole's size where the plan has contact wrenches."""
    samples = sample(plan, plan.scene, plan.robot, RATE)
    end_effectors = plan.robot.end_effectors
    says_where = samples.surfaces >= 0
    if not samples.has_wrenches:
        says_where = np.asarray(np.isfinite(samples.points_W).any(axis=(2, 3)))
    used = [e for e in range(len(end_effectors)) if says_where[:, e].any() and end_effectors[e].half_size.all()]
    colours = end_effector_colours(plan.robot)
    figure, axes = sheet(max(len(used), 1), 2, size=(10.0, 1.0 + 1.7 * max(len(used), 1)), sharex=True)
    for row, end in enumerate(used):
        offset = samples.pressure_W[:, end] - samples.positions_W[:, end]
        in_sole = np.einsum("nji,nj->ni", samples.rotations_W[:, end], offset)
        in_sole[samples.surfaces[:, end] < 0] = np.nan
        for column, side in enumerate(("length", "width")):
            chart = axes[row, column]
            half, unit = float(end_effectors[end].half_size[column]), "[m]"
            if samples.has_wrenches:
                in_sole[:, column] /= half
                half, unit = 1.0, "[half size]"
            shade_support(chart, samples)
            for edge in (-half, half):
                chart.axhline(edge, color="#B00020", linewidth=1.2, label="edge of the sole" if edge > 0.0 else None)
            chart.plot(
                samples.times_s, in_sole[:, column], color=colours[end], linewidth=2.0, label="centre of pressure"
            )
            chart.set_ylim(-1.25 * half, 1.25 * half)
            label(chart, y=unit, title=f"{plain(end_effectors[end].name)}, along its {side}")
    for chart in axes[-1]:
        label(chart, x="time [s]")
        chart.set_xlim(0.0, samples.times_s[-1])
    handles, names = axes[0, 0].get_legend_handles_labels()
    if handles:
        legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=len(names))
    return figure


def plot_timing(plan: Plan) -> Figure:
    """Duration of every phase: grey on several contacts, in the end-effector's colour on one, hollow in flight."""
    from matplotlib.patches import Patch

    colours = end_effector_colours(plan.robot)
    times = np.array(plan.knot_times())
    durations = np.diff(times)
    figure, axes = sheet(1, 1, size=(10.0, 3.4))
    chart = axes[0, 0]
    shown: dict[str, str] = {}
    for k, row in enumerate(plan.contact_sequence()):
        in_contact = [end for end, surface in enumerate(row) if surface >= 0]
        colour, name = MANY, "several contacts"
        if len(in_contact) == 1:
            colour, name = colours[in_contact[0]], f"{plain(plan.robot.end_effectors[in_contact[0]].name)} alone"
        elif not in_contact:
            colour, name = "white", "flight"
        shown[name] = colour
        chart.bar(k, durations[k], color=colour, edgecolor=QUIET if colour == "white" else colour, width=0.8)
        if len(durations) <= 24:
            chart.text(k, durations[k], f"{durations[k]:.2f}", ha="center", va="bottom", fontsize=8, color=TEXT)
    chart.set_xlim(-0.7, len(durations) - 0.3)
    chart.set_ylim(0.0, 1.12 * durations.max())
    chart.grid(False, axis="x")
    label(chart, x="phase", y="duration [s]", title=f"{len(durations)} phases in {times[-1]:.2f} s")
    patches = [Patch(facecolor=colour, edgecolor=QUIET, label=name) for name, colour in sorted(shown.items())]
    legend(figure, handles=patches, loc="outside lower center", ncol=len(patches))
    return figure
