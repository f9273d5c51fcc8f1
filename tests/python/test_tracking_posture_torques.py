"""Torques of postures: parabolas give velocity and acceleration, standing gives statics, forces sum to the weight."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import knots_and_between, sample_at
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking.posture_torques import motion, posture_torques
from standing import standing_plan

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")
pytest.importorskip("scipy")
G = 9.81


@pytest.fixture(scope="module")
def standing():
    plan = standing_plan(robot=mp.load_robot("talos"))
    urdf_model = load_model(plan.robot)
    samples = sample_at(plan, plan.scene, plan.robot, knots_and_between(plan, 10.0))
    postures = follow(urdf_model, samples)
    found = posture_torques(urdf_model, plan.scene, samples, postures, np.zeros((samples.count, 3)), 1.0)
    return urdf_model, samples, postures, found


def test_forces_of_a_robot_at_rest_sum_to_its_weight(standing):
    urdf_model, samples, _, found = standing
    mass = sum(inertia.mass for inertia in urdf_model.model.inertias)
    assert found.forces_W.sum(axis=1) == pytest.approx(np.tile([0.0, 0.0, mass * G], (samples.count, 1)), abs=0.5)
    assert np.abs(found.residuals).max() < 0.5


def test_standing_torques_are_those_of_statics(standing):
    """pin.computeStaticTorque with the feet's forces at the centre of pressure below the CoM, both feet together."""
    urdf_model, samples, postures, found = standing
    model, data, q = urdf_model.model, urdf_model.model.createData(), postures.configurations[0]
    com = pin.centerOfMass(model, data, q).copy()
    pin.framesForwardKinematics(model, data, q)
    external = pin.StdVec_Force([pin.Force.Zero() for _ in range(model.njoints)])
    for end in (0, 1):
        frame = model.frames[urdf_model.frames[end]]
        foot = data.oMf[urdf_model.frames[end]].translation
        force = found.forces_W[0, end]
        point = np.array([com[0], foot[1], foot[2]])
        wrench = pin.Force(force, np.cross(point, force))
        external[frame.parentJoint] = data.oMi[frame.parentJoint].actInv(wrench)
    statics = pin.computeStaticTorque(model, data, q, external)
    assert np.abs(statics[:6]).max() < 2.0  # balanced: the check itself holds
    for joint in ("3", "4", "5"):  # hip pitch, knee, ankle pitch: where within a sole the force acts across matters not
        both = [model.joints[model.getJointId(f"leg_{side}_{joint}_joint")].idx_v for side in ("left", "right")]
        ours = found.torques[0, [i - 6 for i in both]].sum()
        assert ours == pytest.approx(statics[both].sum(), abs=2.0), joint


def test_knees_bear_the_ground_force_over_its_lever(standing):
    """By hand: weight less that of the shanks and feet, over the way from the knees' axis to where it acts."""
    urdf_model, _, postures, found = standing
    model, data, q = urdf_model.model, urdf_model.model.createData(), postures.configurations[0]
    com = pin.centerOfMass(model, data, q).copy()
    pin.forwardKinematics(model, data, q)
    expected = ours = 0.0
    for side, end in (("right", 0), ("left", 1)):
        knee = model.getJointId(f"leg_{side}_4_joint")
        x = data.oMi[knee].translation[0]
        expected += found.forces_W[0, end][2] * (com[0] - x)
        for below in range(knee, knee + 3):
            inertia = model.inertias[below]
            expected -= inertia.mass * G * (data.oMi[below].act(inertia.lever)[0] - x)
        ours += found.torques[0, model.joints[knee].idx_v - 6]
    assert abs(ours) > 20.0
    assert abs(ours) == pytest.approx(abs(expected), abs=2.0)


def test_arms_are_not_the_plans_and_legs_are(standing):
    urdf_model, _, _, found = standing
    planned = {name for name, yes in zip(urdf_model.model.names[2:], found.planned[0], strict=True) if yes}
    assert planned == {f"leg_{side}_{i}_joint" for side in ("left", "right") for i in range(1, 7)}


def test_parabolas_are_found_exactly_at_uneven_times(standing):
    model = standing[0].model
    rng = np.random.default_rng(5)
    times = np.cumsum(rng.uniform(0.01, 0.04, 30))
    v, a = rng.normal(size=model.nv), rng.normal(size=model.nv)
    v[3:6] = a[3:6] = 0.0  # turning: the parabola is in the tangent space of one sample
    middle = times[12]
    away = np.outer(times - middle, v) + 0.5 * np.outer((times - middle) ** 2, a)
    start = standing[0].neutral
    configurations = np.array([pin.integrate(model, start, step) for step in away])
    for n in (12, 0, 29):
        velocity, acceleration = motion(pin, model, times, configurations, n)
        assert velocity == pytest.approx(v + (times[n] - middle) * a, abs=1e-6)
        assert acceleration == pytest.approx(a, abs=1e-4)


def test_two_samples_are_taken_to_be_at_rest(standing):
    model, q = standing[0].model, standing[0].neutral
    velocity, acceleration = motion(pin, model, np.array([0.0, 1.0]), np.array([q, q]), 0)
    assert not velocity.any() and not acceleration.any()
