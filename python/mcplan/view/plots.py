"""All plots of a plan, written to a directory."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .picture import picture
from .plots_plan import plot_com, plot_forces, plot_friction, plot_gait, plot_momentum
from .plots_points import plot_pressure, plot_timing
from .plots_report import has_sequences, plot_contact_sequence, plot_cost

if TYPE_CHECKING:
    from mcplan import Plan, Report

__all__ = [
    "picture",
    "plot_com",
    "plot_contact_sequence",
    "plot_cost",
    "plot_forces",
    "plot_friction",
    "plot_gait",
    "plot_momentum",
    "plot_pressure",
    "plot_timing",
    "save_plots",
]


def save_plots(plan: Plan, report: Report | None, directory: str | Path) -> list[Path]:
    """Write picture.png, gait.png, com.png, momentum.png, forces.png, friction.png, for a plan with forces at points
    pressure.png and timing.png, and from the report cost.png and contact_sequence.png as far as it holds their data.

    Args:
        plan: The plan.
        report: How it was found; None: only the plan's plots.
        directory: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        OSError: The directory cannot be written to.
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    written = [picture(plan, path=directory / "picture.png")]
    figures = {
        "gait": plot_gait(plan),
        "com": plot_com(plan),
        "momentum": plot_momentum(plan),
        "forces": plot_forces(plan),
        "friction": plot_friction(plan),
    }
    if any(phase.intervals for phase in plan.phases):
        figures |= {"pressure": plot_pressure(plan), "timing": plot_timing(plan)}
    if report is not None and report.history:
        figures["cost"] = plot_cost(report)
        if has_sequences(report):
            figures["contact_sequence"] = plot_contact_sequence(report, plan)
    for name, figure in figures.items():
        path = directory / f"{name}.png"
        figure.savefig(path, metadata={"Software": None})
        written.append(path)
    return written
