"""A robot that is steered while it walks: velocities and pushes that are asked for as the run goes on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mcplan.errors import InvalidArgument, InvalidInput, InvalidOptions, shown
from mcplan.tracking.options import Push

from .options import FASTEST

if TYPE_CHECKING:
    from mcplan.tracking.options import Options, Watch

    from .options import OnlineOptions

#: Length of a run that is steered [s], unless another one is given.
STEERED_S = 600.0


@dataclass(frozen=True)
class Asked:
    """What is asked of a robot at an instant.

    Attributes:
        velocity: To walk at from now on: ahead, to the left [m/s], turning [rad/s]; None: as the options of the run say.
        push: A force that begins now: its size [N], how long it acts [s], where it points in the world [degrees], 0 along x,
            90 along y; None: none.
        ends: Whether the run is over.
    """

    velocity: tuple[float, float, float] | None = None
    push: tuple[float, float, float] | None = None
    ends: bool = False


#: Called at control steps with the simulated time [s].
Steer = Callable[[float], Asked]


class Beside(NamedTuple):
    """What is called while a run goes on.

    Attributes:
        progress: Now and then, with the time simulated and the time to simulate [s].
        watch: At every control step, with time [s], configuration and plan.
        steer: At every control step, for what is asked of the robot.
    """

    progress: Callable[[float, float], None] | None = None
    watch: Watch | None = None
    steer: Steer | None = None


#: Nothing is called.
ALONE = Beside()


def require_steerable(steer: Steer | None, online: OnlineOptions) -> None:
    """Raise InvalidArgument where that is no function, InvalidOptions where the options say otherwise where to walk."""
    if steer is None:
        return
    if not callable(steer):
        raise InvalidArgument("steer", "must be a function of the simulated time", shown(steer))
    require_undecided(online)


def require_undecided(online: OnlineOptions) -> None:
    """Raise InvalidOptions naming the option that says where a robot walks, which is steered."""
    usual = {"command": (), "goal": (), "engine": "ddp", "replanning": True}
    for name, value in usual.items():
        if getattr(online, name) != value:
            rule = "must be left as it is by default where the run is steered"
            raise InvalidOptions(name, rule, shown(getattr(online, name)))


def steered(steer: Steer, now_s: float, options: Options, online: OnlineOptions) -> tuple[Options, OnlineOptions, bool]:
    """Options with what is asked for now, so that a run with them repeats this one, and whether it is over.

    Args:
        steer: Who asks.
        now_s: Simulated time [s].
        options, online: With what was asked for until now.

    Raises:
        InvalidInput: What was returned is no such thing, or asks for no numbers.
    """
    asked = steer(now_s)
    if not isinstance(asked, Asked):
        raise InvalidInput("steer()", "must return an Asked", shown(asked))
    if not isinstance(asked.ends, (bool, np.bool_)):
        raise InvalidInput("steer().ends", "must be true or false", shown(asked.ends))
    if asked.velocity is not None:
        row = (now_s, *_three("velocity", asked.velocity))
        if max(map(abs, row[1:])) > FASTEST:
            rule = f"must have velocities of at most {FASTEST:g} m/s and rad/s"
            raise InvalidInput("steer().velocity", rule, shown(asked.velocity))
        if not online.command or online.command[-1][1:] != row[1:]:
            online = replace(online, command=(*online.command, row))
    if asked.push is not None:
        newtons, seconds, direction_deg = _three("push", asked.push)
        if seconds < 0.0:
            raise InvalidInput("steer().push[1]", "must not be negative", f"{seconds:g}")
        if not asked.ends:
            options = replace(options, pushes=(*options.pushes, Push(newtons, seconds, now_s, direction_deg)))
    return options, online, bool(asked.ends)


def as_it_was(options: Options, online: OnlineOptions, run_s: float) -> tuple[Options, OnlineOptions]:
    """Options that repeat a run of that length [s]: no push begins at its last instant."""
    pushes = tuple(push for push in options.pushes if push.at_s < run_s)
    if np.isnan(online.duration_s):
        online = replace(online, duration_s=run_s)
    return replace(options, pushes=pushes), online


def _three(name: str, values: object) -> tuple[float, float, float]:
    try:
        numbers = np.asarray(values)
        numbers = numbers.astype(float) if numbers.dtype.kind in "fiu" else np.zeros(0)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise InvalidInput(f"steer().{name}", "must be three finite numbers", shown(values))
    return float(numbers[0]), float(numbers[1]), float(numbers[2])
