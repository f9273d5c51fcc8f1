"""mcplan_bench.criteria: what a plan must show beyond passing the checker."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench.criteria import alternate, apex_m, comparable_cost, flights, shortcoming, swings

RIGHT, LEFT = 0, 1
BOTH, ON_LEFT, ON_RIGHT, NONE = [0, 0], [-1, 0], [0, -1], [-1, -1]


def plan_of(scene: str, sequence: list[list[int]], rise_m_s: float = 0.0) -> mp.Plan:
    """A plan with these contacts, right foot, left foot, right hand, left hand (hands may be left out); the CoM starts
    each phase at 0.7 m with this upward velocity and is held up by nothing."""
    model, robot = mp.load_scene(scene), mp.load_robot("humanoid44")
    names = [end.name for end in robot.end_effectors]
    assert names == ["right_foot", "left_foot", "right_hand", "left_hand"]
    com_W = np.array([0.0, 0.0, robot.com_height])
    knot = mp.model.Knot(
        com_W=com_W,
        com_velocity_W=np.array([0.0, 0.0, rise_m_s]),
        end_effectors_W=[com_W + end.nominal_B for end in robot.end_effectors],
        end_effector_velocities_W=np.zeros((4, 3)),
    )
    rows = [[*row, *[-1] * (4 - len(row))] for row in sequence]
    return mp.Plan(
        scene=model,
        robot=robot,
        knots=[knot] * (len(rows) + 1),
        phases=[
            mp.model.Phase(duration=0.4, contacts=[mp.model.Contact(surface=surface) for surface in row])
            for row in rows
        ],
        final_contacts=rows[-1],
    )


def test_flights_are_stretches_of_phases_without_contact():
    assert flights([BOTH, NONE, NONE, ON_LEFT, NONE]) == [(1, 3), (4, 5)]
    assert flights([BOTH, ON_LEFT, ON_RIGHT]) == []


def test_swings_come_in_the_order_in_which_they_start():
    walk = [BOTH, ON_LEFT, ON_LEFT, BOTH, ON_RIGHT, BOTH, ON_LEFT]
    assert swings(walk, [RIGHT, LEFT]) == [RIGHT, LEFT, RIGHT]
    assert alternate(walk, [RIGHT, LEFT])
    assert not alternate([BOTH, ON_LEFT, BOTH, ON_LEFT, BOTH, ON_RIGHT], [RIGHT, LEFT])


@pytest.mark.parametrize(
    ("scene", "sequence", "why"),
    [
        ("flat", [BOTH, ON_LEFT, BOTH, ON_RIGHT, BOTH], ""),
        ("flat", [BOTH, ON_LEFT, NONE, ON_LEFT, BOTH], "1 flights"),
        ("flat", [BOTH, ON_LEFT, BOTH, ON_LEFT, BOTH], "feet do not alternate"),
        ("gap", [BOTH, ON_LEFT, BOTH], "0 flights"),
        ("gap", [BOTH, NONE, BOTH, NONE, BOTH], "2 flights"),
        ("gap_with_rail", [[0, 0], [-1, 0, 2, 3], [-1, -1, 2, 3], [1, -1, 2, 3], [1, 1]], ""),
        ("gap_with_rail", [[0, 0], [-1, 0, 2, 3], [-1, -1, 2, -1], [1, 1]], "no phase on both hands alone"),
        ("gap_with_rail", [[0, 0], [-1, 0, 2, 3], [1, 0, 2, 3], [1, 1]], "no phase on both hands alone"),
        ("slope", [BOTH, NONE, BOTH], ""),
    ],
)
def test_a_plan_is_good_or_its_shortcoming_is_named(scene, sequence, why):
    assert shortcoming(scene, plan_of(scene, sequence)) == why


def test_every_tread_must_be_touched_by_a_foot():
    names = [surface.name for surface in mp.load_scene("stairs").surfaces]
    climb = [[0, 0]]
    for i in range(1, len(names)):
        climb += [[-1, i - 1], [i, i - 1], [i, -1], [i, i]]
    assert shortcoming("stairs", plan_of("stairs", climb)) == ""
    skipped = [[1 if surface == 2 else surface for surface in row] for row in climb]
    assert shortcoming("stairs", plan_of("stairs", skipped)) == f"no foot on {names[2]}"


@pytest.mark.parametrize(("rise_m_s", "good"), [(1.70, False), (1.73, True)])
def test_a_jump_must_rise_by_15_centimetres(rise_m_s, good):
    jump = plan_of("gap", [BOTH, NONE, BOTH], rise_m_s)
    # A free CoM rises by v^2 / 2g: 0.1474 m and 0.1527 m here.
    assert apex_m(jump, 1, 2) == pytest.approx(rise_m_s**2 / (2 * 9.8), abs=2e-5)
    assert (shortcoming("gap", jump) == "") is good


def test_comparable_cost_leaves_out_the_constants_of_the_sequence_alone():
    terms = {"task": 0.05, "reach": 0.001, "duration": 0.02, "flight": 0.5, "contact_change": 0.08}
    assert comparable_cost(SimpleNamespace(cost_terms=terms)) == pytest.approx(0.071)
    report = mp.plan("gap", "humanoid44", max_iterations=60).report
    own = sum(report.cost_terms.get(name, 0.0) for name in ("flight", "contact_change"))
    assert own > 0.0 and comparable_cost(report) == pytest.approx(report.cost - own)
