"""All plots of a whole-body plan, written to a directory."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.view.sheets import save_figures

from .film_strip import film_strip, stroboscope
from .plots import plot_base, plot_drift, plot_joint_velocities, plot_joints, plot_torques
from .plots_point_forces import plot_cones, plot_point_forces

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan


def save_whole_body_plots(plan: PlanarPlan, directory: str | Path) -> list[Path]:
    """Write all plots of a whole-body plan.

    They are strip.png, postures.png, joints.png, velocities.png, torques.png, forces.png, cones.png, base.png and drift.png.

    Args:
        plan: The plan.
        directory: Made if it does not exist.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        OSError: The directory cannot be written to.
    """
    figures = {
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
    return save_figures(figures, directory)
