"""Pages for the browser, pictures, plots and videos of plans, motions and runs of robots in space; ``mcplan.planar.view`` has
those of planar robots, ``mcplan.showing`` what takes either.

Needs ``pip install 'mcplan[view]'``, and for rendering runs ``mcplan[sim]``; both are imported when used.
"""

from __future__ import annotations

from mcplan.view.live import LiveView, PlanningView
from mcplan.view.pages.page import Page
from mcplan.view.pages.show import show, show_scene
from mcplan.view.pages.show_motion import show_motion
from mcplan.view.pages.show_run import show_run
from mcplan.view.pictures.motion_picture import motion_picture
from mcplan.view.pictures.picture import picture
from mcplan.view.pictures.rendering import NoGraphics
from mcplan.view.pictures.run_strip import save_run_postures, save_run_strip
from mcplan.view.plots.motion import save_motion_plots
from mcplan.view.plots.plan import plot_com, plot_forces, plot_friction, plot_gait, plot_momentum, plot_turning
from mcplan.view.plots.points import plot_pressure, plot_timing
from mcplan.view.plots.report import plot_contact_sequence, plot_cost
from mcplan.view.plots.run import plot_run_assist, plot_run_com, plot_run_errors, plot_run_momentum, save_run_plots
from mcplan.view.plots.run_forces import plot_run_forces, plot_run_torques
from mcplan.view.plots.save import save_plots
from mcplan.view.video.film import save_video

__all__ = [
    "LiveView",
    "NoGraphics",
    "Page",
    "PlanningView",
    "motion_picture",
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
    "plot_run_assist",
    "plot_run_com",
    "plot_run_errors",
    "plot_run_forces",
    "plot_run_momentum",
    "plot_run_torques",
    "plot_turning",
    "save_motion_plots",
    "save_plots",
    "save_run_plots",
    "save_run_postures",
    "save_run_strip",
    "save_video",
    "show",
    "show_motion",
    "show_run",
    "show_scene",
]
