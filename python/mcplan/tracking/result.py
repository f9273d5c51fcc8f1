"""A run and its measures."""

from __future__ import annotations

from dataclasses import dataclass

from .measures import Measures
from .options import Options
from .recording import Recording


@dataclass(frozen=True)
class TrackingResult:
    """What came of tracking a plan.

    Attributes:
        recording: What the robot did.
        measures: How well.
        options: What was asked for.
    """

    recording: Recording
    measures: Measures
    options: Options
