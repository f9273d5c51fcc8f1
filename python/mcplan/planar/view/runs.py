"""What counts as a run of a planar robot for pictures and plots."""

from __future__ import annotations

from typing import TypeAlias

from mcplan.planar.tracking import PlanarRecording, PlanarResult

#: A recording, or the result that carries one.
PlanarRun: TypeAlias = PlanarRecording | PlanarResult


def planar_recording_of(run: PlanarRun) -> PlanarRecording:
    """The recording itself."""
    return run if isinstance(run, PlanarRecording) else run.recording
