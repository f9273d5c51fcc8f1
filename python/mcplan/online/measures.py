"""How planning beside the controller went, in numbers."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .planner import Update


@dataclass(frozen=True)
class OnlineMeasures:
    """Numbers of one run.

    Attributes:
        replans: Computations that ended during the run.
        replans_used: Those whose plan was taken over.
        replan_ms_median, replan_ms_p99: Wall clock of a computation [ms]; nan: there was none.
        latency_ms: Time from the measured state until its plan could be taken over, the mean [ms]; nan likewise.
        replans_late: Computations that took longer than the fixed latency; None: the latency was the measured one.
        oldest_plan_s: Largest time since the state was measured from which the plan under way was made [s], as long as
            steps lie ahead.
        contact_changes: Contacts that were made and that the first plan did not have: none of that end-effector within
            5 cm.
        ground_felt: How often a surface was found to be higher, lower or more slippery than was known, by the feet on it.
        stops: How often the robot was brought to a stand since no plan came.
        goal_off_m: From the CoM to the goal at the end, on the level [m]; None: a command held then, or the walk was one of rhp.
        goal_turned_rad: From the heading of the base to that of the goal at the end, to the left [rad]; None likewise.
        kept_from_s: Time of the run at which recording and plans begin, and measures of tracking, where only the end of the run
            is kept.
        statuses: How many computations had which status.
        reasons: How many were asked for by what: the period, a touchdown, the CoM or the capture point off the plan.
        first_error: What the planner said of the first state that it refused (status "error"); empty: none.
    """

    replans: int = 0
    replans_used: int = 0
    replan_ms_median: float = float("nan")
    replan_ms_p99: float = float("nan")
    latency_ms: float = float("nan")
    replans_late: int | None = None
    oldest_plan_s: float = 0.0
    contact_changes: int = 0
    ground_felt: int = 0
    stops: int = 0
    goal_off_m: float | None = None
    goal_turned_rad: float | None = None
    kept_from_s: float = 0.0
    statuses: dict[str, int] = field(default_factory=dict)
    reasons: dict[str, int] = field(default_factory=dict)
    first_error: str = ""

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON."""
        return asdict(self)


class Tally:
    """Counts what becomes of replans while a run goes on."""

    def __init__(self, fixed_latency_s: float) -> None:
        self.fixed_latency_s = fixed_latency_s
        self.took_s: list[float] = []
        self.latencies_s: list[float] = []
        self.statuses: Counter[str] = Counter()
        self.reasons: Counter[str] = Counter()
        self.used = self.contact_changes = self.stops = 0
        self.oldest_s = 0.0
        self.first_error = ""

    def computed(self, update: Update, latency_s: float, reason: str) -> None:
        """A computation ended."""
        self.took_s.append(update.took_s)
        self.latencies_s.append(latency_s)
        self.statuses[update.status] += 1
        self.reasons[reason] += 1
        if update.status == "error":
            self.first_error = self.first_error or update.message

    def measures(self, ground_felt: int = 0) -> OnlineMeasures:
        """The numbers; how often the ground was felt to be another the loop knows, and where the goal is."""
        took_ms = 1e3 * np.array(self.took_s)
        some = len(took_ms) > 0
        fixed = not np.isnan(self.fixed_latency_s)
        return OnlineMeasures(
            replans=len(took_ms),
            replans_used=self.used,
            replan_ms_median=float(np.median(took_ms)) if some else float("nan"),
            replan_ms_p99=float(np.quantile(took_ms, 0.99)) if some else float("nan"),
            latency_ms=1e3 * float(np.mean(self.latencies_s)) if some else float("nan"),
            replans_late=int((took_ms > 1e3 * self.fixed_latency_s).sum()) if fixed else None,
            oldest_plan_s=self.oldest_s,
            contact_changes=self.contact_changes,
            ground_felt=ground_felt,
            stops=self.stops,
            statuses=dict(sorted(self.statuses.items())),
            reasons=dict(sorted(self.reasons.items())),
            first_error=self.first_error,
        )
