"""Findings: what counts as a violation, in which order, in which words."""

import math

from mcplan.tracking.findings import Feasibility, Finding

REACH = Finding("reach", 0.012, 0.01, "m", "left_foot", 1.234, "at their limits: knee")
TORQUE = Finding("torque", 290.0, 300.0, "N m", "knee", 2.0)
OVER = Finding("torque", 480.0, 160.0, "N m", "hip", 2.5)


def test_a_value_at_its_limit_is_no_violation():
    assert Feasibility("r", (Finding("torque", 300.0, 300.0, "N m", "knee"),)).ok()
    assert not Feasibility("r", (Finding("torque", 300.1, 300.0, "N m", "knee"),)).ok()


def test_violations_come_worst_first():
    found = Feasibility("r", (REACH, TORQUE, OVER))
    assert found.violations() == [OVER, REACH] and found.worst() is OVER
    assert found.worst_of_each() == [REACH, OVER]
    assert found.of("torque") == {"knee": TORQUE, "hip": OVER}


def test_verdict_puts_reach_first_since_the_rest_follows_from_it():
    assert str(REACH) == "reach of left_foot at 1.23 s: 0.012 m, limit 0.01 m (at their limits: knee)"
    verdict = Feasibility("r", (REACH, TORQUE, OVER)).verdict
    assert verdict.startswith(f"r cannot follow the plan: {REACH}") and "postures that miss" in verdict
    assert Feasibility("r", (TORQUE, OVER)).verdict == f"r cannot follow the plan: {OVER}"
    assert Feasibility("r", (TORQUE,)).verdict == f"r can follow the plan; nearest to its limit: {TORQUE}"


def test_a_limit_of_nothing_is_exceeded_by_anything():
    assert Finding("hand_force", 5.0, 0.0, "N").use == math.inf
    assert Finding("hand_force", 0.0, 0.0, "N").use == 0.0


def test_plain_data_names_every_field():
    data = Feasibility("r", (REACH, TORQUE)).as_dict()
    assert data["robot"] == "r" and data["ok"] is False and len(data["constraints"]) == 2
    assert data["violations"] == [
        {
            "name": "reach",
            "value": 0.012,
            "limit": 0.01,
            "unit": "m",
            "where": "left_foot",
            "time_s": 1.234,
            "note": "at their limits: knee",
        }
    ]
