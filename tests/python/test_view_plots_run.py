"""Plots of runs show the recording's numbers."""

import dataclasses

import numpy as np
import pytest

import recordings
from mcplan.view.plots.run import base_angle_deg, plot_run_com, plot_run_errors, save_run_plots, swings
from mcplan.view.plots.run_forces import contact_normals, plot_run_forces, plot_run_torques

pytest.importorskip("matplotlib")
pin = pytest.importorskip("pinocchio")


@pytest.fixture(scope="module")
def recording():
    return recordings.walking()


def test_every_plot_is_written_and_the_assistance_only_where_there_was_one(recording, tmp_path):
    names = ["com.png", "errors.png", "forces.png", "torques.png", "momentum.png"]
    written = save_run_plots(recording, tmp_path / "new")
    assert [p.name for p in written] == names
    assert all(p.stat().st_size > 10_000 for p in written)
    held = dataclasses.replace(recording, assist=np.full_like(recording.assist, 3.0))
    assert [p.name for p in save_run_plots(held, tmp_path)] == [*names, "assist.png"]


def test_an_error_of_five_millimetres_is_plotted_as_one(recording):
    off = dataclasses.replace(recording, com_W=recording.com_plan_W + [0.003, 0.0, -0.004])
    chart = plot_run_errors(off).axes[0]
    assert chart.get_title(loc="left") == "CoM off the plan: 5.0 mm rms, 5.0 mm at most"
    (curve,) = [line for line in chart.lines if len(line.get_ydata()) == len(recording.times_s)]
    assert curve.get_ydata() == pytest.approx(5.0)
    assert chart.get_ylim()[1] > 5.0
    errors = plot_run_com(off).axes
    assert [t.get_text() for chart in errors[1::2] for t in chart.texts] == ["3.0 mm rms", "0.0 mm rms", "4.0 mm rms"]


@pytest.mark.parametrize("seed", range(4))
def test_angle_of_the_base_is_that_of_the_rotation_between(recording, seed):
    axis = np.random.default_rng(seed).normal(size=3)
    turn = pin.exp3(0.3 * (seed + 1) * axis / np.linalg.norm(axis))
    quats = [
        (-1) ** n * pin.Quaternion(pin.Quaternion(q / np.linalg.norm(q)).toRotationMatrix() @ turn).coeffs()
        for n, q in enumerate(recording.base_quat_xyzw_plan)
    ]
    turned = recording.configurations.copy()
    turned[:, 3:7] = quats
    angle = base_angle_deg(dataclasses.replace(recording, configurations=turned))
    assert angle == pytest.approx(np.degrees(0.3 * (seed + 1)), abs=1e-5)


def test_swings_are_between_contacts_and_unused_hands_have_none(recording):
    plan = np.full((8, 4), -1)
    plan[:, 0] = [0, 0, -1, -1, 0, 0, -1, -1]
    plan[:, 1] = [-1, -1, 0, 0, -1, 0, 0, 0]
    free = swings(dataclasses.replace(recording, contacts_plan=plan))
    assert free[:, 0].tolist() == [False, False, True, True, False, False, True, True]
    assert free[:, 1].tolist() == [True, True, False, False, True, False, False, False]
    assert not free[:, 2:].any()


def test_normals_are_those_of_the_surface_that_comes_next(recording):
    assert contact_normals(recording, 0) == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(recording.times_s), 1)))
    assert contact_normals(recording, 2) == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(recording.times_s), 1)))


def test_planned_and_simulated_forces_stand_beside_each_other(recording):
    off = np.zeros_like(recording.forces_W)
    off[:, 0] = [0.0, 30.0, 40.0]
    chart = plot_run_forces(dataclasses.replace(recording, forces_W=recording.forces_plan_W + off)).axes[0]
    weight = recording.simulated_robot.mass * recording.plan.scene.gravity
    assert chart.get_title(loc="left") == f"right foot: off the plan by 50 N rms ({5000 / weight:.1f} % of the weight)"
    curves = {line.get_label(): line.get_ydata() for line in chart.lines}
    assert curves["simulated, normal"] - curves["planned, normal"] == pytest.approx(40.0)


def test_peaks_of_one_step_are_kept_and_named(recording):
    torques = 0.1 * np.ones_like(recording.torques) * recording.torque_limits
    torques[137, 4] = -0.73 * recording.torque_limits[4]
    figure = plot_run_torques(dataclasses.replace(recording, torques=torques))
    chart = figure.axes[0]
    assert chart.images[0].get_array()[4].max() == pytest.approx(0.73)
    labels = chart.get_yticklabels()
    assert [t.get_text() for t in labels][4].endswith("73 %")
    assert [t.get_fontweight() for t in labels] == ["bold" if n == 4 else "normal" for n in range(len(labels))]
