"""How a robot is planned for while it walks: plain data with defaults."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np

from mcplan.errors import InvalidOptions

#: Engines that replan.
ENGINES = ("ddp", "rhp")
#: Largest velocity that may be asked for [m/s, rad/s]: what is followed of it is as much as the robot can.
FASTEST = 10.0
#: Times of a run, and its length, at most [s].
MAX_RUN_S = 3600.0
#: Longest ``start_slack_s`` [s]. Replans take 5 s at most, and a robot has it times the root of its size over a human's: this
#: is within that for CoMs up to 2.4 m high.
LONGEST_SLACK_S = 3.0


@dataclass(frozen=True)
class OnlineOptions:
    """When to replan, and when a new plan is taken over.

    Attributes:
        engine: Who replans: "ddp", or "rhp", which is given surfaces and order of feet and plans at touchdowns.
        replanning: False: the first plan is followed to its end.
        period_s: A replan is asked for this long after the last one.
        at_touchdowns: And whenever an end-effector has come into contact.
        com_margin_m, capture_margin_m: And when the CoM, or the capture point p + v / omega, is farther from the plan's.
        pause_s: Least time between two that are not due by the period.
        latency_s: A plan is taken over this long after the state was measured from which it was made; nan: as long as its
            computation took by the wall clock, so that runs differ with the machine.
        time_limit_s: Wall clock of a replan [s]; nan: none with a fixed latency, the period without.
        command: Velocities to walk at, each from a time on: time [s], ahead, to the left [m/s], turning [rad/s]; until the
            first of these times to the scene's goal, as without any.
        goal: Goals to walk to instead of the scene's, each from a time on: time [s], x, y in the world [m], heading [rad].
            Of commands and goals, what began last holds.
        duration_s: Length of the run [s]; nan: until the goal is reached or pushes are over, and ``hold_s`` longer, twice that
            of the first plan and 5 s at the latest, and 10 s under a command.
        wide_reach: Where no plan keeps legs within the robot's boxes, they may reach as far as their joints let them (see
            ``reach``).
        start_slack_s: Time within which what the measured state violates has to be made good, for a robot of human size.
        felt_ground: Surfaces are taken to be at the height at which feet stand on them.
        told_at_s: Time from which on the planner knows the ground that is simulated, where that is not the plan's; nan: never.
        keep_s: The last so many seconds are in the result: recording, plans, measures of tracking; nan: all of the run, which
            takes 60 MB a minute for TALOS.
        stop_after_s: The robot is brought to a stand if it has left its plan and no plan has come for so long.
    """

    engine: str = "ddp"
    replanning: bool = True
    period_s: float = 0.1
    at_touchdowns: bool = True
    com_margin_m: float = 0.02
    capture_margin_m: float = 0.04
    pause_s: float = 0.03
    latency_s: float = float("nan")
    time_limit_s: float = float("nan")
    command: tuple[tuple[float, float, float, float], ...] = ()
    goal: tuple[tuple[float, float, float, float], ...] = ()
    duration_s: float = float("nan")
    wide_reach: bool = True
    start_slack_s: float = 1.0
    stop_after_s: float = 0.5
    felt_ground: bool = True
    told_at_s: float = float("nan")
    keep_s: float = float("nan")

    def validate(self) -> None:
        """Raise InvalidOptions naming the first field out of its range."""
        _require("engine", "must be 'ddp' or 'rhp'", repr(self.engine), self.engine in ENGINES)
        if self.engine == "rhp":
            self._require_for_rhp()
        if not self.replanning:
            self._require_for_one_plan()
        _require("period_s", "must lie in 0.01 to 10", self.period_s, 0.01 <= self.period_s <= 10)
        _require("pause_s", "must lie in 0 to 1", self.pause_s, 0 <= self.pause_s <= 1)
        for name in ("com_margin_m", "capture_margin_m", "stop_after_s"):
            value = getattr(self, name)
            _require(name, "must be above 0", value, bool(value > 0))
        rule = f"must be above 0 and at most {LONGEST_SLACK_S:g}"
        _require("start_slack_s", rule, self.start_slack_s, 0 < self.start_slack_s <= LONGEST_SLACK_S)
        for name, low, high, otherwise in (
            ("latency_s", 0.0, 1.0, "as long as its computation takes"),
            ("time_limit_s", 1e-3, 10.0, "the period, or none with a fixed latency"),
            ("duration_s", 0.01, MAX_RUN_S, "as long as the walk takes"),
            ("told_at_s", 0.0, MAX_RUN_S, "never"),
            ("keep_s", 0.1, MAX_RUN_S, "all of the run"),
        ):
            value = getattr(self, name)
            within = bool(np.isnan(value) or low <= value <= high)
            _require(
                name, f"must lie in {low:g} to {high:g} s, or be left out (nan): {otherwise}", f"{value:g}", within
            )
        for name, rule in (
            ("command", "must be three finite numbers, or four with a time before them"),
            ("goal", "must be two to four finite numbers: x, y, heading, and the time from which on it holds"),
        ):
            rows = getattr(self, name)
            for row in rows:
                ok = len(row) == 4 and bool(np.isfinite(np.asarray(row, float)).all())
                _require(name, rule, _listed(row), ok)
            times = [row[0] for row in rows]
            ascending = times == sorted(times) and min(times, default=0.0) >= 0 and max(times, default=0.0) <= MAX_RUN_S
            _require(name, f"must have ascending times of 0 to {MAX_RUN_S:g} s", _listed(times), ascending)
        for row in self.command:
            slow = all(abs(part) <= FASTEST for part in row[1:])
            _require("command", f"must have velocities of at most {FASTEST:g} m/s and rad/s", _listed(row[1:]), slow)
        both = {row[0] for row in self.command} & {row[0] for row in self.goal}
        _require("goal", "must not begin when a command does", _listed(both), not both)

    def _require_for_rhp(self) -> None:
        """Raise InvalidOptions naming the first field that a given sequence of steps cannot follow."""
        for name, instead in (
            ("command", "walk at a velocity with engine 'ddp'"),
            ("goal", "walk to another goal with engine 'ddp', or give a plan that leads there"),
        ):
            rows = getattr(self, name)
            _require(name, f"must not be given with engine 'rhp', whose steps are given: {instead}", rows, not rows)
        rule = (
            "must be true with engine 'rhp', which plans at touchdowns alone; take engine 'ddp' to replan by the period"
        )
        _require("at_touchdowns", rule, self.at_touchdowns, self.at_touchdowns)

    def _require_for_one_plan(self) -> None:
        """Raise InvalidOptions naming the first field of which a robot that follows its first plan takes no notice."""
        for name in ("command", "goal"):
            rows = getattr(self, name)
            _require(name, "must not be given without replanning, which alone leads elsewhere", rows, not rows)
        rule = "must not be given without replanning: nobody is told"
        _require("told_at_s", rule, self.told_at_s, bool(np.isnan(self.told_at_s)))

    def require_within(self, run_s: float) -> None:
        """Raise InvalidOptions naming the first command or goal that begins after a run of that duration, or what is told."""
        rule = f"must not lie after the end of the run, {run_s:.6g} s"
        for name in ("command", "goal"):
            for i, row in enumerate(getattr(self, name)):
                _require(f"{name}[{i}] at_s", rule, row[0], row[0] <= run_s)
        _require("told_at_s", rule, self.told_at_s, not self.told_at_s > run_s)

    def command_at(self, time_s: float) -> tuple[float, float, float] | None:
        """The velocity to walk at at a time [s]; None: to a goal."""
        command, goal = _last(self.command, time_s), _last(self.goal, time_s)
        if command is None or (goal is not None and goal[0] > command[0]):
            return None
        return command[1:]

    def goal_at(self, time_s: float) -> tuple[float, float, float] | None:
        """Place and heading to walk to at a time [s], unless a command holds; None: the scene's goal."""
        goal = _last(self.goal, time_s)
        return None if goal is None else goal[1:]

    @property
    def fixed_latency(self) -> bool:
        """Whether plans are taken over after a fixed time."""
        return not np.isnan(self.latency_s)


def _last(
    rows: tuple[tuple[float, float, float, float], ...], time_s: float
) -> tuple[float, float, float, float] | None:
    """The row that began last at a time [s]; None: none has begun."""
    return next((row for row in reversed(rows) if row[0] <= time_s + 1e-9), None)


def option_names() -> list[str]:
    """Names of the fields."""
    return [item.name for item in fields(OnlineOptions)]


def _listed(numbers: Iterable[float]) -> str:
    return ", ".join(f"{float(number):g}" for number in numbers)


def _require(field_name: str, rule: str, value: object, holds: bool) -> None:
    if not holds:
        raise InvalidOptions(field_name, rule, str(value))
