"""Sweeps with whole-body motions: files, columns, checksums, the same bytes again."""

from __future__ import annotations

from pathlib import Path

import pytest

for package in ("pydantic", "pyarrow", "pandas", "pinocchio", "scipy"):
    pytest.importorskip(package)

import mcplan as mp  # noqa: E402
from mcplan.errors import InvalidSweep  # noqa: E402
from mcplan.files.scenes import save_scene  # noqa: E402
from mcplan.files.sweep_specs import sweep_spec  # noqa: E402
from mcplan.sweep import How, load_sweep, run  # noqa: E402
from mcplan.wb import Motion  # noqa: E402


@pytest.fixture(scope="module")
def spec(tmp_path_factory) -> tuple[dict, Path]:
    """Talos and a robot without URDF take a step."""
    folder = tmp_path_factory.mktemp("motions")
    scene = mp.load_scene("flat")
    scene.name = "near"
    scene.goal.position_W = [0.2, 0.0, 0.0]
    save_scene(scene, folder / "near.toml")
    data = {
        "name": "motions",
        "robots": ["talos", "humanoid44"],
        "motion": "legs",
        "options": {"phases": 8, "max_iterations": 200},
        "scenes": [{"scene": "near.toml"}],
    }
    return data, folder


def test_motions_lie_beside_plans_with_what_their_certificate_says(spec, tmp_path):
    data, folder = spec
    run(sweep_spec(data, folder=folder), tmp_path / "one", folder)
    sweep = load_sweep(tmp_path / "one")
    assert sweep.complete and sweep.verify() == []
    table = sweep.table.set_index("robot")
    assert set(sweep.table["status"]) == {"solved"}
    assert table.loc["humanoid44", "motion_status"] == "refused"
    assert "urdf" in table.loc["humanoid44", "motion_message"]
    assert list(sweep.motions) == [0]
    motion = sweep.motions[0]
    assert isinstance(motion, Motion) and motion.plan == sweep.plans[0]
    check = motion.check()
    assert (table.loc["talos", "motion_status"] == "solved") == check.ok()
    assert table.loc["talos", "motion_torque_use"] == pytest.approx(check.measures["torque_use"], abs=1e-12)
    (tmp_path / "one" / table.loc["talos", "motion"]).write_bytes(b"")
    assert sweep.verify() == [table.loc["talos", "motion"]]


def test_motions_are_the_same_bytes_in_other_processes(spec, tmp_path):
    data, folder = spec
    data = {**data, "robots": ["talos"]}
    files = []
    for name, jobs in (("one", 1), ("two", 2)):
        run(sweep_spec(data, folder=folder), tmp_path / name, folder, How(jobs=jobs))
        files.append((tmp_path / name / "motions/0000/0000000.npz").read_bytes())
    assert files[0] == files[1]


def test_a_wrong_choice_of_joints_is_named(spec):
    data, folder = spec
    with pytest.raises(InvalidSweep, match="motion"):
        sweep_spec({**data, "motion": "arms"}, folder=folder)
