"""Pages, pictures and plots of whole-body plans of planar robots and of their runs.

Needs ``pip install 'mcplan[view]'``, and for rendering runs ``mcplan[sim]``; both are imported when used.
"""

from __future__ import annotations

from .film_strip import film_strip, stroboscope
from .pages import show_whole_body
from .plots import plot_base, plot_drift, plot_joint_velocities, plot_joints, plot_torques
from .plots_point_forces import plot_cones, plot_point_forces
from .plots_run import save_planar_run_plots
from .run_pages import show_planar_run
from .run_scene import planar_scene_of
from .save_plots import save_whole_body_plots

__all__ = [
    "film_strip",
    "planar_scene_of",
    "plot_base",
    "plot_cones",
    "plot_drift",
    "plot_joint_velocities",
    "plot_joints",
    "plot_point_forces",
    "plot_torques",
    "save_planar_run_plots",
    "save_whole_body_plots",
    "show_planar_run",
    "show_whole_body",
    "stroboscope",
]
