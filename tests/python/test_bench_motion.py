"""mcplan bench motion."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp
from mcplan.cli import main
from mcplan.kinematics.urdf_model import load_model
from mcplan_bench import motion


@pytest.mark.slow
def test_a_row_says_what_the_certificate_measures(capsys, tmp_path):
    assert main(["bench", "motion", "--case", "talos/turn", "--out", str(tmp_path), "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["motions"]
    assert row["certified"] and row["status"] == "solved" and row["reason"] == ""
    assert row["iterations"] > 0 and row["cpu_per_s"] > 0.0
    assert 0.0 < row["torque_use"] <= 1.0 and row["drift_m"] <= 1e-4 and row["com_rms_m"] <= 0.01
    assert set(motion.MEASURES) < set(row)
    assert (tmp_path / "motion.csv").read_text().startswith("robot,scene,plan,")


def test_robots_that_are_the_bench_s_own_have_joints_and_are_in_a_row():
    assert set(motion.OWN_ROBOTS) <= {robot for robot, _ in motion.CASES}
    for path in motion.OWN_ROBOTS.values():
        model = load_model(mp.load_robot(path))
        assert model.model.nq > 20
