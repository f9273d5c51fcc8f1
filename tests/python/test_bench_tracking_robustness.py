"""mcplan_bench.tracking_robustness: what is drawn, and which runs stay upright."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from mcplan.cli import main
from mcplan_bench import tracking_robustness as bench
from mcplan_bench.tracking import Planned
from mcplan_bench.tracking_cases import named

pytest.importorskip("mujoco")
pytest.importorskip("proxsuite")

FLAT, STAIRS = named("flat/talos"), named("stairs_broad/talos")
STAYED = bench.Outcome(
    "flat/talos", 1, 1.05, 0.9, -0.004, 30.0, 2.5, 90.0, 0.001, 120.0, 0.5, False, 9.0, 0.004, 0.01, 0, 0
)


def outcomes(case, runs, fallen):
    return [replace(STAYED, case=case.name, seed=k, fell=k in fallen, com_rms_m=1e-3 * k) for k in range(1, runs + 1)]


def test_eighteen_of_twenty_hold_and_seventeen_do_not():
    flat, stairs = bench.summary(outcomes(FLAT, 20, {3, 20}) + outcomes(STAIRS, 20, {1, 2, 3}), [FLAT, STAIRS])
    assert (flat["survived"], flat["runs"], flat["holds"], flat["fell"]) == (18, 20, True, [3, 20])
    assert flat["largest_com_rms_m"] == pytest.approx(0.019)  # of those that stayed upright
    assert (stairs["survived"], stairs["holds"], stairs["fell"]) == (17, False, [1, 2, 3])


def test_a_case_without_a_plan_does_not_hold(monkeypatch):
    monkeypatch.setattr(bench, "plan_of", lambda case: Planned(None, "infeasible", "reach", 0.1))
    lines = []
    assert bench.run(20, progress=lines.append, cases=[FLAT]) == []
    assert lines == ["flat/talos: infeasible in 0.1 s"]
    (row,) = bench.summary([], [FLAT])
    assert not row["holds"] and row["largest_com_rms_m"] is None


def test_a_fall_is_told_with_what_was_drawn():
    text = bench.line(replace(STAYED, fell=True, completed_s=3.21))
    drawn = "mass x 1.050, friction x 0.900, ground -4.0 mm, push 30 N at 2.50 s towards 90 deg, "
    drawn += "torques 1.0 ms late and of 120 Hz, sensor noise x 0.50"
    assert text == f"flat/talos seed 1: FELL at 3.21 s ({drawn})"


def test_falls_give_exit_code_1_and_are_listed(tmp_path, monkeypatch, capsys):
    found = outcomes(FLAT, 20, {1, 2, 3})
    monkeypatch.setattr(bench, "run", lambda *_: found)
    words = ["bench", "tracking", "--no-table", "--no-speed", "--robustness", "--case", "flat/talos"]
    assert main([*words, "--out", str(tmp_path)]) == 1
    out = capsys.readouterr().out
    assert "17 of 20" in out and "seed 2: FELL" in out
    assert len((tmp_path / "robustness.csv").read_text().splitlines()) == 21
    found[:] = outcomes(FLAT, 20, {1, 2})
    assert main([*words, "--out", str(tmp_path), "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["robustness"]["outcomes"][1]["fell"] is True


@pytest.mark.slow
def test_disturbances_are_those_of_the_seed_whatever_the_processes():
    from mcplan.tracking.disturbances import disturbed
    from mcplan.tracking.options import Options

    alone, together = bench.run(2, cases=[FLAT]), bench.run(2, jobs=2, cases=[FLAT])
    assert [(o.seed, o.completed_s, o.com_rms_m) for o in alone] == [
        (o.seed, o.completed_s, o.com_rms_m) for o in together
    ]
    for outcome in alone:
        drawn = disturbed(Options(), outcome.seed, 1.0)
        assert outcome.mass_scale == drawn.mass_scale and outcome.ground_shift_m == drawn.ground_shift_m
    assert alone[0].mass_scale != alone[1].mass_scale


@pytest.mark.slow
def test_most_disturbed_runs_stay_upright():
    rows = bench.summary(bench.run(20))
    assert {row["case"]: row["fell"] for row in rows if not row["holds"]} == {}
