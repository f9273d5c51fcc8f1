"""mcplan_bench.tracking: what rows say, what they have to hold, and the short table that continuous integration runs."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.cli import main
from mcplan_bench import tracking as bench
from mcplan_bench.tracking_cases import CASES, DISTURBED, SHORT, Demand, named
from recordings import recorded

pytest.importorskip("mujoco")
pytest.importorskip("proxsuite")

#: A walk that holds everything.
WALK = bench.Row("flat/talos", "ddp", "talos", 1.0, False, planned="solved", steps=6, flights=0, fell=False)
WALK = replace(WALK, completed_s=9.0, com_rms_m=0.015, final_base_error_m=0.05, qp_failures=0, simulator_warnings=0)
PLANAR = bench.Row("walking", "sip", "walker9", 1.0, False, planned="solved", fell=False, completed_s=5.0)
PLANAR = replace(PLANAR, force_rms=0.10, drift_m=0.01, simulator_warnings=0)


def test_the_table_has_what_is_demanded():
    names = [case.name for case in CASES]
    assert len(set(names)) == len(names)
    for scene in ("flat", "ramp", "stairs_broad", "stepping_stones"):
        for robot in ("talos", "g1"):
            demand = named(f"{scene}/{robot}").demand
            assert (demand.com_rms_m, demand.final_base_error_m) == (0.015, 0.05)
            assert demand.qp_failures == demand.simulator_warnings == 0
    for scene in ("up_and_down", "v_shape", "rubbles"):
        for fidelity in ("single", "point", "com"):
            case = named(f"{scene}/{fidelity}")
            assert case.planning == {"fidelity": fidelity, "cycles": 14}
            assert (case.planned_for, case.robot, case.demand.com_rms_m) == ("talos_wang", "talos", 0.015)
            assert case.demand.refusable == (fidelity == "com")
    for task in ("cartwheel", "climbing", "walking"):
        demand = named(task).demand
        assert (demand.force_rms, demand.drift_m) == (0.10, 0.01)
    assert named("flat/talos").demand.steps == 6
    assert named("slope/talos").demand is None
    jumps = [case for case in CASES if case.scene == "short_gap" and case.demand is not None]
    assert sorted((case.assist, case.demand.flights) for case in jumps) == [(False, 1), (True, 1)]
    assert any(case.assist and case.demand is not None for case in CASES if case.scene == "short_gap_with_rail")
    assert [case.name for case in SHORT] == ["flat/talos", "rubbles/point", "walking"]
    assert [case.demand for case in SHORT] == [named(case.name).demand for case in SHORT]
    assert [case.name for case in DISTURBED] == [
        "flat/talos",
        "stairs_broad/talos",
        "rubbles/single, 0.88 of the friction",
    ]


def test_limits_themselves_are_held():
    assert bench.judged(WALK, named("flat/talos").demand).holds
    assert bench.judged(PLANAR, named("walking").demand).holds


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"com_rms_m": 0.0151}, "CoM rms 15.1, at most 15 mm"),
        ({"com_rms_m": float("nan")}, "CoM rms nan, at most 15 mm"),
        ({"com_rms_m": None}, "CoM rms not measured, at most 15 mm"),
        ({"final_base_error_m": 0.06}, "base at the end 60, at most 50 mm"),
        ({"qp_failures": 1}, "QP failures 1, at most 0"),
        ({"simulator_warnings": 2}, "warnings 2, at most 0"),
        ({"steps": 5}, "5 steps, at least 6"),
        ({"fell": True, "completed_s": 3.25}, "fell at 3.25 s"),
        ({"planned": "infeasible", "fell": None, "message": "reach"}, "not planned: infeasible, reach"),
        ({"fell": None, "message": "out of reach"}, "not tracked: out of reach"),
    ],
)
def test_a_walk_that_misses_a_limit_does_not_hold_and_says_why(change, why):
    row = bench.judged(replace(WALK, **change), named("flat/talos").demand)
    assert row.holds is False
    assert row.why == why
    assert f"DOES NOT HOLD: {why}" in bench.line(row)


def test_planar_robots_are_held_to_forces_and_drift():
    demand = named("climbing").demand
    row = replace(PLANAR, force_rms=0.104, drift_m=0.012, fell=True, completed_s=2.0)
    assert bench.shortfalls(row, demand) == [
        "left its plan at 2.00 s",
        "contact forces 10.4, at most 10 %",
        "drift 12, at most 10 mm",
    ]


def test_a_jump_without_flight_is_none():
    assert bench.shortfalls(WALK, Demand(flights=1)) == ["0 flights, at least 1"]
    assert bench.shortfalls(replace(WALK, flights=1), Demand(flights=1)) == []


def test_a_walk_that_is_called_not_plannable_is_what_was_asked_for_with_com_alone():
    row = replace(WALK, planned="infeasible", fell=None)
    assert bench.judged(row, named("rubbles/com").demand).holds
    assert not bench.judged(row, named("rubbles/point").demand).holds
    # Were it found, it would have to be walked.
    assert not bench.judged(replace(WALK, com_rms_m=0.02), named("rubbles/com").demand).holds


def test_a_gap_is_made_as_wide_as_asked_and_the_goal_goes_with_its_far_side():
    scene = mp.load_scene("gap")
    wider = bench.with_gap(scene, 1.1)
    before, after = (wider.surfaces[wider.surface_index(name)].vertices_W for name in ("before", "after"))
    assert after[:, 0].min() - before[:, 0].max() == pytest.approx(1.1)
    was = scene.surfaces[scene.surface_index("after")].vertices_W
    np.testing.assert_allclose(after - was, np.tile([0.3, 0.0, 0.0], (len(was), 1)), atol=1e-12)  # it was 0.8 m
    np.testing.assert_allclose(wider.goal.position_W - scene.goal.position_W, [0.3, 0.0, 0.0], atol=1e-12)
    wider.validate()


def test_what_nothing_is_demanded_of_neither_holds_nor_fails():
    row = bench.judged(replace(WALK, fell=True), None)
    assert row.holds is None and row.why == ""


def test_a_plan_that_is_not_found_is_not_tracked(monkeypatch):
    monkeypatch.setattr(bench, "track_plan", lambda *_: pytest.fail("tracked"))
    case = replace(named("flat/talos"), planning={"time_limit": 1e-6})
    row, run = bench.solve(case)
    assert run is None and row.fell is None
    assert row.planned == "time_limit" and row.why.startswith("not planned: time_limit")


def test_a_plan_out_of_the_robots_reach_is_told_and_not_raised():
    case = replace(named("flat/g1"), planned_for="talos", scale=1.0)  # whose CoM is higher than G1's legs are long
    row, run = bench.solve(case)
    assert run is None and row.planned == "solved"
    assert row.holds is False and row.why.startswith("not tracked: plan: must be in reach of g1")


def test_the_largest_torques_are_named_for_legs_and_for_all():
    run = recorded(by_hand.walk(by_hand.flat(), by_hand.talos()), rate_hz=50.0)
    limits = run.torque_limits
    arm, knee = run.joints.index("arm_left_2_joint"), run.joints.index("leg_right_4_joint")
    torques = np.zeros_like(run.torques)
    torques[3, arm], torques[::2, knee] = 0.9 * limits[arm], -0.7 * limits[knee]
    found = bench._torques(replace(run, torques=torques))
    assert found == {
        "torque_joint": "arm_left_2_joint",
        "leg_torque_joint": "leg_right_4_joint",
        "leg_torque_use": pytest.approx(0.7),
        "leg_limit_ratio": 0.0,
    }
    torques[::4, knee] = limits[knee]
    share = bench._torques(replace(run, torques=torques))["leg_limit_ratio"]
    assert share == pytest.approx(0.25, abs=1.0 / len(torques))


def test_ctrl_c_ends_the_table(monkeypatch):
    def interrupted(*_):
        raise mp.Interrupted(None)

    monkeypatch.setattr("mcplan.tracking.runner.track", interrupted)
    with pytest.raises(KeyboardInterrupt):
        bench.table([named("flat/talos")])


@pytest.mark.slow
def test_the_short_table_holds(tmp_path, capsys):
    """Level ground, five steps over rubbles, and a walk of a planar robot for which nothing is minimised."""
    page = tmp_path / "page.md"
    code = main(["bench", "tracking", "--short", "--out", str(tmp_path), "--markdown", str(page), "--json"])
    out, err = capsys.readouterr()
    result = json.loads(out)
    assert [(row["case"], row["why"]) for row in result["rows"]] == [(case.name, "") for case in SHORT]
    assert code == 0 and result["holds"] and "speed" not in result
    flat, rubbles, walking = result["rows"]
    assert rubbles["mass_planned_kg"] == pytest.approx(95.0)
    assert rubbles["mass_kg"] == flat["mass_kg"] == pytest.approx(90.27, abs=0.01)  # planned for more than is simulated
    assert rubbles["steps"] == 5 and flat["assist_force_rms_N"] == 0.0
    assert 0.0 < flat["com_rms_m"] < flat["com_max_m"]
    assert 0.0 < walking["force_rms"] < 0.1 and walking["com_rms_m"] is None
    assert "[3/3] walking" in err
    text = page.read_text()
    assert "| flat/talos | talos | 1 | solved |" in text and "`mcplan bench tracking --short`" in text
    assert json.loads((tmp_path / "tracking.json").read_text()) == result


@pytest.mark.slow
def test_the_full_table_holds():
    rows = bench.table(CASES)
    assert {row.case: row.why for row in rows if row.holds is False} == {}
