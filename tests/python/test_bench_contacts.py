"""mcplan_bench.contacts: what is planned, what rows say and what they have to hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench import contacts as bench
from mcplan_bench.contact_measures import measure_contacts
from mcplan_bench.contacts_cases import CASES, RAIL, SETTINGS, Case, Demand, setting_cases
from mcplan_bench.contacts_text import BEGIN, END, markdown, sections
from wrench_plans import RIGHT_HAND, hanging_plan, leaning_plan, with_contact

#: A plan that holds everything that is demanded on the rail.
GOOD = bench.Row("gap_with_rail", "gap_with_rail", "humanoid44", "wrench", status="solved", time_s=0.5, cost=0.2)
GOOD = replace(GOOD, tangent_foot=0.6, tangent_hand=0.7, peak_foot=1.0, peak_hand=0.63, hand_mean_low=0.49)
GOOD = replace(
    GOOD, hand_mean_high=0.51, pressure_off_sole_m=9e-4, pressure_off_surface_m=0.0, slip_m=0.0, reach_m=4e-3
)
GOOD = replace(
    GOOD, swing_stiffness=0.0, momentum_Nms=8.7, flights=0, hands_only=1, alternate=False, com_replay_m=1e-12
)
GOOD = replace(GOOD, momentum_replay_Nms=1e-11, orientation_deg=0.01, holds=True)
FLAT = next(case for case in CASES if case.name == "flat")
MACHINE = {"cpu": "A processor", "cores": 2, "version": "0.1.0", "python": "3.11", "date": "2026-11-21"}


def test_the_cases_have_what_is_demanded():
    names = [case.name for case in CASES]
    assert len(set(names)) == len(names)
    paper = {case.name: case.demand for case in CASES if case.name in ("flat", "stairs", "gap", "gap_with_rail")}
    assert {name: demand.cost for name, demand in paper.items()} == {
        "flat": 0.05,
        "stairs": 0.03,
        "gap": 0.95,
        "gap_with_rail": np.inf,
    }
    for demand in paper.values():
        assert (demand.tangent, demand.pressure_m, demand.slip_m, demand.reach_m) == (0.70, 1e-3, 2e-4, 5e-3)
        assert (demand.swing_stiffness, demand.momentum_Nms) == (5e-4, 10.0)
    assert paper["flat"].alternate and paper["stairs"].every_surface and paper["gap"].flights == 1
    assert (RAIL.demand.hands_only, RAIL.demand.hand_peak, RAIL.demand.hand_mean_off) == (True, 0.75, 0.05)
    for name in ("slope", "stepping_stones", "gap_with_wall", "chimney", "turn", "turn_jump", "flat/anymal"):
        case = next(case for case in CASES if case.name == name)
        assert case.demand.solved and case.demand.orientation_deg == 1.0
    assert [case.name for case in CASES if case.demand.solved is False] == ["gap_with_rail, no offset"]
    assert {case.name for case in CASES if case.demand.hands_only is False} == {
        "gap_with_rail/talos",
        "gap_with_rail/talos, no rule",
    }


def test_there_are_sixteen_settings_with_both_inputs():
    cases = setting_cases()
    assert len(cases) == len(set(SETTINGS)) == 16
    assert {case.demand for case in cases} == {RAIL.demand}
    assert {case.planning["stiffness_input"] for case in cases} == {"mu", "lambda_"}


def test_a_case_is_a_scene_without_grasps_and_a_robot_with_caps():
    scene = bench.scene_of(RAIL)
    assert all(surface.friction == 0.7 and not surface.grasp for surface in scene.surfaces) and len(scene.rules) == 1
    own = [(surface.friction, surface.grasp) for surface in mp.load_scene("gap_with_rail").surfaces]
    assert [(s.friction, s.grasp) for s in bench.scene_of(Case("x", "gap_with_rail")).surfaces] == own
    assert len(bench.scene_of(replace(RAIL, rules=False)).rules) == 0
    robot = bench.robot_of(Case("x", "flat", robot="talos", hand_cap=0.10), 9.8)
    for end in robot.end_effectors:
        most = 0.10 * robot.mass * 9.8
        assert end.max_force <= most * (1.0 + 1e-12) if end.kind == "hand" else end.max_force > most


def test_a_good_row_holds_and_each_limit_is_one():
    assert bench.shortfalls(GOOD, RAIL.demand) == []
    for name, value, words in (
        ("tangent_hand", 0.701, "of a hand 0.701, at most 0.7"),
        ("tangent_foot", 0.71, "of a foot 0.71, at most 0.7"),
        ("pressure_off_sole_m", 0.0011, "beyond the sole"),
        ("pressure_off_surface_m", 0.0011, "off the surface"),
        ("slip_m", 3e-4, "slip"),
        ("reach_m", 6e-3, "reach"),
        ("swing_stiffness", 6e-4, "swinging"),
        ("momentum_Nms", 10.1, "angular momentum [N m s] 10.1, at most 10"),
        ("peak_hand", 0.76, "force of a hand"),
        ("com_replay_m", 2e-9, "replayed CoM"),
        ("momentum_replay_Nms", 2e-9, "replayed angular momentum"),
        ("orientation_deg", 1.1, "replayed base"),
        ("hands_only", 0, "no phase on hands alone"),
        ("flights", 1, "1 flights, not 0"),
        ("hand_mean_high", 0.53, "0.490 to 0.530 of the weight"),
    ):
        found = bench.shortfalls(replace(GOOD, **{name: value}), RAIL.demand)
        assert len(found) == 1 and words in found[0], (name, found)
    unsolved = replace(GOOD, status="infeasible", message="reach")
    assert bench.shortfalls(unsolved, RAIL.demand) == ["infeasible: reach"]
    # Not a number is not within a limit.
    assert bench.shortfalls(replace(GOOD, slip_m=float("nan")), RAIL.demand)


def test_a_plan_that_must_fail_and_one_that_must_not_claim_hands():
    assert bench.shortfalls(GOOD, Demand(solved=False)) == ["is solved, with J 0.2"]
    assert bench.shortfalls(replace(GOOD, status="infeasible"), Demand(solved=False)) == []
    honest = Demand(solved=None, hands_only=False)
    assert bench.shortfalls(GOOD, honest) == ["claims a phase on hands alone"]
    assert bench.shortfalls(replace(GOOD, status="acceptable"), honest) == ["claims a phase on hands alone"]
    assert bench.shortfalls(replace(GOOD, hands_only=0), honest) == []
    assert bench.shortfalls(replace(GOOD, status="infeasible"), honest) == []


def test_cost_order_of_feet_and_treads_are_demanded_where_they_matter():
    row = replace(GOOD, cost=0.051, alternate=True, missed="tread_2")
    assert bench.shortfalls(row, FLAT.demand) == ["J 0.051, at most 0.05"]
    assert bench.shortfalls(replace(row, cost=0.05, alternate=False), FLAT.demand) == ["feet do not alternate"]
    stairs = next(case for case in CASES if case.name == "stairs").demand
    assert bench.shortfalls(replace(row, cost=0.03), stairs) == ["no foot on tread_2"]


def test_rows_take_their_numbers_from_the_measures():
    plan = hanging_plan()
    row = bench.measured(plan, measure_contacts(plan))
    assert (row["hand_mean_low"], row["hand_mean_high"]) == pytest.approx((0.5, 0.5))
    assert row["tangent_foot"] is None and row["tangent_hand"] < 1e-9  # feet touch nothing
    assert row["hands_only"] == 1 and row["missed"] == "ground, left_pad, right_pad"
    leaning = leaning_plan()
    row = bench.measured(leaning, measure_contacts(leaning))
    assert row["hand_mean_low"] is None and row["peak_hand"] is None and row["missed"] == ""
    assert row["peak_foot"] == pytest.approx(1.0) and row["momentum_Nms"] > 17.0
    pulled = with_contact(hanging_plan(), 0, RIGHT_HAND, anchor_W=[0.0, 0.0, 0.8])
    assert bench.measured(pulled, measure_contacts(pulled))["tangent_hand"] == np.inf


def test_the_paper_s_model_needs_more_friction_than_there_is():
    """On pads without a grasp its forces need a coefficient of 1.25 at least (docs/theory/ddp.md, "Limits of the model")."""
    row = bench.solve(replace(RAIL, model="", planning={"max_iterations": 60, "method": "paper"}))
    assert row.status != "solved" and row.holds is False and row.why


def test_what_does_not_exist_is_a_row_that_does_not_hold():
    row = bench.solve(Case("x", "no_such_scene"))
    assert (row.status, row.holds) == ("refused", False) and "no scene 'no_such_scene'" in row.why
    row = bench.solve(Case("x", "flat", model="", planning={"no_such_option": 1}))
    assert (row.status, row.holds) == ("refused", False) and "no such option" in row.why
    assert bench.line(row).startswith("x: refused, DOES NOT HOLD: ")


def test_settings_count_plans_on_hands_that_are_solved():
    rows = [replace(GOOD, cost=cost) for cost in np.linspace(0.2, 0.6, 14)]
    rows += [replace(GOOD, status="infeasible", cost=0.1), replace(GOOD, hands_only=0, cost=0.1, holds=False)]
    found = bench.settings_summary(rows)
    assert (found["runs"], found["hands_only"], found["solved"], found["hold_contacts"]) == (16, 14, 15, 15)
    assert found["min_cost"] == pytest.approx(0.2) and found["median_cost"] == pytest.approx(0.4) and found["holds"]
    assert not bench.settings_summary(rows[1:])["holds"]  # 13 of them
    assert not bench.settings_summary([replace(row, cost=0.3) for row in rows])["holds"]
    assert bench.settings_summary([])["min_cost"] is None


def test_speed_is_a_ratio_of_two_runs():
    lines: list[str] = []
    (row,) = bench.compare_speed(1, ("flat",), ("", ""), lines.append)
    assert row["ratio"] == pytest.approx(row["ours_ms"] / row["other_ms"]) and row["ours_plan_ms"] > 0.0
    assert len(lines) == 1 and lines[0].startswith("flat: ")


def result() -> dict:
    speed = {
        "scene": "flat",
        "ours_model": "wrench",
        "other_model": "lipm",
        "holds": True,
        "ratio": 1.4,
        "ratio_all": 1.2,
    }
    speed |= {"ours_ms": 0.42, "other_ms": 0.3, "ours_all_ms": 0.24, "other_all_ms": 0.2}
    speed |= {"ours_plan_ms": 150.0, "other_plan_ms": 110.0}
    settings = [
        replace(GOOD, case="gap_with_rail, proximal_weight 10"),
        replace(GOOD, holds=False, why="slip", cost=0.4),
    ]
    return {
        "machine": MACHINE,
        "jobs": 1,
        "command": "mcplan bench contacts",
        "rows": [GOOD, replace(GOOD, case="gap", cost=None, holds=False, why="no scene")],
        "settings": {"rows": settings, "summary": bench.settings_summary(settings)},
        "speed": [speed],
    }


def test_tables_show_what_was_measured():
    plans, contacts, bodies, settings, speed = sections(result())
    assert dict(zip(plans.head, plans.rows[1], strict=True))["holds"] == "NO" and plans.notes == ["gap: no scene"]
    row = dict(zip(contacts.head, contacts.rows[0], strict=True))
    assert len(contacts.rows) == 1  # what was not planned has no contacts
    assert (row["tangent, foot"], row["hand's mean"], row["reach"]) == ("0.600", "0.490-0.510", "4.00")
    assert dict(zip(bodies.head, bodies.rows[0], strict=True))["angular momentum"] == "8.70 N m s"
    assert settings.rows[0][0] == "proximal_weight 10" and settings.notes[0].startswith("2 of 2 find")
    assert speed.rows[0][1:4] == ["0.420 ms", "0.300 ms", "1.40"] and "1.40." in speed.notes[0]
    for section in sections(result()):
        assert all(len(row) == len(section.head) for row in section.rows), section.title


def test_tables_go_between_the_marks_of_a_page():
    page = markdown(result(), f"# Mine\n\nBefore.\n\n{BEGIN}\nstale\n{END}\n\nAfter.\n")
    assert page.startswith("# Mine\n\nBefore.\n") and page.endswith(f"\n{END}\n\nAfter.\n")
    assert "stale" not in page and "### Contacts at 1 kHz" in page
    assert markdown(result()).startswith("# Plans held to what contacts give")
