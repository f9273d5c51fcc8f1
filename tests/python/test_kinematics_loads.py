"""Loads against what a plan was made of, and against the planner's own friction."""

import numpy as np
import pytest

import plans_by_hand as by_hand
import wrenches
from mcplan.kinematics.loads import loads_of
from standing import standing_plan


def test_a_robot_that_stands_bears_half_its_weight_on_each_foot():
    plan = wrenches.standing_wrenches(squeeze_m=0.07)
    loads = loads_of(plan)
    assert loads.angular_momentum == pytest.approx(0.0, abs=1e-9)
    assert set(loads.forces) == {"right_foot", "left_foot"}
    for contact, end in zip(plan.phases[0].contacts, plan.robot.end_effectors, strict=True):
        if contact.surface >= 0:
            arm = plan.knots[0].com_W - contact.anchor_W
            assert loads.forces[end.name] == pytest.approx(0.5 * np.linalg.norm(arm) / arm[2])
            assert loads.frictions[end.name] == pytest.approx(np.hypot(*arm[:2]) / arm[2])


def test_the_largest_momentum_of_a_turn_is_that_of_its_steady_part():
    plan = wrenches.turning(by_hand.humanoid())
    assert loads_of(plan).angular_momentum == pytest.approx(plan.knots[1].angular_momentum_W[2])


def test_the_largest_values_may_lie_anywhere():
    """At the ends of phases, where plan.at() means the next one, and between the knots."""
    plan = wrenches.leaning()
    loads = loads_of(plan)
    momenta, forces = [], {name: [] for name in loads.forces}
    for k, phase in enumerate(plan.phases):
        for since in np.linspace(0.0, phase.duration, 500):
            state = plan.at_phase(k, since)
            momenta.append(np.linalg.norm(state.angular_momentum_W))
            for end, body in zip(state.end_effectors, plan.robot.end_effectors, strict=True):
                if body.name in forces:
                    forces[body.name].append(np.linalg.norm(end.force_W))
    assert loads.angular_momentum == pytest.approx(max(momenta), rel=1e-3)
    for name, sizes in forces.items():
        assert loads.forces[name] == pytest.approx(max(sizes) / (plan.robot.mass * plan.scene.gravity), rel=1e-3)


def test_other_plans_have_no_loads():
    assert loads_of(standing_plan()) is None
