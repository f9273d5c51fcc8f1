"""mcplan_bench.contact_replay: what forces alone make of a plan, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench.contact_replay import replay, replay_errors
from stepping import stepping_plan
from wrench_plans import leaning_plan, spinning_plan, tipping_plan, with_contact, with_knot


def errors(plan: mp.Plan):
    return replay_errors(plan, replay(plan))


def test_a_pendulum_follows_its_cosh():
    plan = tipping_plan(ahead_m=0.05, duration_s=0.5)
    replayed = replay(plan)
    omega = np.sqrt(plan.scene.gravity / plan.robot.com_height)
    assert replayed.times_s.shape == (1, 501)
    assert replayed.com_W[0, :, 0] == pytest.approx(0.05 * np.cosh(omega * replayed.times_s[0]), abs=1e-11)
    assert replayed.com_W[0, :, 2] == pytest.approx(plan.robot.com_height, abs=1e-12)
    found = errors(plan)
    assert found.com_m < 1e-11 and found.velocity_m_s < 1e-10
    assert found.momentum_Nms < 1e-14 and found.orientation_deg < 1e-13


def test_a_force_beside_the_com_turns_the_body():
    plan = leaning_plan(duration_s=0.4)
    replayed = replay(plan)
    t = replayed.times_s[0]
    moment = -0.1 * plan.robot.mass * plan.scene.gravity
    assert replayed.momentum_W[0] == pytest.approx(np.outer(moment * t, [1.0, 0.0, 0.0]), abs=1e-10)
    assert replayed.com_W[0] == pytest.approx(np.tile([0.0, 0.0, plan.robot.com_height], (len(t), 1)), abs=1e-12)
    roll = np.arctan2(replayed.rotation_WB[0, :, 2, 1], replayed.rotation_WB[0, :, 2, 2])
    assert roll == pytest.approx(0.5 * moment * t**2 / plan.robot.inertia[0], abs=1e-10)
    found = errors(plan)
    assert max(found.com_m, found.momentum_Nms, found.orientation_deg, found.orientation_from_start_deg) < 1e-8


@pytest.mark.parametrize("inertia", [[5.0, 5.0, 5.0], [5.0, 5.0, 1.0], [2.0, 2.0, 6.0]])
def test_a_body_in_flight_precesses(inertia):
    """By up to 2.6 rad in 0.6 s: no small angles."""
    plan = spinning_plan(np.array([6.0, -3.0, 5.0]), np.array(inertia))
    found = errors(plan)
    assert found.com_m < 1e-12 and found.momentum_Nms < 1e-13
    assert found.orientation_deg < 1e-8 and found.orientation_from_start_deg < 1e-7


def test_differences_at_the_knots_are_those_that_were_put_there():
    found = errors(with_knot(tipping_plan(), 1, com_W=tipping_plan().knots[1].com_W + [0.0, 3e-3, 4e-3]))
    assert found.com_m == pytest.approx(5e-3, abs=1e-9)
    plan = leaning_plan()
    turned = plan.knots[1].base_rpy + [np.deg2rad(2.0), 0.0, 0.0]
    momentum = plan.knots[1].angular_momentum_W + [0.0, 0.0, 0.7]
    found = errors(with_knot(plan, 1, base_rpy=turned, angular_momentum_W=momentum))
    assert found.orientation_deg == pytest.approx(2.0, abs=1e-6)
    assert found.momentum_Nms == pytest.approx(0.7, abs=1e-8)


def test_small_errors_of_orientation_add_up_over_the_plan():
    """Each of three phases turns by a degree more than its momentum does."""
    plan = spinning_plan(np.array([0.0, 0.0, 2.0]), np.array([5.0, 5.0, 5.0]), phases=3)
    for k in (1, 2, 3):
        plan = with_knot(plan, k, base_rpy=plan.knots[k].base_rpy + [0.0, 0.0, np.deg2rad(float(k))])
    found = errors(plan)
    assert found.orientation_deg == pytest.approx(1.0, abs=1e-7)
    assert found.orientation_from_start_deg == pytest.approx(3.0, abs=1e-7)


def test_moments_of_contacts_turn_both_models():
    """1 N m about the vertical for 0.5 s: 0.5 N m s, of which the tipping plan's knots know nothing."""
    for law in (mp.model.ForceLaw.pendulum, mp.model.ForceLaw.wrench):
        plan = with_contact(tipping_plan(), 0, 0, moment_W=[0.0, 0.0, 1.0])
        contacts = [contact.__copy__() for contact in plan.phases[0].contacts]
        contacts[0].center_of_pressure_W = contacts[0].anchor_W
        plan.phases = [mp.model.Phase(duration=0.5, contacts=contacts, law=law)]
        assert errors(plan).momentum_Nms == pytest.approx(0.5, abs=1e-9)
        assert errors(plan).orientation_deg == pytest.approx(np.rad2deg(0.5 * 0.5**2 / 5.0), abs=1e-7)


def test_phases_of_different_length_end_at_their_own_knots():
    found = errors(mp.plan("gap", "humanoid44", max_iterations=40).plan)
    assert found.com_m < 1e-9 and found.momentum_Nms < 1e-9


def test_forces_at_points_are_refused():
    with pytest.raises(mp.InvalidInput, match=r"phases\[0\].law: must have no forces at points"):
        replay(stepping_plan())
