"""References window by window are those of the whole plan; another plan is taken over without a jump."""

import dataclasses

import numpy as np
import pytest

import mcplan as mp
import tracked
import wrenches
from mcplan.tracking.live_references import LiveReferences
from mcplan.tracking.options import Gains
from mcplan.tracking.references import references
from planned_states import state_at
from stepping import stepping_plan

DT, HOLD = 0.002, 0.3


@pytest.fixture(scope="module")
def robot():
    return mp.load_robot("talos")


def rows(live: LiveReferences, name: str, steps) -> np.ndarray:
    found = []
    for n in steps:
        window, k = live.window(n)
        found.append(getattr(window, name)[k])
    return np.array(found)


@pytest.mark.parametrize("kind", ["turning", "walking"])
def test_windows_are_the_whole_plan_in_pieces(robot, kind):
    plan = wrenches.turning(robot) if kind == "turning" else wrenches.leaning(robot)
    whole, live = references(plan, robot, DT, HOLD), LiveReferences(plan, robot, DT, 0.0)
    steps = range(whole.count)
    for item in dataclasses.fields(whole):
        if item.name in ("dt_s", "duration_s", "next_surfaces") or getattr(whole, item.name) is None:
            continue
        expected = getattr(whole, item.name)
        if expected is None:  # what plans do not say, and motions do
            assert getattr(live.window(0)[0], item.name) is None
            continue
        found = rows(live, item.name, steps)
        if item.name == "swing_fraction":  # the whole has as many equal steps, this one the time
            used = whole.returns  # of what never lands it says nothing
            np.testing.assert_allclose(found[used], expected[used], atol=0.02, err_msg=item.name)
        elif "velocity" in item.name or "velocities" in item.name or "acceleration" in item.name:
            off = np.abs(found - expected).reshape(len(found), -1).max(axis=1)
            assert (off > 1e-6).sum() <= 2 * len(plan.phases), item.name  # kinks at contacts: a difference on one side
        else:
            np.testing.assert_allclose(found, expected, atol=1e-9, err_msg=item.name)


def test_the_next_surface_is_the_one_of_the_next_contact(robot):
    plan = wrenches.turning(robot)
    live, whole = LiveReferences(plan, robot, DT, 0.0), references(plan, robot, DT, HOLD)
    for n in range(0, whole.count, 11):
        window, k = live.window(n)
        for end in range(whole.surfaces.shape[1]):
            ahead = whole.surfaces[n:, end]
            on = ahead[ahead >= 0]
            assert window.next_surfaces[k, end] == (on[0] if len(on) else -1)


def test_a_plan_that_is_shifted_in_place_and_time_is_taken_over_without_a_jump(robot):
    plan, gains = wrenches.turning(robot), Gains()
    before = LiveReferences(plan, robot, DT, 0.0)
    step = round(0.3 / DT)
    after = LiveReferences(plan, robot, before.dt_s, -0.05).taken_over(before, step, gains)  # 50 ms ahead of it
    raw = LiveReferences(plan, robot, DT, -0.05)
    for value, rate in (
        ("com_W", "com_velocity_W"),
        ("end_effectors_W", "end_effector_velocities_W"),
    ):
        old, new = (rows(live, value, [step])[0] for live in (before, after))
        np.testing.assert_allclose(new, old, atol=1e-12 if value == "com_W" else 2e-3)
        np.testing.assert_allclose(rows(after, rate, [step]), rows(before, rate, [step]), atol=1e-12)
        after_long = step + round(1.0 / DT)
        np.testing.assert_allclose(rows(after, value, [after_long]), rows(raw, value, [after_long]), atol=3e-3)
    speed = np.diff(rows(after, "com_W", range(step, step + 200)), axis=0) / DT
    np.testing.assert_allclose(speed, rows(after, "com_velocity_W", range(step, step + 199)), atol=5e-3)
    turned = rows(after, "base_WB", [step])[0] @ rows(before, "base_WB", [step])[0].T
    np.testing.assert_allclose(turned, np.eye(3), atol=1e-9)


def test_what_decays_is_what_the_controller_would_correct(robot):
    """Following the blended reference asks for the acceleration that following the new plan itself asks for."""
    plan, gains = wrenches.turning(robot), Gains()
    before, step = LiveReferences(plan, robot, DT, 0.0), round(0.3 / DT)
    after = LiveReferences(plan, robot, before.dt_s, -0.05).taken_over(before, step, gains)
    raw = LiveReferences(plan, robot, DT, -0.05)
    x, v = np.array([0.1, 0.02, 0.8]), np.array([0.3, -0.1, 0.0])  # any state
    for n in (step, step + 40, step + 300):
        asked = []
        for live in (after, raw):
            com, rate, feed = (rows(live, name, [n])[0] for name in ("com_W", "com_velocity_W", "com_acceleration_W"))
            asked.append(feed + gains.com_kp * (com - x) + 2.0 * np.sqrt(gains.com_kp) * (rate - v))
        np.testing.assert_allclose(asked[0], asked[1], atol=1e-9)


def test_a_swing_goes_on_where_another_plan_begins_in_it(robot):
    plan = stepping_plan(steps=1, robot=robot)
    whole = LiveReferences(plan, robot, DT, 0.0)
    n = next(n for n in range(2000) if 0.5 < rows(whole, "swing_fraction", [n])[0, :2].min() < 0.52)
    end = int(np.argmin(rows(whole, "swing_fraction", [n])[0, :2]))
    lifted = whole.lifted_at(n)
    assert end in lifted and lifted[end].time_s < n * DT
    np.testing.assert_allclose(lifted[end].rotation_W, np.eye(3), atol=1e-9)
    assert whole.lifted_at(0) == {}


def test_a_sole_that_turns_lands_as_planned_though_plans_are_made_anew_all_the_time(robot):
    """A plan knows no rate of a sole in the air, so each turns it from rest."""
    plan, command = mp.plan("flat", "talos").plan, (0.0, 0.0, 0.35)
    live, t0, lands, end = LiveReferences(plan, robot, DT, 0.0), 0.0, None, None
    for n in range(round(0.9 / DT), round(4.0 / DT), round(0.1 / DT)):
        (window, k), state = live.window(n), plan.at(n * DT - t0)
        swinging = [e for e in (0, 1) if state.end_effectors[e].surface < 0]
        if end is not None and end not in swinging:
            break
        yaws = [float(np.arctan2(sole[1, 0], sole[0, 0])) for sole in window.soles_W[k]]
        knot, contacts = state_at(plan, n * DT - t0)
        knot.end_effector_yaw = yaws  # a robot that does as the references say
        plan = mp.replan(plan, n * DT - t0, knot, contacts=contacts, command=command, committed_s=1.0).plan
        t0 = n * DT
        live = LiveReferences(plan, robot, live.dt_s, t0).taken_over(live, n, Gains())
        if swinging:
            landing = next(i for i, phase in enumerate(plan.phases) if phase.contacts[swinging[0]].surface >= 0)
            goal = plan.knots[landing].end_effector_yaw[swinging[0]]
            if end is not None or goal - yaws[swinging[0]] > 0.2:
                end, lands = swinging[0], (t0 + plan.knot_times()[landing], goal)
    assert lands is not None, "no sole turned"
    sole_W = rows(live, "soles_W", [int(lands[0] / DT) - 1])[0, end]
    assert np.arctan2(sole_W[1, 0], sole_W[0, 0]) == pytest.approx(lands[1], abs=0.015)


def test_the_controller_keeps_contacts_and_torques(robot):
    pytest.importorskip("proxsuite")
    from mcplan.tracking.controller import Controller

    (plan, desired), urdf_model = tracked.still(), tracked.urdf_model("talos")
    from mcplan.tracking.runner import posture_at

    start = posture_at(urdf_model, plan, 0.0)
    controller = Controller(urdf_model, plan.scene, desired, start, Gains())
    still = np.zeros(urdf_model.model.nv)
    touching = np.array([True, True, False, False])
    for n in range(3):
        controller.step(n, start, still, touching)
    kept = [(c.mode, c.position_W.copy()) for c in controller.contacts], controller.torques.copy(), controller.points
    controller.set_plan(plan, 2 * DT)
    assert [c.mode for c in controller.contacts] == [mode for mode, _ in kept[0]]
    np.testing.assert_array_equal(controller.torques, kept[1])
    command = controller.step(3, start, still, touching)
    assert command.solved and controller.points is kept[2]
    np.testing.assert_allclose(command.torques, kept[1], atol=2.0)  # the same stance


@pytest.mark.parametrize("shift", [[np.nan, 0.0, 0.0], 5.0, [1.0, 2.0], "abc", [[0.0, 0.0, 0.0]]])
def test_a_shift_that_is_none_is_refused(robot, shift):
    with pytest.raises(mp.errors.InvalidInput, match="com_shift_W: must be three finite numbers"):
        LiveReferences(wrenches.leaning(robot), robot, DT, 0.0, shift)
