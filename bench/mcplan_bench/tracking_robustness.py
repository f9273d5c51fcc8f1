"""Which disturbed runs stay upright: mass, friction, height of the ground, a push, motors and sensors drawn from seeds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from .processes import each
from .tracking import TRACKED, plan_of, track_plan
from .tracking_cases import DISTURBED, SURVIVING, Case

if TYPE_CHECKING:
    from mcplan import Plan


@dataclass(frozen=True)
class Task:
    """A plan of a case, to be tracked with the disturbances of a seed."""

    case: Case
    plan: Plan
    seed: int


@dataclass(frozen=True)
class Outcome:
    """A disturbed run: what was drawn, and what came of it."""

    case: str
    seed: int
    mass_scale: float
    friction_scale: float
    ground_shift_m: float
    push_N: float
    push_at_s: float
    push_direction_deg: float
    torque_delay_s: float
    torque_bandwidth_hz: float
    sensor_noise: float
    fell: bool
    completed_s: float
    com_rms_m: float
    final_base_error_m: float
    qp_failures: int
    simulator_warnings: int

    def as_dict(self) -> dict[str, Any]:
        """By name, for JSON and CSV."""
        return asdict(self)


def run(
    seeds: int, jobs: int = 1, progress: Callable[[str], None] | None = None, cases: Sequence[Case] = DISTURBED
) -> list[Outcome]:
    """Plan each case once, and track it with the disturbances of seeds 1 to `seeds`.

    Args:
        seeds: Number of runs of each case.
        jobs: Processes.
        progress: Called with a line for each plan and run that is done.
        cases: What to track; one without a plan within its constraints gives no outcomes.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed.
    """
    say = progress or (lambda _: None)
    tasks = []
    for case in cases:
        found = plan_of(case)
        say(f"{case.name}: {found.status} in {found.time_s:.1f} s")
        if found.status in TRACKED:
            tasks += [Task(case, found.plan, seed) for seed in range(1, seeds + 1)]  # type: ignore[arg-type]
    outcomes: dict[int, Outcome] = {}
    for index, outcome in each(solve, tasks, jobs):
        outcomes[index] = outcome
        say(f"[{len(outcomes)}/{len(tasks)}] {line(outcome)}")
    return [outcomes[i] for i in range(len(tasks))]


def solve(task: Task) -> Outcome:
    """Track a plan with the disturbances of a seed."""
    from mcplan.tracking import Options

    result: Any = track_plan(task.case, task.plan, Options(seed=task.seed, assist=task.case.assist))
    drawn, measures = result.options, result.measures
    push = drawn.pushes[-1]
    return Outcome(
        case=task.case.name,
        seed=task.seed,
        mass_scale=drawn.mass_scale,
        friction_scale=drawn.friction_scale,
        ground_shift_m=drawn.ground_shift_m,
        push_N=push.force_N,
        push_at_s=push.at_s,
        push_direction_deg=push.direction_deg,
        torque_delay_s=drawn.torque_delay_s,
        torque_bandwidth_hz=drawn.torque_bandwidth_hz,
        sensor_noise=drawn.sensor_noise,
        fell=measures.fell,
        completed_s=measures.completed_s,
        com_rms_m=measures.com_rms_m,
        final_base_error_m=measures.final_base_error_m,
        qp_failures=measures.qp_failures,
        simulator_warnings=measures.simulator_warnings,
    )


def summary(outcomes: Sequence[Outcome], cases: Sequence[Case] = DISTURBED) -> list[dict[str, Any]]:
    """A row per case: runs, those that stayed upright, whether they are enough, seeds that fell, largest error of the CoM.

    A case without runs fails.
    """
    rows = []
    for case in cases:
        group = [outcome for outcome in outcomes if outcome.case == case.name]
        upright = [outcome for outcome in group if not outcome.fell]
        rows.append(
            {
                "case": case.name,
                "runs": len(group),
                "survived": len(upright),
                "holds": bool(group) and len(upright) >= SURVIVING * len(group),
                "fell": [outcome.seed for outcome in group if outcome.fell],
                "largest_com_rms_m": max((outcome.com_rms_m for outcome in upright), default=None),
                "qp_failures": sum(outcome.qp_failures for outcome in group),
                "simulator_warnings": sum(outcome.simulator_warnings for outcome in group),
            }
        )
    return rows


def line(outcome: Outcome) -> str:
    """A run with what was drawn for it, on one line."""
    drawn = (
        f"mass x {outcome.mass_scale:.3f}, friction x {outcome.friction_scale:.3f}, "
        f"ground {1e3 * outcome.ground_shift_m:+.1f} mm, push {outcome.push_N:.0f} N at {outcome.push_at_s:.2f} s "
        f"towards {outcome.push_direction_deg:.0f} deg, torques {1e3 * outcome.torque_delay_s:.1f} ms late and of "
        f"{outcome.torque_bandwidth_hz:.0f} Hz, sensor noise x {outcome.sensor_noise:.2f}"
    )
    end = f"FELL at {outcome.completed_s:.2f} s" if outcome.fell else f"CoM {1e3 * outcome.com_rms_m:.1f} mm rms"
    return f"{outcome.case} seed {outcome.seed}: {end} ({drawn})"
