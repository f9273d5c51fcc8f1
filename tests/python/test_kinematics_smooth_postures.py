"""Smoothed postures meet the plan, too, and nothing that the plan leaves open jumps."""

from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample
from mcplan.kinematics.smooth_postures import nearest, running_means, smoothed
from mcplan.kinematics.urdf_model import load_model

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


def largest_rates(model, times, configurations) -> np.ndarray:
    """Of each joint [rad/s]."""
    steps = [pin.difference(model, a, b)[6:] for a, b in zip(configurations[:-1], configurations[1:], strict=True)]
    return np.abs(np.array(steps) / np.diff(times)[:, None]).max(axis=0)


def test_smoothed_postures_meet_the_plan_and_leave_out_jumps_of_the_torso():
    plan = mp.walk("rubbles", cycles=2).plan
    urdf_model = load_model(plan.robot)
    samples = sample(plan, plan.scene, plan.robot, 40.0)
    postures = follow(urdf_model, samples)
    smooth = smoothed(urdf_model, samples, postures)
    torso = urdf_model.model.joints[urdf_model.model.getJointId("torso_2_joint")].idx_v - 6
    before, after = (
        largest_rates(urdf_model.model, samples.times_s, p.configurations)[torso] for p in (postures, smooth)
    )
    assert after < 0.5 * before
    assert smooth.residual < 0.02, smooth.where
    best = nearest(urdf_model, samples, postures, smooth)
    assert best.residual <= min(postures.residual, smooth.residual)


def test_running_means_leave_steady_motion_alone():
    model = load_model(mp.load_robot("talos")).model
    times = np.linspace(0.0, 2.0, 41)
    start, rate = pin.neutral(model), np.linspace(-0.1, 0.1, model.nv)
    rate[3:6] = 0.0
    steady = np.array([pin.integrate(model, start, t * rate) for t in times])
    means = running_means(SimpleNamespace(model=model), times, steady)
    inside = (times > 0.5) & (times < 1.5)  # at the ends there are neighbours on one side only
    assert means[inside] == pytest.approx(steady[inside], abs=1e-9)
