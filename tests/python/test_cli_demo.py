"""mcplan demo: files, table and exit code."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.cli.demo import margin
from standing import standing_plan

pytest.importorskip("matplotlib")
pytest.importorskip("meshcat")


def test_demo_writes_a_plan_a_page_and_a_picture(tmp_path, capsys):
    assert main(["demo", "--out", str(tmp_path), "--scene", "stairs"]) == 0
    out = capsys.readouterr().out
    assert "[1/1] stairs: planning" in out and "stairs  solved" in out and str(tmp_path) in out
    assert {path.name for path in tmp_path.iterdir()} == {"stairs.npz", "stairs.html", "stairs.png"}
    assert main(["check", str(tmp_path / "stairs.npz")]) == 0


def test_demo_fails_when_a_scene_is_not_solved(tmp_path, monkeypatch, capsys):
    report = SimpleNamespace(
        status=mp.Status.infeasible,
        worst_violation=mp.model.Violation(),
        cost=1.0,
        iterations=1,
        switches=0,
        time_s=0.1,
    )
    monkeypatch.setattr(mp, "plan", lambda *_, **__: SimpleNamespace(plan=standing_plan(), report=report))
    monkeypatch.setattr(mp, "show", lambda *_, **__: SimpleNamespace(save_html=lambda path: None))
    assert main(["demo", "--out", str(tmp_path), "--scene", "flat"]) == 1
    assert "flat   infeasible" in capsys.readouterr().out


def test_the_worst_constraint_is_told_as_a_share_of_its_tolerance():
    assert margin(mp.model.Violation()) == "-"
    violation = mp.model.Violation(
        name="reach", phase=3, end_effector="left_foot", value=4.21e-4, tolerance=1e-3, unit="m"
    )
    assert margin(violation) == "reach at left_foot, phase 3: 0.00042 of 0.001 m"
