"""What of the velocities that were commanded a robot walked at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import rotations_of

if TYPE_CHECKING:
    from mcplan.tracking.recording import Recording

    from .options import OnlineOptions

#: Commands that a report lists before it says how many there are more.
MOST_LISTED = 3

Velocity = tuple[float, float, float]


@dataclass(frozen=True)
class CommandReached:
    """A command and what came of it while it held.

    Attributes:
        from_s, to_s: Times of the run between which it held, as far as they were recorded.
        commanded: Velocity ahead and to the left [m/s], and turning [rad/s].
        reached: The same of CoM and base, the mean over that time, in the heading that the base had at each instant.
    """

    from_s: float
    to_s: float
    commanded: Velocity
    reached: Velocity


def commands_reached(recording: Recording, online: OnlineOptions) -> tuple[CommandReached, ...]:
    """Commands in the order in which they held, those that were recorded for two control steps at least."""
    found = []
    begins = sorted(row[0] for row in (*online.command, *online.goal))
    for command in online.command:
        ends_s = next((at_s for at_s in begins if at_s > command[0]), np.inf)
        within = np.flatnonzero((recording.times_s >= command[0] - 1e-9) & (recording.times_s <= ends_s + 1e-9))
        if len(within) > 1:
            first, last = int(within[0]), int(within[-1])
            spans = float(recording.times_s[first]), float(recording.times_s[last])
            found.append(CommandReached(*spans, command[1:], _mean_velocity(recording, first, last)))
    return tuple(found)


def _mean_velocity(recording: Recording, first: int, last: int) -> Velocity:
    """From a control step to another one: ahead, to the left [m/s], turning [rad/s]."""
    headings = _headings(recording.configurations[first : last + 1, 3:7])
    moved_W = np.diff(recording.com_W[first : last + 1, :2], axis=0)
    middle = 0.5 * (headings[1:] + headings[:-1])
    ahead = np.cos(middle) * moved_W[:, 0] + np.sin(middle) * moved_W[:, 1]
    left = np.cos(middle) * moved_W[:, 1] - np.sin(middle) * moved_W[:, 0]
    lasts_s = float(recording.times_s[last] - recording.times_s[first])
    return float(ahead.sum()) / lasts_s, float(left.sum()) / lasts_s, float(headings[-1] - headings[0]) / lasts_s


def _headings(quat_xyzw: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) headings without jumps [rad]."""
    rotations = rotations_of(quat_xyzw)
    return np.unwrap(np.arctan2(rotations[:, 1, 0], rotations[:, 0, 0]))


def reached_text(reached: tuple[CommandReached, ...]) -> str:
    """What was reached of what was commanded, and when."""
    parts = [_text(each) for each in reached[:MOST_LISTED]]
    more = len(reached) - MOST_LISTED
    return "; ".join(parts) + (f"; and {more} more" if more > 0 else "")


def _text(each: CommandReached) -> str:
    words = (("ahead", "m/s"), ("left", "m/s"), ("turning", "rad/s"))
    parts = [
        f"{name} {round(got, 3) + 0.0:.3g} of {asked:.3g} {unit}"
        for (name, unit), got, asked in zip(words, each.reached, each.commanded, strict=True)
    ]
    return f"{', '.join(parts)} ({each.from_s:.4g} to {each.to_s:.4g} s)"
