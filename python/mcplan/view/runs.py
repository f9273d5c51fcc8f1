"""What counts as a run: of a robot with a URDF, and for rendered pictures and videos of any robot."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mcplan.tracking import Options, Recording, TrackingResult


class AnyRecording(Protocol):
    """What a robot did, sampled."""

    @property
    def times_s(self) -> NDArray[np.float64]: ...


class AnyResult(Protocol):
    """A recording, and how the run was made."""

    @property
    def recording(self) -> AnyRecording: ...
    @property
    def options(self) -> Options: ...


#: Time that is drawn at least [s], of a run that ended when it began.
LEAST_S = 1e-3

#: A recording, or the result that carries one.
Run: TypeAlias = Recording | TrackingResult
AnyRun: TypeAlias = AnyRecording | AnyResult


def recording_of(run: Run) -> Recording:
    """The recording itself."""
    return run if isinstance(run, Recording) else run.recording


def times_between_s(run: AnyRun) -> tuple[float, float]:
    """The first and the last instant of what was recorded of a run."""
    recording: Any = getattr(run, "recording", run)
    return float(recording.times_s[0]), float(recording.times_s[-1])


def from_zero(recording: Recording) -> Recording:
    """The recording on a clock of its own, for what has to begin at 0."""
    begin_s = float(recording.times_s[0])
    touches = [replace(t, start_s=max(t.start_s - begin_s, 0.0), end_s=t.end_s - begin_s) for t in recording.touches]
    times_s, fell_at_s = recording.times_s - begin_s, recording.fell_at_s - begin_s
    return replace(recording, times_s=times_s, fell_at_s=fell_at_s, touches=tuple(touches))


def ground_shift_of(run: AnyRun) -> float:
    """Height [m] by which the simulated ground lay above the planned one; 0 where only the recording is known."""
    options = getattr(run, "options", None)
    return 0.0 if options is None else float(options.ground_shift_m)


def was_replanned(run: AnyRun) -> bool:
    """Whether other plans than the first one were followed, whose footholds are not those that it has."""
    return len(getattr(run, "plans", ())) > 1 or times_between_s(run)[0] > 0.0
