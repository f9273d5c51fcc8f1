"""Plots of a solve over its iterations: contact sequence (Tazaki, Fig. 3), cost and weights (Fig. 4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import COM, TEXT, WARM, plain, surface_colour, surface_colours
from mcplan.view.sheets import label, sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Plan, Report


def has_sequences(report: Report) -> bool:
    """Whether the report recorded contact sequences to plot."""
    return any(len(row.sequence) for row in report.history)


def sequences_by_switches(report: Report, phases: int = 0) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Contact sequence at each number of switches.

    Args:
        report: With the sequence of each iteration in its history.
        phases: Number of phases. A search that went several ways has sequences of several lengths, and these are taken;
            0: those of the last iteration.

    Returns:
        (n + 1,) edges of the columns of such a chart, and (n, steps, end-effectors) surfaces, -1: none.

    Raises:
        ValueError: The history has no sequences.
    """
    rows = [row for row in report.history if len(row.sequence)]
    if not rows:
        raise ValueError("report.history: must hold contact sequences, got none (record them in the planner's options)")
    length = phases + 1 if phases else len(rows[-1].sequence)
    rows = [row for row in rows if len(row.sequence) == length] or [
        row for row in rows if len(row.sequence) == len(rows[-1].sequence)
    ]
    counts = np.cumsum([row.switches for row in rows])
    # The iteration that switched is the last of its count: those after it polish, or try changes that are rejected.
    reached: dict[int, NDArray[np.int64]] = {}
    for count, row in zip(counts, rows, strict=True):
        reached.setdefault(int(count), np.asarray(row.sequence, np.int64))
    at = sorted(reached)
    edges = np.append(np.array(at) - 0.5, at[-1] + 0.5)
    return edges, np.array([reached[count] for count in at])


def plot_contact_sequence(report: Report, plan: Plan | None = None) -> Figure:
    """Contact sequence against the number of contact switches, a panel per end-effector.

    Args:
        report: With the sequence of each iteration in its history.
        plan: Names surfaces and end-effectors; without, they are numbered.

    Raises:
        ValueError: The history has no sequences.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    edges, grid = sequences_by_switches(report, len(plan.phases) if plan is not None else 0)
    surfaces = int(max(grid.max() + 1, len(plan.scene.surfaces) if plan is not None else 1))
    used = sorted({int(s) for s in np.unique(grid) if s >= 0})
    palette = surface_colours(plan.scene, used) if plan is not None else [surface_colour(i) for i in range(surfaces)]
    colours = ListedColormap(["#F3F5F7", *palette])
    norm = BoundaryNorm(np.arange(-1.5, surfaces + 0.5), colours.N)
    end_effectors = grid.shape[2]
    figure, axes = sheet(end_effectors, 1, size=(9.0, 0.9 + 1.5 * end_effectors), sharex=True)
    for end in range(end_effectors):
        chart = axes[end, 0]
        chart.grid(False)
        steps = np.arange(grid.shape[1] + 1) - 0.5
        chart.pcolormesh(edges, steps, grid[:, :, end].T, cmap=colours, norm=norm, rasterized=True)
        name = plain(plan.robot.end_effectors[end].name) if plan is not None else f"end-effector {end}"
        label(chart, y="step k", title=name.replace("_", " "))
    label(axes[-1, 0], x="contact switches")
    names = [plan.scene.surfaces[s].name.replace("$", r"\$") if plan is not None else f"surface {s}" for s in used]
    patches = [Patch(color="#F3F5F7", label="free")]
    patches += [Patch(color=palette[s], label=name) for s, name in zip(used, names, strict=True)]
    figure.legend(
        handles=patches,
        loc="outside lower center",
        ncol=min(len(patches), 7),
        frameon=False,
        fontsize=9,
        labelcolor=TEXT,
    )
    return figure


def plot_cost(report: Report) -> Figure:
    """Weight of the complementarity terms and cost against the iteration, logarithmic.

    Raises:
        ValueError: The history is empty.
    """
    if not report.history:
        raise ValueError("report.history: must hold iterations, got none")
    index = [row.index for row in report.history]
    figure, axes = sheet(2, 1, size=(9.0, 4.6), sharex=True, height_ratios=(1, 2))
    weight, cost = axes[:, 0]
    weight.step(index, [row.contact_weight for row in report.history], where="mid", color=WARM[0], linewidth=2.0)
    label(weight, y="weight [-]", title="Weight of the complementarity terms")
    cost.plot(index, [row.cost for row in report.history], color=COM, linewidth=2.0)
    switched = [row for row in report.history if row.switches > 0]
    cost.plot(
        [row.index for row in switched],
        [row.cost for row in switched],
        "o",
        color=COM,
        markersize=4,
        label="contacts switched",
    )
    label(cost, x="iteration", y="cost [-]", title="Cost at that weight")
    for chart in (weight, cost):
        chart.set_yscale("log")
        chart.set_xlim(min(index), max(index) if max(index) > min(index) else min(index) + 1)
    if switched:
        cost.legend(frameon=False, fontsize=9, labelcolor=TEXT)
    return figure
