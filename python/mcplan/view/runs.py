"""What counts as a run: of a robot with a URDF, and for rendered pictures and videos of any robot."""

from __future__ import annotations

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


def last_time_s(run: AnyRun) -> float:
    """The last instant of a run."""
    recording: Any = getattr(run, "recording", run)
    return float(recording.times_s[-1])


def ground_shift_of(run: AnyRun) -> float:
    """Height [m] by which the simulated ground lay above the planned one; 0 where only the recording is known."""
    options = getattr(run, "options", None)
    return 0.0 if options is None else float(options.ground_shift_m)


def was_replanned(run: AnyRun) -> bool:
    """Whether other plans than the first one were followed, whose footholds are not those that it has."""
    return len(getattr(run, "plans", ())) > 1
