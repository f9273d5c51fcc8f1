"""All plots of a plan, written to a directory."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.files.outputs import made_folder
from mcplan.view.pictures.picture import picture
from mcplan.view.sheets import save_figures

from .plan import plot_com, plot_forces, plot_friction, plot_gait, plot_momentum, plot_turning
from .points import plot_pressure, plot_timing
from .report import has_sequences, plot_contact_sequence, plot_cost

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Plan, Report


def save_plots(plan: Plan, report: Report | None, directory: str | Path) -> list[Path]:
    """Write all plots of a plan.

    They are picture.png, gait.png, com.png, momentum.png, forces.png, friction.png, for a plan with forces at points
    pressure.png and timing.png, for one with contact wrenches pressure.png and turning.png, and from the report
    cost.png and contact_sequence.png as far as it has their data.

    Args:
        plan: The plan.
        report: How it was found; None: only the plan's plots.
        directory: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        OSError: The directory cannot be written to.
    """
    directory = made_folder(directory)
    return [picture(plan, path=directory / "picture.png"), *save_figures(_figures(plan, report), directory)]


def _figures(plan: Plan, report: Report | None) -> dict[str, Figure]:
    figures = {
        "gait": plot_gait(plan),
        "com": plot_com(plan),
        "momentum": plot_momentum(plan),
        "forces": plot_forces(plan),
        "friction": plot_friction(plan),
    }
    has_points = any(phase.has_points for phase in plan.phases)
    has_wrenches = any(phase.has_wrenches for phase in plan.phases)
    # Forces on a point foot have one place to act.
    if (has_points or has_wrenches) and any(end.half_size.all() for end in plan.robot.end_effectors):
        figures["pressure"] = plot_pressure(plan)
    if has_points:
        figures["timing"] = plot_timing(plan)
    elif has_wrenches:
        figures["turning"] = plot_turning(plan)
    if report is not None and report.history:
        figures["cost"] = plot_cost(report)
        if has_sequences(report):
            figures["contact_sequence"] = plot_contact_sequence(report, plan)
    return figures
