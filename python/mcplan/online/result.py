"""A run with replanning, and its measures."""

from __future__ import annotations

from dataclasses import dataclass, field

from mcplan._core import Plan
from mcplan.tracking.report import as_text, ending, rows_of
from mcplan.tracking.result import TrackingResult

from .measures import OnlineMeasures
from .options import OnlineOptions


@dataclass(frozen=True)
class FollowedPlan:
    """A plan that the controller followed.

    Attributes:
        plan: The plan.
        begins_s: Time of the run at which it begins: that of the state from which it was made.
        from_s: Time of the run from which on it was followed.
        took_s: Wall clock of its computation.
        message: What the planner said of it.
    """

    plan: Plan
    begins_s: float
    from_s: float
    took_s: float = 0.0
    message: str = ""


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

    def __str__(self) -> str:
        recording = self.recording
        how = "replanned" if self.online_options.replanning else "one plan"
        title = f"{recording.plan.scene.name}  {recording.simulated_robot.name}  {ending(self)} ({how})"
        rows = [row for row in rows_of(self) if row[0] != "base at the end"]
        return as_text(title, [*rows[:-2], *online_rows(self.online), *rows[-2:]])


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
    ]
