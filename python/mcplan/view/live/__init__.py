"""What goes on, in a browser while it goes on: a search for a plan, a robot that is simulated."""

from __future__ import annotations

from .planning import PlanningView
from .robot import LiveView

__all__ = ["LiveView", "PlanningView"]
