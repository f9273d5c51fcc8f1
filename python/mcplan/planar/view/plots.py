"""Plots of a whole-body plan over time: joints, velocities and torques against their limits, base, contact errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import BODY, COM, TEXT, mix, plain
from mcplan.view.sheets import label, legend, sheet

from .figure import end_colours, limbs_of
from .samples import PlanarSamples, sample_phases

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import PlanarPlan

Array = NDArray[np.float64]

#: [1/s] sampling of curves.
RATE = 500.0
LIMIT = "#B00020"
FORBIDDEN = mix(LIMIT, "#ffffff", 0.86)
PHASE = "#F1F3F6"


def plot_joints(plan: PlanarPlan) -> Figure:
    """Position of every joint; what lies beyond its limits is shaded."""
    samples = sample_phases(plan, RATE)
    limits = {i: (float(b.position_min), float(b.position_max)) for i, b in enumerate(plan.task.robot.bodies)}
    return _joint_panels(plan, samples, samples.q, limits, "position", "rad")


def plot_joint_velocities(plan: PlanarPlan) -> Figure:
    """Velocity of every joint against its limits, with the ratio of the largest to them."""
    samples = sample_phases(plan, RATE)
    limits = {i: (-float(b.velocity_max), float(b.velocity_max)) for i, b in enumerate(plan.task.robot.bodies)}
    return _joint_panels(plan, samples, samples.velocity, limits, "velocity", "rad/s")


def plot_torques(plan: PlanarPlan) -> Figure:
    """Torque of every joint against its limits, with the ratio of the largest to them."""
    samples = sample_phases(plan, RATE)
    limits = {i: (-float(b.torque_max), float(b.torque_max)) for i, b in enumerate(plan.task.robot.bodies)}
    return _joint_panels(plan, samples, samples.torque, limits, "torque", "N m")


def plot_base(plan: PlanarPlan) -> Figure:
    """Position and angle of the base, and the CoM beside it."""
    samples = sample_phases(plan, RATE)
    figure, axes = sheet(3, 1, size=(10.0, 6.0), sharex=True)
    names = (("x [m]", 0), ("y [m]", 1), ("angle [rad]", 2))
    for chart, (name, i) in zip(axes[:, 0], names, strict=True):
        shade_phases(chart, plan)
        chart.plot(*curve(samples, samples.base[:, i]), color=TEXT, linewidth=1.8, label="base")
        if i < 2:
            chart.plot(*curve(samples, samples.com_W[:, i]), color=COM, linewidth=1.8, label="centre of mass")
        label(chart, y=name)
    label(axes[0, 0], title=f"base ({plan.task.robot.bodies[0].name})")
    label(axes[2, 0], x="time [s]")
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    handles, texts = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=texts, loc="outside lower center", ncol=2)
    return figure


def plot_drift(plan: PlanarPlan) -> Figure:
    """How far every end-effector in contact is from where it should be; the checker's tolerances in red."""
    from mcplan._core import PlanarTolerances

    tolerances = PlanarTolerances()
    samples = sample_phases(plan, RATE)
    ends, colours = plan.task.robot.end_effectors, end_colours(plan.task.robot)
    figure, axes = sheet(2, 1, size=(10.0, 5.0), sharex=True)
    distance = 1e3 * np.linalg.norm(samples.errors[:, :, :2], axis=2)
    angle = 1e3 * np.abs(samples.errors[:, :, 2])
    for chart, values, limit, title, unit in (
        (axes[0, 0], distance, 1e3 * float(tolerances.drift), "distance from where the contact should be", "mm"),
        (axes[1, 0], angle, 1e3 * float(tolerances.drift_angle), "angle from where it should be", "mrad"),
    ):
        shade_phases(chart, plan)
        for end, colour in zip(range(len(ends)), colours, strict=True):
            name = plain(ends[end].name)
            # Contacts have errors in common: later ones are dashed, so that those below are seen.
            dashes = "-" if end == 0 else (0.0, (6.0 / end, 4.0))
            chart.plot(*curve(samples, values[:, end]), color=colour, linewidth=1.6, linestyle=dashes, label=name)
        chart.axhline(limit, color=LIMIT, linewidth=1.0, label="tolerance of the checker")
        largest = float(np.nanmax(values, initial=0.0))
        chart.set_ylim(0.0, 1.08 * max(limit, largest))
        label(chart, y=f"[{unit}]", title=f"{title}, at most {largest:.2f} {unit}")
    label(axes[1, 0], x="time [s]")
    axes[0, 0].set_xlim(0.0, samples.times_s[-1])
    handles, texts = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=texts, loc="outside lower center", ncol=len(texts))
    return figure


def shade_phases(axes: Any, plan: PlanarPlan) -> None:
    """Tint every second phase."""
    times = plan.knot_times()
    for k in range(1, len(times) - 1, 2):
        axes.axvspan(times[k], times[k + 1], color=PHASE, linewidth=0, zorder=0)


def curve(samples: PlanarSamples, values: Array) -> tuple[Array, Array]:
    """Times and values (m,) with a gap between phases: what jumps there is not joined."""
    ends = np.flatnonzero(samples.phases[1:] != samples.phases[:-1]) + 1
    return np.insert(samples.times_s, ends, np.nan), np.insert(np.asarray(values, float), ends, np.nan)


def _joint_panels(
    plan: PlanarPlan,
    samples: PlanarSamples,
    values: Array,
    limits: dict[int, tuple[float, float]],
    quantity: str,
    unit: str,
) -> Figure:
    """A panel for each joint, in the rows of its limb; `limits` by body."""
    robot = plan.task.robot
    columns = 3
    order, colour_of = _joint_order(plan)
    rows = max(-(-len(order) // columns), 1)
    figure, axes = sheet(rows, columns, size=(12.0, 0.7 + 1.75 * rows), sharex=True)
    charts: list[Any] = list(axes.flat)
    for chart, body in zip(charts, order, strict=False):
        low, high = limits[body]
        line = values[:, body - 1]
        shade_phases(chart, plan)
        chart.plot(*curve(samples, line), color=colour_of[body], linewidth=1.8)
        view = _view(line, low, high)
        for edge, beyond in ((low, view[0]), (high, view[1])):
            if np.isfinite(edge):
                chart.axhspan(min(edge, beyond), max(edge, beyond), color=FORBIDDEN, linewidth=0, zorder=0.5)
                chart.axhline(edge, color=LIMIT, linewidth=1.0)
        chart.set_ylim(*view)
        chart.set_xlim(0.0, samples.times_s[-1])
        title = plain(robot.bodies[body].name)
        if low == -high and 0.0 < high < np.inf:
            title += f": {100.0 * float(np.abs(line).max()) / high:.0f} % of {high:g} {unit}"
        label(chart, title=title)
    for chart in axes[:, 0]:
        label(chart, y=f"{quantity} [{unit}]")
    for chart in charts[len(order) :]:
        chart.set_visible(False)
    for column in range(columns):
        lowest = (len(order) - 1 - column) // columns
        if lowest >= 0:
            axes[lowest, column].tick_params(labelbottom=True)
            label(axes[lowest, column], x="time [s]")
    _limit_legend(figure)
    return figure


def _joint_order(plan: PlanarPlan) -> tuple[list[int], dict[int, str]]:
    """Bodies with joints, limb by limb, the longer limbs first, the trunk's last; and their colours."""
    robot = plan.task.robot
    limbs = sorted(limbs_of(robot), key=lambda limb: -len(limb.bodies))
    order = [body for limb in limbs if len(limb.bodies) > 1 for body in limb.bodies]
    order += [i for i in range(1, len(robot.bodies)) if i not in order]
    colours = {i: mix(BODY, TEXT, 0.45) for i in range(len(robot.bodies))}
    colours |= {body: limb.colour for limb in limbs for body in limb.bodies}
    return order, colours


def _view(line: Array, low: float, high: float) -> tuple[float, float]:
    """Range of an axis: the limits with a margin where they are finite, and the curve."""
    edges = [e for e in (low, high) if np.isfinite(e)]
    bottom, top = min([float(line.min()), *edges]), max([float(line.max()), *edges])
    margin = 0.08 * max(top - bottom, 1e-3)
    return bottom - margin, top + margin


def _limit_legend(figure: Figure) -> None:
    from matplotlib.patches import Patch

    patches = [
        Patch(facecolor=FORBIDDEN, edgecolor=LIMIT, label="beyond the limits"),
        Patch(color=PHASE, label="every second phase"),
    ]
    legend(figure, handles=patches, loc="outside lower center", ncol=2)
