"""mcplan_bench.robustness: tasks, judging and counting."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

import mcplan as mp
from mcplan_bench import robustness as bench
from standing import standing_plan


def outcome(kind: str, good: bool, status: str = "solved", cost: float = 1.0) -> bench.Outcome:
    return bench.Outcome(
        bench.Task(seed=7), "s", kind, status, good, "" if good else "why", "reach", 0.1, cost, 5, 2, 0.5
    )


def test_there_are_fifteen_settings_a_scene():
    tasks = bench.setting_tasks(["flat", "gap"])
    assert len(tasks) == len(set(tasks)) == 30
    assert {(t.proximal_weight, t.duration_initial_s) for t in tasks if t.scene == "gap"} == set(bench.SETTINGS)
    assert len(set(bench.SETTINGS)) == 15


def test_random_tasks_take_consecutive_seeds():
    assert [task.seed for task in bench.random_tasks(3, 40)] == [40, 41, 42]


def test_kinds_are_counted_apart():
    outcomes = [
        outcome("gap", True, cost=1.0),
        outcome("gap", True, cost=3.0),
        outcome("gap", False, "infeasible", 99.0),
    ]
    first, second = bench.summary([*outcomes, outcome("slope", False, "time_limit")])
    assert first["kind"] == "gap" and (first["good"], first["runs"]) == (2, 3)
    assert first["statuses"] == {"infeasible": 1, "solved": 2}
    assert first["median_cost"] == 2.0  # of the good ones
    assert (second["good"], second["runs"], second["statuses"]) == (0, 1, {"time_limit": 1})


def test_a_failure_names_its_seed_and_its_reason():
    assert "seed=7" in bench.line(outcome("gap", False)) and "NOT GOOD: why" in bench.line(outcome("gap", False))
    assert "NOT GOOD" not in bench.line(outcome("gap", True))


def test_a_plan_that_is_called_solved_is_checked_again():
    report = SimpleNamespace(
        status=mp.Status.solved,
        worst_violation=mp.model.Violation(),
        message="",
        cost=1.0,
        iterations=1,
        switches=0,
        time_s=0.1,
    )
    result = SimpleNamespace(plan=standing_plan(), report=report)
    assert bench.judge(bench.Task(), "slope", result).good
    # Nobody carries the robot any more: what was said about the plan is wrong.
    plan = standing_plan()
    plan.phases = [
        mp.model.Phase(duration=p.duration, contacts=[mp.model.Contact() for _ in p.contacts]) for p in plan.phases
    ]
    result.plan = plan
    judged = bench.judge(bench.Task(), "slope", result)
    assert not judged.good and judged.reason.startswith("called solved, but: ")


def test_a_scene_gives_the_same_outcome_again():
    first, again = (bench.solve(bench.Task(seed=3)) for _ in range(2))
    assert (first.status, first.cost, first.iterations) == (again.status, again.cost, again.iterations)
    assert first.kind == "slope" and first.scene == "random_slope_3"


def test_processes_do_not_change_the_outcomes():
    tasks = bench.random_tasks(2, 3)
    lines: list[str] = []
    alone, together = bench.run(tasks, progress=lines.append), bench.run(tasks, jobs=2)
    assert len(lines) == 2 and lines[-1].startswith("[2/2] ")
    assert [(o.task, o.status, o.cost) for o in alone] == [(o.task, o.status, o.cost) for o in together]


@pytest.mark.slow
def test_most_settings_and_random_scenes_succeed():
    settings = bench.summary(bench.run(bench.setting_tasks()))
    assert {row["kind"]: row["good"] >= 14 for row in settings} == dict.fromkeys(bench.SCENES, True)
    outcomes = bench.run(bench.random_tasks(100))
    assert sum(o.good for o in outcomes) >= 90, [bench.line(o) for o in outcomes if not o.good]
