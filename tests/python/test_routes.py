"""Walks that a person would call right: steps where one can step, ways round what one cannot cross."""

from __future__ import annotations

import json

import numpy as np
import pytest

import mcplan as mp
from mcplan.cli import main


def patch(
    name: str, x: tuple[float, float], y: tuple[float, float], z: float = 0.0, who: str = "foot"
) -> mp.model.Surface:
    corners = [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
    return mp.model.Surface(name=name, vertices_W=corners, end_effectors=[who])


def scene(surfaces: list[mp.model.Surface], goal: list[float], on: str = "") -> mp.Scene:
    out = mp.Scene(name="walk")
    out.surfaces = surfaces
    out.start.contacts = {"foot": surfaces[0].name}
    out.goal.contacts = {"foot": on or surfaces[0].name}
    out.goal.position_W = goal
    return out


def solid(name: str, x: tuple[float, float], y: tuple[float, float], top: float, thickness: float) -> mp.model.Surface:
    out = patch(name, x, y, top, "right_hand")
    out.thickness = thickness
    return out


def flights(plan: mp.Plan) -> int:
    return sum(all(contact.surface < 0 for contact in phase.contacts) for phase in plan.phases)


def com_path(plan: mp.Plan) -> np.ndarray:
    return np.array([plan.at(t).com_W for t in np.linspace(0.0, plan.duration(), 2000)])


def floor(half: float = 3.0) -> mp.model.Surface:
    return patch("floor", (-half, half), (-half, half))


def with_hole(bridge_at: float | None) -> mp.Scene:
    floors = [patch("here", (-1.0, 0.5), (-2.0, 2.0)), patch("there", (1.9, 3.5), (-2.0, 2.0))]
    if bridge_at is not None:
        floors.append(patch("bridge", (0.5, 1.9), (bridge_at - 0.3, bridge_at + 0.3)))
    return scene(floors, [2.4, 0.0, 0.0], "there")


@pytest.mark.parametrize("robot", ["humanoid44", "talos", "g1"])
@pytest.mark.parametrize("goal", [[0.0, 0.6, 0.0], [0.3, -0.9, 0.0]])
def test_a_goal_to_the_side_is_reached_by_side_steps(robot, goal):
    result = mp.plan(scene([floor()], goal), robot)
    assert str(result.report.status) == "solved" and flights(result.plan) == 0
    assert result.report.cost < 0.4


@pytest.mark.parametrize("bridge", [0.8, -0.6])
def test_a_hole_is_passed_over_the_bridge_beside_it(bridge):
    straight = mp.plan(with_hole(bridge), detours=False)
    walk = mp.plan(with_hole(bridge))
    assert str(walk.report.status) == "solved" and flights(walk.plan) == 0
    # A jump costs more; where the search finds the bridge by itself, its plan was among those to choose from.
    assert walk.report.cost <= (0.5 if flights(straight.plan) else 1.0) * straight.report.cost
    over = com_path(walk.plan)
    over = over[(over[:, 0] > 0.8) & (over[:, 0] < 1.6)]
    assert np.abs(over[:, 1] - bridge).max() < 0.45
    index = [s.name for s in walk.plan.scene.surfaces].index("bridge")
    assert any(contact.surface == index for phase in walk.plan.phases for contact in phase.contacts)


def test_a_post_is_walked_round_and_no_plan_goes_through_it():
    where = scene([floor(), solid("post", (0.9, 1.0), (-0.05, 0.05), 1.6, 1.6)], [2.0, 0.0, 0.0])
    result = mp.plan(where)
    assert str(result.report.status) == "solved", result.report.message
    path = com_path(result.plan)[:, :2]
    nearest = np.clip(path, [0.9, -0.05], [1.0, 0.05])
    assert np.linalg.norm(path - nearest, axis=1).min() > 0.1 * 0.7
    # The way as it is without the post leads through it, and the checker says so.
    through = mp.plan(scene([floor()], [2.0, 0.0, 0.0])).plan
    through.scene = where
    assert {"trunk"} <= {found.name for found in mp.check(through, where).violations()}


def test_legs_do_not_walk_through_a_fence():
    fence = solid("fence", (0.9, 1.0), (-3.0, 3.0), 0.6, 0.35)
    result = mp.plan(scene([floor(), fence], [2.0, 0.0, 0.0]), restarts=0)
    assert str(result.report.status) != "solved"
    through = mp.plan(scene([floor()], [2.0, 0.0, 0.0])).plan
    through.scene = scene([floor(), fence], [2.0, 0.0, 0.0])
    found = {violation.name for violation in mp.check(through, through.scene).violations()}
    assert "limb" in found and "trunk" not in found


@pytest.mark.parametrize(
    ("handles", "height"),
    [
        (True, 0.25),
        (False, 0.3),
        *[pytest.param(handles, height, marks=pytest.mark.slow) for handles, height in ((True, 0.3), (False, 0.25))],
    ],
)
def test_a_high_step_is_climbed_beside_handles_and_beside_tables(height, handles):
    low, high = patch("low", (-1.0, 0.3), (-1.0, 1.0)), patch("high", (0.3, 2.5), (-1.0, 1.0), height)
    high.thickness = height
    where = scene([low, high], [0.9, 0.0, height], "high")
    outer, thickness = (0.32, 0.02) if handles else (0.55, 0.04)
    for side, hand in ((-1, "right_hand"), (1, "left_hand")):
        beside = patch(f"beside_{hand}", (0.2, 0.8), tuple(sorted((side * 0.24, side * outer))), 0.85, hand)
        beside.thickness, beside.grasp = thickness, handles
        where.surfaces = [*where.surfaces, beside]
    result = mp.plan(where)
    assert str(result.report.status) == "solved", result.report.message


def test_four_legs_climb_stairs_with_two_feet_down():
    treads = [patch("ground", (-1.2, 0.45), (-1.0, 1.0))]
    for k in range(1, 4):
        treads.append(
            patch(f"tread_{k}", (0.45 + 0.36 * (k - 1), 0.45 + 0.36 * k if k < 3 else 4.0), (-1.0, 1.0), 0.09 * k)
        )
        treads[-1].thickness = 0.09
    result = mp.plan(scene(treads, [2.0, 0.0, 0.27], "tread_3"), "anymal")
    assert str(result.report.status) == "solved", result.report.message
    assert min(sum(contact.surface >= 0 for contact in phase.contacts) for phase in result.plan.phases) >= 2


def test_a_jump_that_is_needed_is_made_and_without_flights_refused_by_name(tmp_path, capsys):
    gap = with_hole(None)
    gap.surfaces = [gap.surfaces[0], patch("there", (1.3, 3.5), (-2.0, 2.0))]
    assert flights(mp.plan(gap).plan) == 1
    result = mp.plan(gap, allow_flight=False)
    assert str(result.report.status) == "infeasible" and result.report.iterations == 0
    assert "flights are not allowed" in result.report.message
    file = tmp_path / "gap.toml"
    mp.files.scenes.save_scene(gap, file)
    assert main(["plan", str(file), "--no-flight", "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["status"] == "infeasible"


def test_more_contacts_than_stand_are_refused_by_name():
    with pytest.raises(
        mp.errors.InvalidOptions,
        match="min_contacts: must be at most the number of contacts at start and goal, 2, got 3",
    ):
        mp.plan("flat", min_contacts=3)
    with pytest.raises(mp.errors.InvalidOptions, match="min_contacts"):
        mp.plan("flat", min_contacts=-2)


def test_nothing_more_is_tried_once_the_caller_has_stopped_the_search():
    lines: list[str] = []

    def stop_after_the_first_way(level: str, line: str) -> None:
        lines.append(line)
        if "phases: " in line:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        mp.plan(with_hole(0.8), logger=stop_after_the_first_way)
    assert sum("phases: " in line for line in lines) == 1


def test_no_flight_is_planned_where_none_is_allowed_and_the_same_input_gives_the_same_plan():
    one, other = (mp.plan("flat", allow_flight=False, record_history=True, threads=threads) for threads in (1, 2))
    assert one.plan == other.plan and flights(one.plan) == 0
    for iteration in one.report.history:
        assert all(any(contact >= 0 for contact in state) for state in iteration.sequence)


def test_the_logger_hears_of_every_way_that_was_tried():
    lines: list[str] = []
    mp.plan(with_hole(0.8), logger=lambda level, line: lines.append(line))
    ways = [line for line in lines if "phases: " in line]
    assert any("by way of (" in line and "cost" in line for line in ways)
    assert any(line.startswith("straight on") for line in ways)


@pytest.mark.slow
def test_the_contact_sequence_of_a_plan_that_went_round_is_drawn_from_its_own_iterations(tmp_path):
    from mcplan.showing import save_plots
    from mcplan.view.plots.report import sequences_by_switches

    result = mp.plan(with_hole(0.8), record_history=True)
    lengths = {len(row.sequence) for row in result.report.history}
    assert len(lengths) > 1
    edges, grid = sequences_by_switches(result.report, len(result.plan.phases))
    assert grid.shape[1] == len(result.plan.phases) + 1 and len(edges) == grid.shape[0] + 1
    assert sequences_by_switches(result.report)[1].shape[1] == len(result.report.history[-1].sequence)
    names = {path.name for path in save_plots(result.plan, result.report, tmp_path)}
    assert "contact_sequence.png" in names
