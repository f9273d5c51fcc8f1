"""What counts as a run for pictures and plots."""

from __future__ import annotations

from typing import TypeAlias

from mcplan.tracking import Recording, TrackingResult
from mcplan.tracking.planar import PlanarRecording, PlanarResult

#: A recording, or the result that carries one; of a robot with a URDF or of a planar robot.
Run: TypeAlias = Recording | TrackingResult | PlanarRecording | PlanarResult


def recording_of(run: Run) -> Recording | PlanarRecording:
    """The recording itself."""
    return run if isinstance(run, (Recording, PlanarRecording)) else run.recording


def ground_shift_of(run: Run) -> float:
    """Height [m] by which the simulated ground lay above the planned one; 0 where only the recording is known."""
    return 0.0 if isinstance(run, (Recording, PlanarRecording)) else float(run.options.ground_shift_m)
