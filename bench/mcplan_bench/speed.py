"""How fast an iteration and a whole plan are, ours beside the paper's form, in one run on one machine.

An iteration is timed by its parts as the report splits them: linearise, value functions, pricing of neighbours, line
search. What comes once a plan (first sequence, closing the defects, the checker) is in the time of the whole plan only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import SCENES

if TYPE_CHECKING:
    from mcplan import Robot, Scene
    from mcplan.ddp import Result
    from mcplan.model import Report

#: Parts of the report's timing that belong to iterations.
PARTS = ("linearise", "value_backward", "value_forward", "value_update", "pricing", "line_search")

#: The published search, with the input that it was published with.
PAPER: dict[str, Any] = {"method": "paper", "stiffness_input": "lambda_"}


@dataclass(frozen=True)
class Iterations:
    """Times of iterations of one kind, medians over repeats."""

    count: int  # iterations in one run
    ms: float  # per iteration
    parts_ms: dict[str, float]  # the same by part
    neighbours: float  # priced per iteration
    pricing_ratio: float  # ratio of its time to the iteration's

    @property
    def pricing_us(self) -> float:
        """Time of pricing by the number of neighbours [us]."""
        return 1e3 * self.parts_ms["pricing"] / self.neighbours if self.neighbours else float("nan")


def iterations(scene: Scene, robot: Robot, repeats: int, options: dict[str, Any]) -> tuple[Iterations, list[Result]]:
    """Time the iterations of a solve, `repeats` times.

    Returns:
        Medians, and the results of all repeats.
    """
    import mcplan

    results = [mcplan.plan(scene, robot, **options) for _ in range(repeats)]
    parts = [iteration_parts_ms(result.report) for result in results]
    medians = {name: float(np.median([each[name] for each in parts])) for name in PARTS}
    report = results[0].report
    count = max(report.iterations, 1)
    timing = Iterations(
        count=count,
        ms=float(np.median([sum(each.values()) for each in parts])),
        parts_ms=medians,
        neighbours=sum(row.neighbours for row in report.history) / count,
        pricing_ratio=float(np.median([each["pricing"] / max(sum(each.values()), 1e-12) for each in parts])),
    )
    return timing, results


def iteration_parts_ms(report: Report) -> dict[str, float]:
    """Average time per iteration by part [ms]."""
    return {name: 1e3 * report.timing_s.get(name, 0.0) / max(report.iterations, 1) for name in PARTS}


def searching_iterations(report: Report) -> int:
    """How many iterations at the beginning of a solve priced neighbours: those that the paper's iteration compares to.

    Later ones polish with the sequence frozen and are cheaper.
    """
    count = 0
    for row in report.history:
        if row.neighbours == 0:
            break
        count += 1
    return max(count, 1)


def compare(
    names: Sequence[str] = SCENES,
    robot: str = "humanoid44",
    repeats: int = 7,
    threads: int = 1,
    progress: Callable[[str], None] | None = None,
) -> list[dict[str, Any]]:
    """Ours against the paper's form: a row per scene.

    Args:
        names: Scenes.
        robot: Built-in name or file.
        repeats: Solves behind each median.
        threads: Of our search; the paper's form runs on one.
        progress: Called with a line for each scene.
    """
    import mcplan

    model = mcplan.load_robot(robot)
    rows = []
    for name in names:
        scene = mcplan.load_scene(name)
        ours = {"threads": threads}
        whole, plans = iterations(scene, model, repeats, ours)
        first = searching_iterations(plans[0].report)
        search, _ = iterations(scene, model, repeats, ours | {"max_iterations": first, "restarts": 0})
        paper, paper_plans = iterations(scene, model, repeats, PAPER)
        rows.append(
            {
                "scene": name,
                "status": str(plans[0].report.status),
                "iteration_ms": search.ms,
                "iteration_all_ms": whole.ms,
                "iterations": whole.count,
                "searching_iterations": first,
                "neighbours": search.neighbours,
                "pricing_us": search.pricing_us,
                "pricing_ratio": search.pricing_ratio,
                "pricing_ratio_all": whole.pricing_ratio,
                "plan_ms": _whole_ms(plans),
                "paper_status": str(paper_plans[0].report.status),
                "paper_iteration_ms": paper.ms,
                "paper_iterations": paper.count,
                "paper_neighbours": paper.neighbours,
                "paper_pricing_us": paper.pricing_us,
                "paper_pricing_ratio": paper.pricing_ratio,
                "paper_plan_ms": _whole_ms(paper_plans),
                "ratio": paper.ms / search.ms,
                "ratio_all": paper.ms / whole.ms,
            }
            | {f"{part}_ms": search.parts_ms[part] for part in PARTS}
            | {f"paper_{part}_ms": paper.parts_ms[part] for part in PARTS}
        )
        if progress is not None:
            progress(f"{name}: ours {search.ms:.3f} ms, paper {paper.ms:.3f} ms per iteration")
    return rows


def _whole_ms(results: Sequence[Result]) -> float:
    return 1e3 * float(np.median([result.report.time_s for result in results]))
