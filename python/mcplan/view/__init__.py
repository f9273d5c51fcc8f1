"""Pages for the browser and plots of plans. Needs ``pip install 'mcplan[view]'``."""

from __future__ import annotations

from .page import Page
from .show import show, show_scene

__all__ = ["Page", "show", "show_scene"]
