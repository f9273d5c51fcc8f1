"""Pages for the browser and plots of plans. Needs ``pip install 'mcplan[view]'``, imported when used."""

from __future__ import annotations

from .page import Page
from .picture import picture
from .plots import (
    plot_com,
    plot_contact_sequence,
    plot_cost,
    plot_forces,
    plot_friction,
    plot_gait,
    plot_momentum,
    plot_pressure,
    plot_timing,
    save_plots,
)
from .show import show, show_scene

__all__ = [
    "Page",
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
    "show",
    "show_scene",
]
