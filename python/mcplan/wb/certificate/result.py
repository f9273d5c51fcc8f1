"""What the certificate says: the worst place of every constraint, and measures."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import PlanViolated

Array = NDArray[np.float64]

#: Units of constraints that are ratios.
RATIO = "x"


@dataclass(frozen=True)
class MotionViolation:
    """A constraint and the place where a motion is nearest to its limit, or beyond it.

    Attributes:
        name: Of the constraint, such as "torque".
        value: The largest one; of constraints with `at_least`, the smallest.
        limit: What is accepted.
        unit: Of both.
        time_s: When [s].
        joint: Name of the joint; "": not tied to one.
        end_effector: Name of the end-effector, likewise.
        links: Names of two links, likewise.
        at_least: Whether the limit is a lower one.
    """

    name: str
    value: float
    limit: float
    unit: str
    time_s: float = 0.0
    joint: str = ""
    end_effector: str = ""
    links: tuple[str, str] | tuple[()] = ()
    at_least: bool = False

    @property
    def violated(self) -> bool:
        """Whether the value is beyond its limit, or no number."""
        return not (self.value >= self.limit if self.at_least else self.value <= self.limit)

    @property
    def factor(self) -> float:
        """Value over limit: above 1 for what is violated. Of a lower limit, 2 less that."""
        if not np.isfinite(self.value):
            within = np.isinf(self.value) and (self.value > 0.0) == self.at_least
            return 0.0 if within else float("inf")
        if self.limit == 0.0:
            return float("inf") if self.violated else 0.0
        ratio = self.value / self.limit
        return max(0.0, 2.0 - ratio if self.at_least else ratio)

    @property
    def where(self) -> str:
        """The joint, end-effector or links."""
        return self.joint or self.end_effector or " and ".join(self.links)

    def __str__(self) -> str:
        at = f" at {self.where}" if self.where else ""
        unit = "" if self.unit == RATIO else f" {self.unit}"
        kind = "at least" if self.at_least else "at most"
        verb = "" if not self.violated else "violated: "
        return f"{self.name}{at}, t = {self.time_s:.3f} s: {verb}{self.value:.3g}{unit} ({kind} {self.limit:.3g}{unit})"


@dataclass(frozen=True)
class MotionCheckResult:
    """The worst place of every constraint of a motion, violated or not.

    Attributes:
        constraints: One of each name.
        measures: By name: what the constraints are about, and what is only told, such as `torque_use`.
        samples: Instants looked at.
        time_s: What the certificate took [s].
        notes: What could not be looked at, a sentence each.
    """

    constraints: tuple[MotionViolation, ...]
    measures: dict[str, float] = field(default_factory=dict)
    samples: int = 0
    time_s: float = 0.0
    notes: tuple[str, ...] = ()

    def ok(self) -> bool:
        """Whether the motion keeps all of them."""
        return not self.violations()

    def violations(self) -> list[MotionViolation]:
        """Those beyond their limit, worst first."""
        return sorted((c for c in self.constraints if c.violated), key=lambda c: -c.factor)

    def worst(self) -> MotionViolation:
        """The one nearest to its limit, or farthest beyond."""
        return max(self.constraints, key=lambda c: (c.violated, c.factor))

    def of(self, name: str) -> MotionViolation:
        """The constraint of a name."""
        return next(c for c in self.constraints if c.name == name)

    @property
    def verdict(self) -> str:
        """In a sentence."""
        if self.ok():
            return f"certified; closest to its limit: {self.worst()}"
        found = self.violations()
        more = f", and {len(found) - 1} more" * (len(found) > 1)
        return f"not certified: {found[0]}{more}"

    def raise_if_violated(self) -> None:
        """Raise PlanViolated naming the worst violation, if there is one."""
        if not self.ok():
            raise PlanViolated(self.violations())

    def as_dict(self) -> dict[str, Any]:
        """As plain data, for JSON; numbers that are not finite are None."""
        rows = [_row(constraint) for constraint in self.constraints]
        return {
            "ok": self.ok(),
            "violations": [_row(violation) for violation in self.violations()],
            "constraints": rows,
            "measures": {name: _finite(value) for name, value in self.measures.items()},
            "samples": self.samples,
            "time_s": self.time_s,
            "notes": list(self.notes),
        }

    def __str__(self) -> str:
        return "\n".join(str(violation) for violation in self.violations()) or "ok"


def largest(about: MotionViolation, values: Array, times: Array, joints: tuple[str, ...] = ()) -> MotionViolation:
    """A constraint at the largest of some values.

    Args:
        about: Name, limit and unit.
        values: (k) or (k, j).
        times: (k) [s].
        joints: (j) names of the columns.
    """
    if values.size == 0:
        return about
    plain = np.where(np.isnan(values), np.inf, values)
    at = np.unravel_index(int(np.argmax(plain)), plain.shape)
    joint = joints[at[1]] if joints else about.joint
    return replace(about, value=float(plain[at]), time_s=float(times[at[0]]), joint=joint)


def worse(first: MotionViolation, second: MotionViolation) -> MotionViolation:
    """Of the same constraint at two places, the one with the larger value (with `at_least`, the smaller)."""
    if first.at_least:
        return second if second.value < first.value else first
    return second if second.value > first.value else first


def _row(constraint: MotionViolation) -> dict[str, Any]:
    row = {**asdict(constraint), "links": list(constraint.links), "factor": constraint.factor}
    return {name: _finite(value) for name, value in row.items()}


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not np.isfinite(value) else value
