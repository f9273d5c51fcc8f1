"""What is found when a plan is compared with a robot's limits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Finding:
    """The place where a plan asks most of one limit of the robot, whether that is beyond it or not.

    Attributes:
        name: The limit: "reach", "sole", "balance", "torque", "joint_velocity", "hand_force", "clearance", "foothold",
            "link" or "mass".
        value: What is asked for, in `unit`.
        limit: The largest value that is accepted.
        unit: Unit of value and limit.
        where: End-effector, joint, link or "com"; empty: the whole robot.
        time_s: When.
        note: What else is worth knowing, e.g. which joints are at their limits.
    """

    name: str
    value: float
    limit: float
    unit: str
    where: str = ""
    time_s: float = 0.0
    note: str = ""

    @property
    def use(self) -> float:
        """value / limit; above 1: infeasible."""
        return self.value / self.limit if self.limit > 0 else float("inf") if self.value > 0 else 0.0

    def __str__(self) -> str:
        of = f" of {self.where}" if self.where else ""
        unit = f" {self.unit}" if self.unit else ""
        text = f"{self.name}{of} at {self.time_s:.2f} s: {self.value:.3g}{unit}, limit {self.limit:.3g}{unit}"
        return text + (f" ({self.note})" if self.note else "")


@dataclass(frozen=True)
class Feasibility:
    """Whether a robot can follow a plan, from postures and estimates: no simulation.

    Attributes:
        robot: Name of the robot.
        constraints: For every limit, and for each end-effector or joint that it holds, the place of the largest value.
    """

    robot: str
    constraints: tuple[Finding, ...]

    def ok(self) -> bool:
        """Whether no limit is exceeded."""
        return not self.violations()

    def violations(self) -> list[Finding]:
        """Those beyond their limit, worst first."""
        return sorted((f for f in self.constraints if f.value > f.limit), key=lambda f: -f.use)

    def worst(self) -> Finding:
        """Largest value / limit, exceeded or not."""
        return max(self.constraints, key=lambda f: f.use)

    def worst_of_each(self) -> list[Finding]:
        """One finding for each name, in the order in which they are looked at."""
        names = dict.fromkeys(f.name for f in self.constraints)
        return [max(self._named(name), key=lambda f: f.use) for name in names]

    def of(self, name: str) -> dict[str, Finding]:
        """Findings of one name by end-effector or joint."""
        return {f.where: f for f in self._named(name)}

    @property
    def verdict(self) -> str:
        """One sentence."""
        if self.ok():
            return f"{self.robot} can follow the plan; nearest to its limit: {self.worst()}"
        first = self.violations()[0]
        misses = [f for f in self.violations() if f.name == "reach"]
        if misses and first.name != "reach":
            return f"{self.robot} cannot follow the plan: {misses[0]}; its other numbers are of postures that miss the plan"
        return f"{self.robot} cannot follow the plan: {first}"

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "robot": self.robot,
            "ok": self.ok(),
            "verdict": self.verdict,
            "violations": [asdict(f) for f in self.violations()],
            "constraints": [asdict(f) for f in self.constraints],
        }

    def __str__(self) -> str:
        return "\n".join([self.verdict, *(str(f) for f in self.worst_of_each())])

    def _named(self, name: str) -> Iterator[Finding]:
        return (f for f in self.constraints if f.name == name)
