"""Sweeps that end in other tools' files: what is exported, columns, checksums, refusals by name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

for package in ("pydantic", "pyarrow", "pandas", "pinocchio", "scipy"):
    pytest.importorskip(package)

import pandas  # noqa: E402

import mcplan as mp  # noqa: E402
from mcplan.errors import InvalidSweep  # noqa: E402
from mcplan.files.scenes import save_scene  # noqa: E402
from mcplan.files.sweep_specs import sweep_spec  # noqa: E402
from mcplan.sweep import How, load_sweep, run  # noqa: E402

EXPORTS = ["mjlab", "contacts"]


@pytest.fixture(scope="module")
def spec(tmp_path_factory) -> tuple[dict, Path]:
    """Talos and a robot without URDF take a step."""
    folder = tmp_path_factory.mktemp("exports")
    scene = mp.load_scene("flat")
    scene.name = "near"
    scene.goal.position_W = [0.2, 0.0, 0.0]
    save_scene(scene, folder / "near.toml")
    data = {"name": "exports", "robots": ["talos", "humanoid44"], "exports": EXPORTS, "options": {"phases": 8}}
    return {**data, "scenes": [{"scene": "near.toml"}]}, folder


def test_solved_plans_are_exported_and_what_has_no_joints_is_refused_by_name(spec, tmp_path):
    data, folder = spec
    data = {**data, "exports": [*EXPORTS, "ocs2"]}
    run(sweep_spec(data, folder=folder), tmp_path / "one", folder)
    sweep = load_sweep(tmp_path / "one")
    assert sweep.verify() == []
    table = sweep.table.set_index("robot")
    assert table.loc["talos", "export_mjlab"] == "exports/0000/0000000.mjlab.npz"
    assert pandas.isna(table.loc["humanoid44", "export_mjlab"])
    assert table.loc["humanoid44", "export_message"].startswith("mjlab: ")
    assert "urdf" in table.loc["humanoid44", "export_message"]
    assert "; ocs2: " in table.loc["humanoid44", "export_message"]
    for task in (0, 1):
        mp.export(sweep.plans[task], "contacts", tmp_path / "alone.npz")
        assert (tmp_path / f"one/exports/0000/{task:07d}.contacts.npz").read_bytes() == (
            tmp_path / "alone.npz"
        ).read_bytes()
    joints = np.load(tmp_path / "one" / table.loc["talos", "export_mjlab"])["joint_pos"]
    assert len(joints) == int(sweep.plans[0].duration() * 50) + 1
    (tmp_path / "one" / table.loc["talos", "export_mjlab"]).unlink()
    assert sweep.verify() == ["exports/0000/0000000.mjlab.npz"]
    assert run(sweep_spec(data, folder=folder), tmp_path / "one", folder).ran == 1
    assert sweep.verify() == []


@pytest.mark.slow
def test_exports_are_the_same_bytes_in_other_processes(spec, tmp_path):
    data, folder = spec
    for name, jobs in (("one", 1), ("two", 2)):
        run(sweep_spec(data, folder=folder), tmp_path / name, folder, How(jobs=jobs))
    files = [(tmp_path / name / "checksums.sha256").read_bytes() for name in ("one", "two")]
    assert files[0] == files[1]
    assert b"exports/0000/0000000.mjlab.npz" in files[0]


@pytest.mark.parametrize(
    ("exports", "message"),
    [
        (["mjlb"], r"exports\[0\]: no such format. Did you mean 'mjlab'\?"),
        (["mjlab", "mjlab"], r"exports\[1\]: must differ from those before it, got \"mjlab\""),
        ("mjlab", "exports: must be a list"),
    ],
)
def test_wrong_formats_are_named(spec, exports, message):
    data, folder = spec
    with pytest.raises(InvalidSweep, match=message):
        sweep_spec({**data, "exports": exports}, folder=folder)


@pytest.mark.parametrize(
    ("field", "asked"), [("motion", {"motion": "legs"}), (r"exports\[1\]", {"exports": EXPORTS[::-1]})]
)
def test_what_needs_joints_is_refused_at_once_where_no_robot_has_any(spec, field, asked):
    data, folder = spec
    with pytest.raises(InvalidSweep, match=f"^{field}: needs a robot with a URDF: humanoid44 has none"):
        sweep_spec({**data, "exports": [], **asked, "robots": ["humanoid44"]}, folder=folder)
