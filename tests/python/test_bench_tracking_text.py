"""mcplan_bench.tracking_text: what the tables show, and where they go in a page."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mcplan_bench.tracking import Row
from mcplan_bench.tracking_robustness import Outcome
from mcplan_bench.tracking_text import BEGIN, END, markdown, sections

WALK = Row("flat/talos", "ddp", "talos", 1.0, False, planned="solved", steps=12, fell=False, completed_s=11.5)
WALK = replace(WALK, com_rms_m=0.0012, com_max_m=0.0034, final_base_error_m=0.0051, torque_use=1.0, leg_torque_use=0.61)
WALK = replace(
    WALK, leg_torque_joint="leg_left_4_joint", leg_limit_ratio=0.035, qp_failures=0, control_ms=0.72, holds=True
)
WALK = replace(
    WALK, velocity_use=0.93, velocity_joint="knee", torque_step_use=1.25, self_contacts=2, self_contact_N=40.0
)
WALK = replace(WALK, self_contact_m=0.0015, terrain_contacts=0, terrain_contact_N=0.0)
FALL = replace(WALK, case="gap/talos", fell=True, completed_s=3.2, holds=False, why="fell at 3.20 s")
COM = Row("rubbles/com", "rhp", "talos", 1.0, False, planned="infeasible", message="cycle 1: com_reach", holds=True)
PLANAR = Row("walking", "sip", "walker9", 1.0, False, planned="solved", planning_s=31.0, fell=False, completed_s=6.5)
PLANAR = replace(PLANAR, force_rms=0.062, drift_m=0.0006, holds=True)
SEED_3 = Outcome("flat/talos", 3, 1.05, 0.9, -0.004, 30.0, 2.5, 90.0, 0.001, 120.0, 0.5, True, 3.0, 0.1, 0.2, 0, 0)
ROBUSTNESS = {"case": "flat/talos", "runs": 20, "survived": 19, "holds": True, "fell": [3], "largest_com_rms_m": 0.0041}
ROBUSTNESS |= {"qp_failures": 0, "simulator_warnings": 0}
SPEED = {"repeats": 3, "control_ms": 0.8, "qp_ms": 0.2, "model_ms": 0.1, "rest_ms": 0.5, "p99_ms": 1.4, "holds": True}
SPEED |= {"case": "flat/talos", "qp_ratio": 0.25, "model_ratio": 0.125, "rest_ratio": 0.625}
SPEED |= {"simulation_ms": 0.2, "realtime_factor": 1.9}
RESULT = {
    "machine": {"cpu": "A processor", "cores": 2, "version": "0.1.0", "python": "3.11", "date": "2026-11-21"},
    "packages": {"mujoco": "4.0.0", "pin": "4.1.0"},
    "jobs": 2,
    "command": "mcplan bench tracking --jobs 2",
    "rows": [WALK, FALL, COM, PLANAR],
    "robustness": {"summary": [ROBUSTNESS], "outcomes": [SEED_3, replace(SEED_3, seed=4, fell=False)]},
    "speed": SPEED,
}


def test_tables_are_in_readable_units():
    errors, effort, limits, planar, disturbed, speed = sections(RESULT)
    row = dict(zip(errors.head, errors.rows[0], strict=True))
    assert (row["CoM rms"], row["max"], row["base"], row["swing"], row["holds"]) == ("1.2", "3.4", "5.1", "-", "yes")
    row = dict(zip(effort.head, effort.rows[0], strict=True))
    assert (row["torque, legs"], row["at limit"], row["control step"]) == ("0.61", "3.5 %", "0.72 ms")
    assert [row[0] for row in limits.rows] == [row[0] for row in effort.rows]
    assert limits.rows[0][1:] == ["0.93", "knee", "1.25", "2", "40 N", "1.5 mm", "0", "0 N"]
    row = dict(zip(planar.head, planar.rows[0], strict=True))
    assert (row["in"], row["forces' error"], row["drift"]) == ("31.0 s", "6.2 %", "0.6 mm")
    assert disturbed.rows[0][:4] == ["flat/talos", "19 of 20", "3", "4.1 mm"]
    assert len(disturbed.notes) == 1 and "seed 3: FELL at 3.00 s" in disturbed.notes[0]
    assert speed.rows[0][3:6] == ["0.20 ms, 25 %", "0.10 ms, 12 %", "0.50 ms, 62 %"]


def test_what_fails_or_is_not_planned_says_why_and_is_not_among_the_runs():
    errors, effort, *_ = sections(RESULT)
    assert [row[-1] for row in errors.rows] == ["yes", "NO", "yes"]
    assert errors.notes == ["gap/talos: fell at 3.20 s", "rubbles/com: cycle 1: com_reach"]
    assert [row[0] for row in effort.rows] == ["flat/talos", "gap/talos"]


def test_every_row_has_a_cell_for_each_column():
    for section in sections(RESULT):
        assert all(len(row) == len(section.head) for row in section.rows), section.title


@pytest.mark.parametrize("page", ["", f"{BEGIN} but no end", f"{END} before {BEGIN}"])
def test_tables_are_a_page_of_their_own_where_no_page_has_a_place_for_them(page):
    text = markdown(RESULT, page)
    assert text.startswith("# Plans tracked in simulation: results\n\nWritten by `mcplan bench tracking --jobs 2`")
    assert "## Planar robots" in text and "mujoco 4.0.0, pin 4.1.0. Runs at a time: 2." in text


def test_tables_go_between_the_marks_and_can_be_written_again():
    page = f"# Tracking\n\n## Results\n\n{BEGIN}\nof last time\n{END}\n\n## Limits\n"
    text = markdown(RESULT, page)
    assert text.startswith("# Tracking\n\n## Results\n") and text.endswith(f"\n{END}\n\n## Limits\n")
    assert "of last time" not in text and "### Planar robots" in text
    assert markdown(RESULT, text) == text
