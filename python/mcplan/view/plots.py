"""All plots of a plan, written to a directory."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan._core import ForceLaw, WholeBodyPlan

from .film_strip import film_strip, stroboscope
from .picture import picture
from .plots_plan import plot_com, plot_forces, plot_friction, plot_gait, plot_momentum, plot_turning
from .plots_point_forces import plot_cones, plot_point_forces
from .plots_points import plot_pressure, plot_timing
from .plots_report import has_sequences, plot_contact_sequence, plot_cost
from .plots_whole_body import plot_base, plot_drift, plot_joint_velocities, plot_joints, plot_torques
from .sheets import save_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import Plan, Report

__all__ = [
    "film_strip",
    "picture",
    "plot_base",
    "plot_com",
    "plot_cones",
    "plot_contact_sequence",
    "plot_cost",
    "plot_drift",
    "plot_forces",
    "plot_friction",
    "plot_gait",
    "plot_joint_velocities",
    "plot_joints",
    "plot_momentum",
    "plot_point_forces",
    "plot_pressure",
    "plot_timing",
    "plot_torques",
    "plot_turning",
    "save_plots",
    "stroboscope",
]


def save_plots(plan: Plan | WholeBodyPlan, report: Report | None, directory: str | Path) -> list[Path]:
    """Write all plots of a plan.

    Of a plan of contacts and CoM: picture.png, gait.png, com.png, momentum.png, forces.png, friction.png, for one with
    forces at points pressure.png and timing.png, for one with contact wrenches pressure.png and turning.png, and from the
    report cost.png and contact_sequence.png as far as it holds
    their data. Of a whole-body plan: strip.png, postures.png, joints.png, velocities.png, torques.png, forces.png,
    cones.png, base.png and drift.png.

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
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    if isinstance(plan, WholeBodyPlan):
        written: list[Path] = []
        figures = _whole_body_figures(plan)
    else:
        written, figures = [picture(plan, path=directory / "picture.png")], _figures(plan, report)
    for name, figure in figures.items():
        path = directory / f"{name}.png"
        save_figure(figure, path)
        written.append(path)
    return written


def _figures(plan: Plan, report: Report | None) -> dict[str, Figure]:
    figures = {
        "gait": plot_gait(plan),
        "com": plot_com(plan),
        "momentum": plot_momentum(plan),
        "forces": plot_forces(plan),
        "friction": plot_friction(plan),
    }
    if any(phase.intervals for phase in plan.phases):
        figures |= {"pressure": plot_pressure(plan), "timing": plot_timing(plan)}
    elif any(phase.law == ForceLaw.wrench for phase in plan.phases):
        figures |= {"pressure": plot_pressure(plan), "turning": plot_turning(plan)}
    if report is not None and report.history:
        figures["cost"] = plot_cost(report)
        if has_sequences(report):
            figures["contact_sequence"] = plot_contact_sequence(report, plan)
    return figures


def _whole_body_figures(plan: WholeBodyPlan) -> dict[str, Figure]:
    return {
        "strip": film_strip(plan),
        "postures": stroboscope(plan),
        "joints": plot_joints(plan),
        "velocities": plot_joint_velocities(plan),
        "torques": plot_torques(plan),
        "forces": plot_point_forces(plan),
        "cones": plot_cones(plan),
        "base": plot_base(plan),
        "drift": plot_drift(plan),
    }
