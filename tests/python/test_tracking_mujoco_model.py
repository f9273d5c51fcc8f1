"""MuJoCo's model of a robot is Pinocchio's: mass, CoM, inverse dynamics, contact points, limits."""

import numpy as np
import pytest

import mcplan as mp
import simulated

mujoco = pytest.importorskip("mujoco")
pin = pytest.importorskip("pinocchio")
example_robot_data = pytest.importorskip("example_robot_data")

from mcplan.tracking import Options, states  # noqa: E402
from mcplan.tracking.mujoco_model import BALL_RADIUS_M, build  # noqa: E402


@pytest.fixture(scope="module", params=["talos", "g1"])
def model(request):
    return build(mp.load_robot(request.param), simulated.level())


@pytest.fixture
def data_of(model):
    def at(configuration, velocity):
        data = mujoco.MjData(model.mj)
        data.qpos[:], data.qvel[:] = states.to_mujoco(model, configuration, velocity)
        return data

    return at


def test_mass_and_com_are_those_of_the_urdf_as_pinocchio_reads_it(model, data_of):
    source = example_robot_data.load(
        model.urdf_model.robot.name
    ).model  # not the copy that the simulation was made from
    assert model.mj.body_mass.sum() == pytest.approx(pin.computeTotalMass(source), abs=1e-9)
    rng = np.random.default_rng(0)
    for _ in range(5):
        configuration, velocity, _ = simulated.random_state(model, rng)
        data = data_of(configuration, velocity)
        mujoco.mj_fwdPosition(model.mj, data)
        expected = pin.centerOfMass(source, source.createData(), configuration)
        np.testing.assert_allclose(data.subtree_com[model.base_body], expected, atol=1e-12)


def test_inverse_dynamics_agree_at_random_states(model, data_of):
    rng, pin_model, flags = np.random.default_rng(1), model.urdf_model.model, model.mj.opt.disableflags
    model.mj.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT  # joints beyond their limits are pushed back
    try:
        for _ in range(10):
            configuration, velocity, acceleration = simulated.random_state(model, rng)
            data = data_of(configuration, velocity)
            data.qacc[:] = states.acceleration_to_mujoco(model, configuration, velocity, acceleration)
            mujoco.mj_inverse(model.mj, data)
            force = pin.rnea(pin_model, pin_model.createData(), configuration, velocity, acceleration)
            expected = states.force_to_mujoco(model, configuration, force)
            np.testing.assert_allclose(data.qfrc_inverse, expected, atol=1e-9 * np.abs(expected).max())
    finally:
        model.mj.opt.disableflags = flags


def test_every_joint_has_a_rotor_and_none_has_damping(model):
    source = example_robot_data.load(model.urdf_model.robot.name).model
    armature = model.mj.dof_armature[model.dof_index]
    given = source.armature[6:] > 0.0
    np.testing.assert_array_equal(armature[given], source.armature[6:][given])
    np.testing.assert_array_equal(armature[~given], 0.01)
    np.testing.assert_array_equal(model.mj.dof_armature[:6], 0.0)
    assert not model.mj.dof_damping.any() and not model.mj.dof_frictionloss.any()


def test_motors_and_joint_limits_are_those_of_the_urdf(model):
    source = model.urdf_model.model
    for i, name in enumerate(model.joints):
        joint = source.getJointId(name)
        assert model.mj.joint(name).qposadr[0] == model.qpos_index[i]
        assert model.mj.actuator(model.actuator_index[i]).trnid[0] == model.mj.joint(name).id
        limit = source.effortLimit[source.idx_vs[joint]]
        assert model.torque_limits[i] == limit
        assert model.mj.actuator_ctrlrange[model.actuator_index[i]].tolist() == [-limit, limit]
        q = source.idx_qs[joint]
        expected = [source.lowerPositionLimit[q], source.upperPositionLimit[q]]
        np.testing.assert_allclose(model.mj.joint(name).range, expected, atol=1e-12)


def test_soles_and_balls_touch_at_the_contact_points_in_the_nominal_posture(model, data_of):
    urdf_model = model.urdf_model
    data, pin_data = data_of(urdf_model.neutral, np.zeros(urdf_model.model.nv)), urdf_model.model.createData()
    mujoco.mj_fwdPosition(model.mj, data)
    pin.framesForwardKinematics(urdf_model.model, pin_data, urdf_model.neutral)
    for end, frame, geoms in zip(urdf_model.robot.end_effectors, urdf_model.frames, model.end_geoms, strict=True):
        point, (geom,) = pin_data.oMf[frame].translation, geoms
        axes, centre = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
        if end.kind == "foot":
            np.testing.assert_allclose(axes, np.eye(3), atol=1e-9)
            np.testing.assert_allclose(centre - [0, 0, model.mj.geom_size[geom][2]], point, atol=1e-9)
            np.testing.assert_allclose(model.mj.geom_size[geom][:2], end.half_size)
        else:
            assert np.linalg.norm(centre - point) == pytest.approx(BALL_RADIUS_M)
            wrist = pin_data.oMi[urdf_model.model.frames[frame].parentJoint].translation
            assert np.linalg.norm(wrist - centre) < np.linalg.norm(wrist - point)


def test_mass_and_friction_are_scaled_in_the_simulation_alone():
    robot = mp.load_robot("talos")
    options = Options(mass_scale=1.1, friction_scale=0.8, ground_shift_m=0.01)
    model = build(robot, simulated.level(friction=0.5), options)
    assert model.mj.body_mass.sum() == pytest.approx(1.1 * robot.mass, abs=1e-3)
    assert pin.computeTotalMass(model.urdf_model.model) == pytest.approx(robot.mass, abs=1e-3)
    plain = build(robot, simulated.level())
    np.testing.assert_allclose(model.mj.body_inertia, 1.1 * plain.mj.body_inertia)
    assert model.mj.body_subtreemass[0] == pytest.approx(1.1 * robot.mass, abs=1e-3)  # what MuJoCo derives from them
    assert model.mj.geom_friction[model.surface_geoms[0]][0] == pytest.approx(0.4)
    assert model.mj.geom_priority[model.surface_geoms[0]] > model.mj.geom_priority[model.end_geoms[0][0]]


def test_visual_meshes_touch_nothing_and_weigh_nothing():
    robot = mp.load_robot("talos")
    model, plain = build(robot, simulated.level(), visual=True), build(robot, simulated.level())
    seen = sorted(set(range(model.mj.ngeom)) - set(model.geom_names))
    assert len(seen) > 30
    assert not model.mj.geom_contype[seen].any() and not model.mj.geom_conaffinity[seen].any()
    np.testing.assert_allclose(model.mj.body_mass, plain.mj.body_mass)
    assert model.joints == plain.joints


@pytest.mark.parametrize(
    "name", [pytest.param("anymal", marks=pytest.mark.slow), "icub", "hyq", "solo12", "go2", "bolt"]
)
def test_other_robots_of_example_robot_data_are_simulated(name):
    """Some have massless base links, links without a body's inertia, or meshes that MuJoCo does not read."""
    source = example_robot_data.load(name).model
    robot = mp.load_robot("anymal")
    robot.urdf, robot.posture = f"example-robot-data:{name}", {}
    end = robot.end_effectors[0]
    end.frame = next(frame.name for frame in reversed(list(source.frames)) if frame.type == pin.FrameType.BODY)
    robot.end_effectors = [end]
    model = build(robot, simulated.level(), visual=True)
    assert model.mj.body_mass.sum() == pytest.approx(pin.computeTotalMass(source), rel=1e-5)
    assert sorted(model.joints) == sorted(list(source.names)[2:])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot name='x'><link name='base'/><link name='other'/></robot>", "urdf: must be a readable URDF"),
        (simulated.block().replace("revolute", "continuous"), "urdf: must have one root and joints of one degree"),
    ],
)
def test_a_urdf_that_cannot_be_simulated_is_refused(tmp_path, text, message):
    path = tmp_path / "robot.urdf"
    path.write_text(text)
    robot = mp.load_robot("anymal")
    robot.urdf, robot.posture = str(path), {}
    end = robot.end_effectors[0]
    end.frame = "base"
    robot.end_effectors = [end]
    with pytest.raises(mp.errors.InvalidRobot) as error:
        build(robot, simulated.level())
    assert message in str(error.value)


def test_options_out_of_range_are_refused():
    with pytest.raises(mp.errors.InvalidOptions, match="mass_scale"):
        build(mp.load_robot("talos"), simulated.level(), Options(mass_scale=0.0))
