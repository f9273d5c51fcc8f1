"""Pages for the browser, plots, videos and snapshots of plans and runs.

Needs ``pip install 'mcplan[view]'``, and for rendering runs ``mcplan[sim]``; both are imported when used.
"""

from __future__ import annotations

from .page import Page
from .picture import picture
from .plots import (
    film_strip,
    plot_base,
    plot_com,
    plot_cones,
    plot_contact_sequence,
    plot_cost,
    plot_drift,
    plot_forces,
    plot_friction,
    plot_gait,
    plot_joint_velocities,
    plot_joints,
    plot_momentum,
    plot_point_forces,
    plot_pressure,
    plot_timing,
    plot_torques,
    plot_turning,
    save_plots,
    stroboscope,
)
from .plots_run import (
    plot_run_assist,
    plot_run_com,
    plot_run_errors,
    plot_run_momentum,
    save_run_plots,
)
from .plots_run_forces import plot_run_forces, plot_run_torques
from .rendering import NoGraphics
from .run_strip import save_run_postures, save_run_strip
from .show import show, show_scene
from .show_run import show_run
from .video import save_video

__all__ = [
    "NoGraphics",
    "Page",
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
    "plot_run_assist",
    "plot_run_com",
    "plot_run_errors",
    "plot_run_forces",
    "plot_run_momentum",
    "plot_run_torques",
    "plot_torques",
    "plot_turning",
    "save_plots",
    "save_run_plots",
    "save_run_postures",
    "save_run_strip",
    "save_video",
    "show",
    "show_run",
    "show_scene",
    "stroboscope",
]
