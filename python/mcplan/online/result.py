"""A run with replanning, and its measures."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np

from mcplan._core import Plan
from mcplan.errors import InvalidInput
from mcplan.files.plans import plan_from_bytes, plan_to_bytes
from mcplan.tracking.report import as_text, ending, rows_of
from mcplan.tracking.result import TrackingResult
from mcplan.tracking.result import result_from as tracking_result_from
from mcplan.tracking.run_files import RUN, Arrays, Header, RunParts, load_run, numbers, plain

from .measures import OnlineMeasures
from .options import OnlineOptions, option_names
from .velocities import CommandReached, commands_reached, reached_text

#: What stands in files of a plan that was followed, beside the plan.
_OF_PLANS = ("begins_s", "from_s", "took_s", "message", "com_shift_W")
#: A goal is reached from this distance of the CoM on, over its nominal height, and this turn [rad].
REACHED_RATIO, REACHED_RAD = 0.1, 0.2


@dataclass(frozen=True)
class FollowedPlan:
    """A plan that the controller followed.

    Attributes:
        plan: The plan.
        begins_s: Time of the run at which it begins: that of the state from which it was made, measured or, for rhp, predicted.
        from_s: Time of the run from which on it was followed.
        took_s: Wall clock of its computation.
        message: What the planner said of it.
        com_shift_W: (3,) by which its CoM is beside the robot's [m], which was pushed.
    """

    plan: Plan
    begins_s: float
    from_s: float
    took_s: float = 0.0
    message: str = ""
    com_shift_W: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class RunResult(TrackingResult):
    """What came of walking with replanning; all that a TrackingResult has. As text: a report of some lines.

    Attributes:
        online: How planning went.
        online_options: What was asked for.
        plans: Those that were followed, the first one first.
    """

    online: OnlineMeasures = field(default_factory=OnlineMeasures)
    online_options: OnlineOptions = field(default_factory=OnlineOptions)
    plans: tuple[FollowedPlan, ...] = ()

    @property
    def followed(self) -> bool:
        """Whether the run went to its end without a fall and, where its length was not asked for, came to its goal."""
        return self.completed and not self._short_of_goal()

    @property
    def falls_at_end(self) -> bool:
        """Of a run that ends when its time is up, maybe on the way, nothing is said."""
        return False

    @property
    def command_reached(self) -> tuple[CommandReached, ...]:
        """Velocities that were commanded, and at which the robot walked meanwhile."""
        return commands_reached(self.recording, self.online_options)

    def _short_of_goal(self) -> bool:
        """Whether the robot had its time and stands away from its goal, or turned from it."""
        reached_m = REACHED_RATIO * self.recording.plan.robot.com_height
        off_m, turned_rad = self.online.goal_off_m, self.online.goal_turned_rad or 0.0
        if off_m is None or not np.isnan(self.online_options.duration_s):
            return False
        return off_m > reached_m or abs(turned_rad) > REACHED_RAD

    def _parts(self) -> RunParts:
        parts = super()._parts()
        own = {
            "measures": plain(self.online.as_dict()),
            "options": plain(asdict(self.online_options)),
            "plans": [{name: getattr(p, name) for name in _OF_PLANS} for p in self.plans],
        }
        files = {_file_of(number): plan_to_bytes(p.plan) for number, p in enumerate(self.plans)}
        return replace(parts, more={**parts.more, "online": own}, files=files)

    @staticmethod
    def load(path: str | Path) -> TrackingResult:
        """Read what save() wrote; of a run that was saved without its planning, a TrackingResult.

        Raises:
            InvalidInput: No such file of a robot with a URDF; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        return load_run(path, {RUN: result_from})

    def __str__(self) -> str:
        recording = self.recording
        how = "replanned" if self.online_options.replanning else "one plan"
        ended = ending(self)
        if self.completed and self._short_of_goal():
            turned_rad = self.online.goal_turned_rad or 0.0
            turned = f" and {abs(turned_rad):.2f} rad" if abs(turned_rad) > REACHED_RAD else ""
            off = f"{self.online.goal_off_m:.2f} m{turned} off its goal"
            ended = f"{off} after {self.measures.completed_s:.2f} s, without a fall"
        title = f"{recording.plan.scene.name}  {recording.simulated_robot.name}  {ended} ({how})"
        rows = [row for row in rows_of(self) if row[0] != "base at the end"]
        kept_from_s = self.online.kept_from_s
        kept = [("recorded", f"from {kept_from_s:.2f} s on, as is what is measured")] if kept_from_s > 0.0 else []
        reached = reached_text(self.command_reached)
        kept += [("velocity reached", reached)] if reached else []
        return as_text(title, [*kept, *rows[:-2], *online_rows(self.online), *rows[-2:]])


def result_from(header: Header, arrays: Arrays) -> TrackingResult:
    """The result that the file of a run contains; earlier versions saved none of the planning."""
    tracked = tracking_result_from(header, arrays)
    own = header.get("online")
    if own is None:
        return tracked
    plans = []
    for number, of_plan in enumerate(own["plans"]):
        name = _file_of(number)
        if name not in arrays:
            raise InvalidInput(name, "is required")
        told = {key: of_plan[key] for key in _OF_PLANS if key in of_plan}  # earlier versions felt no pushes
        told["com_shift_W"] = tuple(told.get("com_shift_W", FollowedPlan.com_shift_W))
        plans.append(FollowedPlan(plan_from_bytes(arrays[name].tobytes()), **told))
    engine = own["options"].get("engine", OnlineOptions.engine)  # earlier versions had one alone
    options = numbers(
        {key: value for key, value in own["options"].items() if key in option_names() and key != "engine"}
    )
    options["engine"] = engine
    measured = dict(own["measures"])
    first_error = measured.pop("first_error", "")  # text, as no other measure; earlier versions had none
    measured = numbers(measured)
    for name in ("command", "goal"):
        options[name] = tuple(tuple(row) for row in options[name])
    return RunResult(
        tracked.recording,
        tracked.measures,
        tracked.options,
        tracked.interrupted,
        OnlineMeasures(**measured, first_error=first_error),
        OnlineOptions(**options),
        tuple(plans),
    )


def _file_of(number: int) -> str:
    return f"plan_{number:05d}"


def online_rows(m: OnlineMeasures) -> list[tuple[str, str]]:
    """Rows of the report about planning."""
    if not m.replans:
        return []
    late = "" if m.replans_late is None else f", {m.replans_late} took longer"
    return [
        ("replans", f"{m.replans_used} of {m.replans} used; " + ", ".join(f"{n} {s}" for s, n in m.statuses.items())),
        ("asked for by", ", ".join(f"{n} {reason}" for reason, n in m.reasons.items())),
        ("a replan takes", f"{m.replan_ms_median:.1f} ms in the median, {m.replan_ms_p99:.1f} ms in 99 %"),
        ("latency", f"{m.latency_ms:.1f} ms{late}"),
        ("oldest plan", f"{m.oldest_plan_s:.2f} s"),
        ("contacts not planned first", str(m.contact_changes)),
        *([("ground felt elsewhere", f"{m.ground_felt} times")] if m.ground_felt else []),
        *([("first error of a replan", m.first_error)] if m.first_error else []),
    ]
