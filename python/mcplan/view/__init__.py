"""Pages for the browser and plots of plans. Needs ``pip install 'mcplan[view]'``, imported when used."""

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
    save_plots,
    stroboscope,
)
from .show import show, show_scene

__all__ = [
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
    "plot_torques",
    "save_plots",
    "show",
    "show_scene",
    "stroboscope",
]
