"""How often the search succeeds: the paper's scenes from 15 settings each, and random scenes (docs/robustness.md)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from . import SCENES
from .criteria import shortcoming
from .processes import each

if TYPE_CHECKING:
    from mcplan.ddp import Result
    from mcplan.sweep.pool import Crash

#: First weight on the change of the inputs x first guess of the phase durations [s].
SETTINGS = tuple(
    (proximal, duration) for proximal in (10.0, 30.0, 100.0) for duration in (0.30, 0.35, 0.40, 0.45, 0.50)
)


@dataclass(frozen=True)
class Task:
    """One solve: a built-in scene with a setting, or (scene empty) a random scene with the defaults."""

    scene: str = ""
    proximal_weight: float = 0.0
    duration_initial_s: float = 0.0
    seed: int = 0
    robot: str = "humanoid44"
    time_limit_s: float | None = None
    model: str = ""  # of the contact forces; empty: the planner's default


@dataclass(frozen=True)
class Outcome:
    """How one solve went. `reason` says what was wrong unless it is `good`."""

    task: Task
    scene: str
    kind: str
    status: str
    good: bool
    reason: str
    worst: str
    worst_value: float
    cost: float
    iterations: int
    switches: int
    time_s: float

    def row(self) -> dict[str, Any]:
        """As a row of a table."""
        row = asdict(self)
        task = row.pop("task")
        return {name: task[name] for name in ("seed", "proximal_weight", "duration_initial_s")} | row


def setting_tasks(scenes: Sequence[str] = SCENES, **options: Any) -> list[Task]:
    """The 15 settings on each scene."""
    return [
        Task(scene=scene, proximal_weight=proximal, duration_initial_s=duration, **options)
        for scene in scenes
        for proximal, duration in SETTINGS
    ]


def random_tasks(count: int, seed: int = 0, **options: Any) -> list[Task]:
    """`count` random scenes, of seeds seed, seed + 1, ..."""
    return [Task(seed=seed + i, **options) for i in range(count)]


def run(tasks: Sequence[Task], jobs: int = 1, progress: Callable[[str], None] | None = None) -> list[Outcome]:
    """Solve all tasks, one thread each.

    Args:
        tasks: What to solve.
        jobs: Processes to use; 1: this one.
        progress: Called with a line for each task that is done.

    Returns:
        Outcomes in the order of the tasks, whatever the number of processes.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed during a solve.
    """
    outcomes: dict[int, Outcome] = {}
    for index, outcome in each(solve, tasks, jobs, crashed):
        outcomes[index] = outcome
        if progress is not None:
            progress(f"[{len(outcomes)}/{len(tasks)}] {line(outcome)}")
    return [outcomes[i] for i in range(len(tasks))]


def solve(task: Task) -> Outcome:
    """Solve one task and judge the plan."""
    import mcplan
    from mcplan.files.generate import KINDS, random_scene

    options: dict[str, Any] = {}
    if task.time_limit_s is not None:
        options["time_limit_s"] = task.time_limit_s
    if task.model:
        options["model"] = task.model
    if task.scene:
        scene, kind = mcplan.load_scene(task.scene), task.scene
        options |= {"proximal_weight": task.proximal_weight, "duration_initial_s": task.duration_initial_s}
    else:
        scene, kind = random_scene(task.seed), KINDS[task.seed % len(KINDS)]
    result = mcplan.plan(scene, mcplan.load_robot(task.robot), **options)
    return judge(task, kind, result)


def judge(task: Task, kind: str, result: Result) -> Outcome:
    """Whether the plan is good: solved, again accepted by the checker, and what the scene is about."""
    import mcplan

    plan, report = result.plan, result.report
    status, worst = str(report.status), report.worst_violation
    if status != "solved":
        reason = str(worst) if worst.name else report.message
    else:
        again = mcplan.check(plan, plan.scene, plan.robot)
        reason = shortcoming(task.scene, plan) if again.ok() else f"called solved, but: {again.worst()}"
    return Outcome(
        task=task,
        scene=plan.scene.name,
        kind=kind,
        status=status,
        good=status == "solved" and not reason,
        reason=reason,
        worst=worst.name,
        worst_value=worst.value,
        cost=report.cost,
        iterations=report.iterations,
        switches=report.switches,
        time_s=report.time_s,
    )


def crashed(task: Task, crash: Crash) -> Outcome:
    """The outcome of a task that killed its processes."""
    from mcplan.files.generate import KINDS

    kind = task.scene or KINDS[task.seed % len(KINDS)]
    scene = task.scene or f"random_{kind}_{task.seed}"
    nan = float("nan")
    return Outcome(task, scene, kind, "crashed", False, str(crash), "", nan, nan, 0, 0, nan)


def line(outcome: Outcome) -> str:
    """An outcome on one line, with what is needed to repeat it."""
    task = outcome.task
    what = (
        f"{task.scene} proximal_weight={task.proximal_weight:g} duration_initial_s={task.duration_initial_s:g}"
        if task.scene
        else f"{outcome.scene} seed={task.seed}"
    )
    head = (
        f"{what}: {outcome.status} in {outcome.time_s:.2f} s, {outcome.iterations} iterations, cost {outcome.cost:.3g}"
    )
    return head if outcome.good else f"{head}, NOT GOOD: {outcome.reason}"


def summary(outcomes: Iterable[Outcome]) -> list[dict[str, Any]]:
    """A row per kind: how many, how many good, statuses, median cost of the good ones and time of all."""
    import numpy as np

    rows = []
    by_kind: dict[str, list[Outcome]] = {}
    for outcome in outcomes:
        by_kind.setdefault(outcome.kind, []).append(outcome)
    for kind, group in by_kind.items():
        good = [outcome for outcome in group if outcome.good]
        times = [outcome.time_s for outcome in group if outcome.status != "crashed"] or [float("nan")]
        rows.append(
            {
                "kind": kind,
                "runs": len(group),
                "good": len(good),
                "statuses": dict(sorted(Counter(outcome.status for outcome in group).items())),
                "median_cost": float(np.median([outcome.cost for outcome in good])) if good else float("nan"),
                "median_time_s": float(np.median(times)),
                "largest_time_s": max(times),
            }
        )
    return rows
