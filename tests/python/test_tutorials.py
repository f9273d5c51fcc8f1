"""The notebooks of docs/tutorials run from top to bottom, each in an empty folder, and are kept without their output."""

import json
from pathlib import Path

import pytest

TUTORIALS = sorted((Path(__file__).resolve().parents[2] / "docs/tutorials").glob("*.ipynb"))
#: Simulations and walks that take over ten seconds.
SLOW = {"04_receding_horizon", "07_tracking"}


def code_of(path: Path) -> list[str]:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def test_there_is_one_for_each_part():
    text = "\n".join("\n".join(code_of(path)) for path in TUTORIALS)
    assert len(TUTORIALS) == 9
    for call in ("plan", "check", "show", "walk", "whole_body", "motion", "track", "run", "export", "load_sweep"):
        assert f"mp.{call}(" in text


@pytest.mark.parametrize(
    "path",
    [pytest.param(p, marks=pytest.mark.slow if p.stem in SLOW else (), id=p.stem) for p in TUTORIALS],
)
def test_every_cell_runs_after_those_before_it(path, tmp_path, monkeypatch):
    for name in ("meshcat", "matplotlib", "mujoco", "pinocchio", "proxsuite", "example_robot_data", "scipy", "pandas"):
        pytest.importorskip(name)
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "tutorial"}
    for number, code in enumerate(code_of(path)):
        exec(compile(code, f"{path.stem}, code cell {number}", "exec"), names)


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_no_output_is_kept(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    kept = [cell["id"] for cell in cells if cell.get("outputs") or cell.get("execution_count")]
    assert kept == []
