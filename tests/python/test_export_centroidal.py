"""mcplan.export.centroidal: every number of the plan, exactly."""

from __future__ import annotations

import csv
import json

import numpy as np

import mcplan as mp
from exports import plan, run


def read_csv(path) -> dict[str, np.ndarray]:
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def vector(columns, name) -> np.ndarray:
    return np.column_stack([columns[f"{name}_{axis}_W"] for axis in "xyz"])


def test_a_table_gives_back_the_states_of_the_plan_exactly(tmp_path):
    columns = read_csv(mp.export(plan(), "centroidal", tmp_path / "plan.csv", rate_hz=20))
    com, velocity, momentum = (vector(columns, name) for name in ("com", "com_velocity", "angular_momentum"))
    for n, t in enumerate(columns["time_s"]):
        state = plan().at(t)
        np.testing.assert_array_equal(com[n], state.com_W)
        np.testing.assert_array_equal(velocity[n], state.com_velocity_W)
        np.testing.assert_array_equal(momentum[n], state.angular_momentum_W)
        quat = np.array([columns[f"base_quat_{axis}"][n] for axis in "wxyz"])
        assert abs(quat @ state.base_quat_wxyz) > 1.0 - 1e-12
        for end, own in zip(plan().robot.end_effectors, state.end_effectors, strict=True):
            np.testing.assert_array_equal(vector(columns, f"force_{end.name}")[n], own.force_W)
            assert columns[f"surface_{end.name}"][n] == own.surface


def test_forces_of_the_table_move_the_com(tmp_path):
    """m a = m g + sum of forces; the rate of the momentum is that of forces and moments about the CoM."""
    columns = read_csv(mp.export(plan(), "centroidal", tmp_path / "plan.csv"))
    names = [end.name for end in plan().robot.end_effectors]
    total = sum(vector(columns, f"force_{name}") for name in names)
    weight = plan().robot.mass * np.array([0.0, 0.0, plan().scene.gravity])
    acceleration = (total - weight) / plan().robot.mass
    np.testing.assert_allclose(vector(columns, "com_acceleration"), acceleration, atol=1e-6)
    com = vector(columns, "com")
    rate = sum(
        np.cross(vector(columns, f"pressure_{name}") - com, vector(columns, f"force_{name}"))
        + vector(columns, f"moment_{name}")
        for name in names
    )
    momentum = vector(columns, "angular_momentum")
    middle = momentum[0] + np.cumsum(0.5 * (rate[1:] + rate[:-1]) * 0.01, axis=0)
    np.testing.assert_allclose(momentum[1:], middle, atol=0.05)


def test_json_has_the_phases_and_the_same_numbers(tmp_path):
    columns = read_csv(mp.export(plan(), "centroidal", tmp_path / "plan.csv"))
    data = json.loads(mp.export(plan(), "centroidal", tmp_path / "plan.json").read_text())
    assert all((np.array(data["columns"][name]) == values).all() for name, values in columns.items())
    assert [phase["start_s"] for phase in data["phases"]] == list(plan().knot_times())[:-1]
    for phase, contacts in zip(data["phases"], plan().contact_sequence(), strict=True):
        ends = [end.name for end, surface in zip(plan().robot.end_effectors, contacts, strict=True) if surface >= 0]
        assert list(phase["contacts"]) == ends


def test_of_a_run_the_plan_is_written(tmp_path):
    one = mp.export(plan(), "centroidal", tmp_path / "one.json").read_bytes()
    assert mp.export(run(), "centroidal", tmp_path / "two.json").read_bytes() == one
