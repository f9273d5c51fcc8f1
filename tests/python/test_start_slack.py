"""Plan.start_slack_s, CheckResult.start, kept_until_s and until_s of check: what a measured start violates by itself."""

from __future__ import annotations

import copy
import io
import json
import pickle

import numpy as np
import pytest

import mcplan as mp
from command_line import strict
from mcplan.cli import main
from mcplan.errors import InvalidInput, InvalidOptions, InvalidPlan, PlanViolated
from mcplan.files.plans import plan_from_bytes, plan_to_bytes
from standing import standing_plan

SLACK_S = 0.4


def out_of_reach(slack_s: float, out: float = 0.03, velocity: float = -0.25, back: int = 1) -> mp.Plan:
    """The robot stands; its first hand is `out` [m] beyond the side of its reach box, and comes back at knot `back`."""
    plan = standing_plan(phases=4)
    plan.measured_start, plan.start_slack_s = True, slack_s
    hand = hand_of(plan)
    end = plan.robot.end_effectors[hand]
    side = 1 if end.nominal_B[1] > 0.0 else -1
    edge = end.reach_max_B[1] if side > 0 else end.reach_min_B[1]
    knots = [copy.deepcopy(knot) for knot in plan.knots]
    for k in range(back):
        knots[k].end_effectors_W[hand] = knots[k].com_W + [end.nominal_B[0], edge + side * out, end.nominal_B[2]]
    knots[0].end_effector_velocities_W[hand, 1] = side * velocity
    plan.knots = knots
    plan.swings = []
    return plan


def hand_of(plan: mp.Plan) -> int:
    return next(i for i, end in enumerate(plan.robot.end_effectors) if end.kind == "hand")


def beyond_reach(plan: mp.Plan, t: float) -> float:
    """How far the hand is beyond its reach box; the base of the standing robot keeps its axes parallel to the world's."""
    state, hand = plan.at(t), hand_of(plan)
    offset, end = state.end_effectors[hand].position_W - state.com_W, plan.robot.end_effectors[hand]
    return max(np.max(end.reach_min_B - offset), np.max(offset - end.reach_max_B))


def names(result) -> set[str]:
    return {violation.name for violation in result.violations()}


def found(result) -> list[str]:
    return [repr(violation) for violation in result.constraints]


def instants(plan: mp.Plan) -> np.ndarray:
    return np.minimum(np.arange(0.0, plan.duration() + 5e-4, 1e-3), plan.duration())


def test_a_start_out_of_reach_passes_with_slack_alone_and_is_named_apart():
    plan = out_of_reach(SLACK_S)
    assert all(beyond_reach(plan, t) < 0.0 for t in np.linspace(0.2, plan.duration(), 200))
    result = mp.check(plan)
    assert result.ok(), str(result)
    (start,) = result.start
    name = plan.robot.end_effectors[hand_of(plan)].name
    assert (start.name, start.end_effector, start.phase, start.time_s) == ("reach", name, 0, 0.0)
    assert start.value == pytest.approx(0.03, rel=1e-9) and start.unit == "m"
    assert str(result).splitlines() == [
        "ok",
        f"at the start: reach at {name} in phase 0 (t = 0 s): 0.03 m over (made good within 0.4 s)",
    ]
    assert result.kept_until_s == result.checked_until_s == plan.duration()
    result.raise_if_violated()
    without = mp.check(out_of_reach(0.0))
    assert names(without) == {"reach"} and without.start == () and without.kept_until_s == 0.0


@pytest.mark.parametrize("velocity", [-0.6, -0.25, 0.0, 0.3])
@pytest.mark.parametrize("slack_s", [0.05, 0.2, 0.4, 5.0])
def test_what_is_beyond_the_slack_is_the_value_less_the_decaying_excess(slack_s, velocity):
    plan = out_of_reach(slack_s, velocity=velocity)
    excess = beyond_reach(plan, 0.0)
    values = [beyond_reach(plan, t) - excess * max(0.0, 1.0 - (t / slack_s) ** 2) for t in instants(plan)]
    result = mp.check(plan)
    (reach,) = (found for found in result.constraints if found.name == "reach")
    if max(values) > 0.0:
        assert reach.value == pytest.approx(max(values), rel=1e-6)
    first = next((t for t, value in zip(instants(plan), values, strict=True) if value > reach.tolerance), None)
    assert result.ok() == (first is None)
    assert result.kept_until_s == pytest.approx(plan.duration() if first is None else first, abs=1e-9)


def test_a_start_that_stays_out_or_goes_farther_out_is_rejected_by_name():
    for plan in (out_of_reach(SLACK_S, velocity=0.0, back=3), out_of_reach(5.0, velocity=0.3)):
        result = mp.check(plan)
        assert names(result) == {"reach"} and len(result.start) == 1
        assert "(to be made good within " in str(result)
        with pytest.raises(PlanViolated, match="reach at "):
            result.raise_if_violated()


def test_slack_forgives_nothing_else():
    def broken(change) -> set[str]:
        plan = out_of_reach(SLACK_S)
        change(plan)
        return names(mp.check(plan))

    foot = next(i for i, end in enumerate(standing_plan().robot.end_effectors) if end.kind == "foot")

    def jump(plan):
        knots = [copy.deepcopy(knot) for knot in plan.knots]
        knots[1].com_W[0] += 1e-6
        plan.knots = knots

    assert broken(lambda plan: None) == set()
    assert broken(jump) >= {"dynamics"}
    assert broken(lambda plan: setattr(plan.scene.surfaces[0], "friction", 1e-6)) == {"friction"}
    assert broken(lambda plan: setattr(plan.robot.end_effectors[foot], "max_force", 10.0)) == {"force_cap"}
    plan = out_of_reach(SLACK_S)
    other = hand_of(plan) + 1
    sign = np.sign(plan.robot.end_effectors[other].nominal_B[1])
    knots = [copy.deepcopy(knot) for knot in plan.knots]
    knots[0].end_effector_velocities_W[other, 1] = 8.0 * sign
    plan.knots = knots
    result = mp.check(plan)
    assert names(result) == {"reach"} and len(result.start) == 1
    assert result.violations()[0].end_effector == plan.robot.end_effectors[other].name


def test_a_start_within_limits_has_no_slack():
    plan = standing_plan()
    plan.measured_start = True
    without = mp.check(plan)
    plan.start_slack_s = 10.0
    result = mp.check(plan)
    assert result.start == () and found(result) == found(without)
    assert str(result) == "ok"


@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_slack_is_a_time(value):
    plan = out_of_reach(SLACK_S)
    plan.start_slack_s = value
    with pytest.raises(InvalidPlan, match=r"start_slack_s: must lie in \[0, inf\) s, got "):
        plan.validate()


def test_slack_needs_a_measured_start():
    plan = out_of_reach(SLACK_S)
    plan.measured_start = False
    for refuses in (plan.validate, lambda: mp.check(plan), lambda: plan_to_bytes(plan)):
        with pytest.raises(InvalidPlan, match="start_slack_s: must be 0 without measured_start, got 0.4"):
            refuses()


def test_slack_survives_files_copies_and_pickles(tmp_path):
    plan = out_of_reach(1 / 3)
    for ending in ("npz", "json"):
        plan.save(tmp_path / f"plan.{ending}")
        assert mp.Plan.load(tmp_path / f"plan.{ending}") == plan
    for other in (copy.deepcopy(plan), pickle.loads(pickle.dumps(plan))):
        assert other == plan and other.start_slack_s == 1 / 3
    other.start_slack_s = 0.5
    assert other != plan


def test_files_without_slack_have_none_and_damaged_slack_is_named():
    plan = standing_plan()
    with np.load(io.BytesIO(plan_to_bytes(plan)), allow_pickle=False) as archive:
        arrays = {name: archive[name] for name in archive.files}
    header = json.loads(arrays["header"].tobytes())
    assert "start_slack_s" not in header and plan_from_bytes(plan_to_bytes(plan)).start_slack_s == 0.0
    for value in (-1, "0.4", True, None, 10**400):
        data = json.dumps({**header, "measured_start": True, "start_slack_s": value}).encode()
        buffer = io.BytesIO()
        np.savez(buffer, **{**arrays, "header": np.frombuffer(data, dtype=np.uint8)})
        with pytest.raises(InvalidPlan, match="start_slack_s"):
            plan_from_bytes(buffer.getvalue())


def test_a_check_up_to_a_time_looks_at_nothing_later():
    plan = standing_plan(phases=4)
    knots = [copy.deepcopy(knot) for knot in plan.knots]
    knots[3].com_W[0] += 1e-3
    plan.knots = knots
    late_s = plan.knot_times()[3]
    whole = mp.check(plan)
    assert "dynamics" in names(whole) and whole.kept_until_s <= late_s and whole.checked_until_s == plan.duration()
    early = mp.check(plan, until_s=late_s - 0.5)
    assert early.ok() and early.complete
    assert early.checked_until_s == early.kept_until_s == late_s - 0.5
    assert "dynamics" in names(mp.check(plan, until_s=late_s))
    assert found(mp.check(plan, None, None, mp.model.Tolerances(), 100)) == found(whole)


def test_a_time_that_is_none_is_refused():
    plan = standing_plan()
    for value in (0.0, -1.0, float("nan")):
        with pytest.raises(InvalidOptions, match="until_s: must be a positive number"):
            mp.check(plan, until_s=value)
    with pytest.raises(InvalidInput, match="until_s"):
        mp.check(plan, until_s="soon")


def test_the_command_prints_start_and_how_long_a_plan_is_kept(capsys, tmp_path):
    out_of_reach(SLACK_S).save(tmp_path / "good.npz")
    assert main(["check", str(tmp_path / "good.npz")]) == 0
    out = capsys.readouterr().out
    assert "\nat the start: reach at " in out and "0.03 m over (made good within 0.4 s)" in out
    assert "kept until" not in out
    bad = out_of_reach(SLACK_S, velocity=0.3)
    bad.save(tmp_path / "bad.npz")
    assert main(["check", str(tmp_path / "bad.npz")]) == 1
    out = capsys.readouterr().out
    kept = mp.check(bad).kept_until_s
    assert f"\nkept until t = {kept:.4g} s of {bad.duration():.4g} s\n" in out and "to be made good" in out
    assert main(["check", str(tmp_path / "bad.npz"), "--json"]) == 1
    report = strict(capsys.readouterr().out)
    assert report["kept_until_s"] == kept and report["checked_until_s"] == bad.duration()
    assert report["start_slack_s"] == SLACK_S
    (start,) = report["start"]
    assert start["name"] == "reach" and start["value"] == pytest.approx(0.03, rel=1e-9)
