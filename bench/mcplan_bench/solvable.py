"""How many random solvable scenes ddp solves, and whether an independent replay of each plan agrees."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from mcplan.files.solvable_scenes import FRICTION, kind_of, solvable_scene

from .contact_measures import measure_contacts
from .processes import each

if TYPE_CHECKING:
    from mcplan import Plan, Robot
    from mcplan.sweep.pool import Crash

#: Robots by turns of five.
ROBOTS = ("humanoid44", "humanoid44", "talos", "humanoid44", "g1")

#: What a replay may differ by, and what contacts may ask for: field of ContactMeasures or of its replay, and the most.
_REPLAY = (("com_m", 1e-9), ("velocity_m_s", 1e-8), ("momentum_Nms", 1e-8), ("orientation_deg", 1.0))
_CONTACTS = (
    ("tangent_circle", FRICTION + 0.02),
    ("pull_N", 0.0),
    ("pressure_off_sole_m", 1e-3),
    ("pressure_off_surface_m", 1e-3),
    ("slip_m", 1e-3),
    ("reach_m", 5e-3),
    ("swing_stiffness", 5e-4),
)


@dataclass(frozen=True)
class Task:
    """A scene to plan, by its seed and robot."""

    seed: int
    robot: str


@dataclass(frozen=True)
class Outcome:
    """What came of a task. `rejected` says what the replay of a solved plan found wrong."""

    seed: int
    robot: str
    kind: str
    status: str
    message: str
    worst: str
    cpu_s: float
    cost: float
    phases: int
    rejected: str


def tasks(count: int, seed: int = 0, robots: Sequence[str] = ROBOTS) -> list[Task]:
    """Tasks of the seeds from `seed` on; robots change every ten seeds, so that each has all kinds."""
    return [Task(k, robots[(k // 10) % len(robots)]) for k in range(seed, seed + count)]


def run(given: Sequence[Task], jobs: int = 1, progress: Callable[[str], None] | None = None) -> list[Outcome]:
    """Plan all tasks, one thread each; outcomes in their order."""
    outcomes: dict[int, Outcome] = {}
    for index, outcome in each(solve, given, jobs, crashed):
        outcomes[index] = outcome
        if progress is not None:
            progress(f"[{len(outcomes)}/{len(given)}] {line(outcome)}")
    return [outcomes[i] for i in range(len(given))]


@cache
def _robot(name: str) -> Robot:
    import mcplan

    return mcplan.load_robot(name)


def solve(task: Task) -> Outcome:
    """Plan one scene with default options, and replay what is called solved."""
    import mcplan

    robot = _robot(task.robot)
    scene = solvable_scene(task.seed, robot)
    begin = time.process_time()
    result = mcplan.plan(scene, robot)
    cpu_s = time.process_time() - begin
    report = result.report
    solved = str(report.status) == "solved"
    return Outcome(
        task.seed,
        task.robot,
        kind_of(task.seed, robot),
        str(report.status),
        "" if solved else report.message,
        "" if solved else report.worst_violation.name,
        cpu_s,
        report.cost,
        len(result.plan.phases),
        rejection(result.plan) if solved else "",
    )


def crashed(task: Task, crash: Crash) -> Outcome:
    """The outcome of a task that killed its processes."""
    kind, nan = kind_of(task.seed, _robot(task.robot)), float("nan")
    return Outcome(task.seed, task.robot, kind, "crashed", str(crash), "crash", nan, nan, 0, "")


def rejection(plan: Plan) -> str:
    """What is wrong with a plan by the checker and by the independent replay; empty: nothing."""
    import mcplan

    again = mcplan.check(plan, plan.scene, plan.robot)
    if not again.ok():
        return f"checker: {again.worst()}"
    found = measure_contacts(plan)
    wrong = [
        f"{name} {getattr(found.replay, name):.3g}" for name, most in _REPLAY if not getattr(found.replay, name) <= most
    ]
    wrong += [f"{name} {found.largest(name):.3g}" for name, most in _CONTACTS if not found.largest(name) <= most]
    return "; ".join(wrong)


def line(outcome: Outcome) -> str:
    """An outcome in a line, with what is needed to repeat it."""
    head = f"seed {outcome.seed} {outcome.robot} {outcome.kind}: {outcome.status}, {outcome.cpu_s:.2f} s of CPU"
    if outcome.status != "solved":
        return f"{head}: {outcome.message}"
    return f"{head}, J {outcome.cost:.3g}, {outcome.phases} phases" + (
        f", REJECTED: {outcome.rejected}" if outcome.rejected else ""
    )


def summary(outcomes: Iterable[Outcome]) -> list[dict[str, Any]]:
    """A row for all, for each robot and for each kind."""
    import numpy as np

    given = list(outcomes)
    groups = {"all": given}
    for key in ("robot", "kind"):
        for outcome in given:
            groups.setdefault(getattr(outcome, key), []).append(outcome)
    return [
        {
            "of": name,
            "scenes": len(group),
            "solved": sum(outcome.status == "solved" for outcome in group),
            "rejected": sum(bool(outcome.rejected) for outcome in group),
            "median_cpu_s": float(np.nanmedian([outcome.cpu_s for outcome in group])),
            "largest_cpu_s": float(np.nanmax([outcome.cpu_s for outcome in group])),
            "failures": dict(sorted(Counter(o.worst or o.status for o in group if o.status != "solved").items())),
        }
        for name, group in groups.items()
    ]


def rows(outcomes: Iterable[Outcome]) -> list[dict[str, Any]]:
    """Outcomes as rows of a table."""
    return [asdict(outcome) for outcome in outcomes]
