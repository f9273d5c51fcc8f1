"""Runs of planar robots in pages, plots and rendered pictures: the recording's numbers, wherever they are shown."""

import dataclasses
import re

import numpy as np
import pytest

import planar_recordings
from mcplan.planar.view import save_planar_run_plots, show_planar_run
from mcplan.planar.view.plots_run import (
    feedback_ratio,
    force_error,
    joint_error_deg,
    plot_planar_run_forces,
    plot_planar_run_torques,
    point_drift,
)
from mcplan.planar.view.run_samples import com_of, sample_planar_run
from mcplan.planar.view.samples import sample_whole_body
from mcplan.showing import save_strip
from page_contents import clips_of, floats, track

pytest.importorskip("meshcat")
pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def recording():
    return planar_recordings.walking()


def test_com_of_the_bodies_is_the_plans_own(recording):
    samples = sample_whole_body(recording.plan, recording.times_s)
    com = com_of(recording.plan.task.robot, samples.positions_W, samples.angles)
    assert com == pytest.approx(samples.com_W, abs=1e-9)


def test_samples_are_the_simulated_ones_and_forces_keep_their_parts(recording):
    samples = sample_planar_run(recording, 30.0)
    chosen = [np.argmin(np.abs(recording.times_s - t)) for t in samples.times_s]
    assert (samples.q == recording.q[chosen]).all()
    squared = samples.tangential**2 + samples.normal**2
    known = np.isfinite(squared)
    assert known.any()
    assert squared[known] == pytest.approx(np.sum(samples.forces_W**2, axis=3)[known])
    # Where the simulator has no force there is no contact, whatever the plan says.
    assert np.linalg.norm(recording.forces_W[chosen], axis=3)[~known].max() < 2.0


def test_the_page_shows_the_simulated_robot_and_both_paths(recording):
    html = show_planar_run(recording).html()
    clip = track(clips_of(html)["com/ball"], "position")
    positions = floats(clip["values"]).reshape(-1, 3)
    samples = sample_planar_run(recording, 60.0)
    assert positions[:, [0, 2]] == pytest.approx(samples.com_W, abs=2e-5)
    assert "contact forces off by" in html and "(5.0 %)" in html
    for left, width in re.findall(r'class="planned" style="left: ([\d.]+)%; width: ([\d.]+)%', html):
        assert float(left) + float(width) < 100.01


def test_a_run_off_its_plan_is_told(recording):
    off = dataclasses.replace(recording, left_plan_at_s=float(recording.times_s[-1]))
    assert "walker9: off its plan at 5.26 s of " in show_planar_run(off).overlay


def test_errors_are_those_that_were_put_in(recording):
    force, share = force_error(recording)
    assert share == pytest.approx(planar_recordings.SCALE - 1.0)
    planned = np.nansum(recording.forces_plan_W, axis=2)
    assert force == pytest.approx(0.05 * np.sqrt(np.mean(np.sum(planned**2, axis=2))))
    assert joint_error_deg(recording)[:, 0] == pytest.approx(np.degrees(planar_recordings.TURN))
    assert joint_error_deg(recording)[:, 1:] == pytest.approx(0.0)
    assert feedback_ratio(recording) == pytest.approx(planar_recordings.FEEDBACK)


def test_drift_of_a_limb_that_only_the_base_moves_is_the_bases(recording):
    drift = point_drift(recording)
    # The first joint is of the left leg: the right foot is off by what the base is. 1 mm: the plan's own drift.
    (right,) = [i for i, name in enumerate(recording.end_effectors) if name == "right_foot"]
    known = np.isfinite(drift[:, right])
    assert known.any() and not known.all()
    assert drift[known, right] == pytest.approx(np.linalg.norm(planar_recordings.OFFSET), abs=1e-3)


def test_forces_and_torques_stand_beside_the_plans(recording):
    figure = plot_planar_run_forces(recording)
    curves = {line.get_label(): line.get_ydata() for line in figure.axes[0].lines}
    assert curves["simulated"] == pytest.approx(planar_recordings.SCALE * curves["planned"])
    titles = [chart.get_title(loc="left") for chart in plot_planar_run_torques(recording).axes]
    assert titles == [f"{name.replace('_', ' ')}: feedback 10 %" for name in recording.joints]


def test_plots_are_written(recording, tmp_path):
    written = save_planar_run_plots(recording, tmp_path / "new")
    assert [p.name for p in written] == ["forces.png", "joints.png", "torques.png", "drift.png"]
    assert all(p.stat().st_size > 10_000 for p in written)


def test_a_planar_robot_is_rendered(recording, tmp_path):
    pytest.importorskip("mujoco")
    from PIL import Image

    path = save_strip(recording, tmp_path / "strip.png", frames=[0.0, 2.6], width=400)
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB"), int)
    left, right = pixels[:180, :198], pixels[:180, 202:400]
    for half in (left, right):
        orange = (half[..., 0] > half[..., 2] + 60) & (half[..., 0] > 100)
        blue = (half[..., 2] > half[..., 0] + 60) & (half[..., 2] > 100)
        assert orange.sum() > 100 and blue.sum() > 100
    assert np.abs(left - right[:, :198]).mean() > 2
