"""What a search goes on to after its first attempt, on random scenes that were once solved badly."""

from __future__ import annotations

import mcplan as mp
from mcplan.files.solvable_scenes import solvable_scene


def _solved(seed: int, robot_name: str, **options: object) -> tuple[mp.PlanResult, list[str]]:
    robot = mp.load_robot(robot_name)
    lines: list[str] = []
    result = mp.plan(solvable_scene(seed, robot), robot, logger=lambda _, line: lines.append(line), **options)
    assert result.report.status == mp.Status.solved
    assert mp.check(result.plan).ok()
    return result, [line for line in lines if line.startswith("plan of")]


def _flights(plan: mp.Plan) -> int:
    return sum(all(contact.surface < 0 for contact in phase.contacts) for phase in plan.phases)


def test_a_near_miss_is_mended_at_once_and_hardly_dearer() -> None:
    """Restarts used to follow, for 6 s, and a plan at ten times the cost."""
    result, verdicts = _solved(20007, "talos", stepping_guesses=False)
    assert "violates" in verdicts[0] and "accepted" in verdicts[1]
    costs = [float(line.split()[3].rstrip(":")) for line in verdicts]
    assert costs[0] <= costs[1] <= 1.25 * costs[0]
    assert result.report.cost <= costs[1] + 1e-9


def test_a_walk_that_strains_is_planned_in_more_phases_too() -> None:
    """In 22 phases steps are as long as the legs allow, and cost twenty times as much."""
    result, _ = _solved(20113, "g1", stepping_guesses=False)
    few, _ = _solved(20113, "g1", phases=22, stepping_guesses=False)
    assert len(result.plan.phases) > 22
    assert result.report.cost < 0.1 * few.report.cost


def test_a_moment_of_high_cost_is_no_reason_to_give_a_guess_up() -> None:
    """The walk was given up at 0.37 on its way to 0.146, and one at 0.391 was left, after one with a flight."""
    result, _ = _solved(20045, "humanoid44")
    penalty, _ = _solved(20045, "humanoid44", polish="penalty")
    assert _flights(result.plan) == 0
    assert result.report.cost < penalty.report.cost


def test_where_one_jump_is_enough_there_is_one() -> None:
    """There were two, at twice the cost, where the interior point was left alone."""
    result, _ = _solved(20163, "humanoid44")
    assert _flights(result.plan) == 1


def test_a_near_miss_of_a_restart_is_mended() -> None:
    """A platform of 0.15 m, at first through its edge; what the penalty left beyond reach came to 2.65 in 2.8 s."""
    corners = [[-2.0, -2.0, 0.0], [0.4, -2.0, 0.0], [0.4, 2.0, 0.0], [-2.0, 2.0, 0.0]]
    floor = mp.model.Surface(name="floor", vertices_W=corners, end_effectors=["foot"])
    up = mp.model.Surface(
        name="platform",
        vertices_W=[[0.4, -2.0, 0.15], [3.0, -2.0, 0.15], [3.0, 2.0, 0.15], [0.4, 2.0, 0.15]],
        end_effectors=["foot"],
    )
    up.thickness = 0.15
    scene = mp.Scene(
        surfaces=[floor, up],
        start=mp.model.Stance(contacts={"foot": "floor"}),
        goal=mp.model.Stance(position_W=[1.2, 0.0, 0.15], contacts={"foot": "platform"}),
    )
    lines: list[str] = []
    result = mp.plan(scene, "g1", stepping_guesses=False, logger=lambda _, line: lines.append(line))
    assert result.report.status == mp.Status.solved and mp.check(result.plan).ok()
    assert result.report.cost < 0.5
    assert "violates clearance" in next(line for line in lines if line.startswith("plan of"))


def test_a_surface_that_is_nearly_level_is_none_that_moments_turn_about() -> None:
    """One patch is tilted by 4e-5 rad: moments about the vertical had 2e-6 N m beside its normal."""
    result, _ = _solved(814, "humanoid44")
    assert result.report.cost < 0.1
