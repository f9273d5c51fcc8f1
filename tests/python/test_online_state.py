"""Measured states against Pinocchio and MuJoCo; contacts with hysteresis."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import mcplan as mp
import tracked
from mcplan.online.contacts import ContactFilter

pin = pytest.importorskip("pinocchio")
mujoco = pytest.importorskip("mujoco")
pytest.importorskip("example_robot_data")

from mcplan.kinematics.rotations import from_rpy  # noqa: E402
from mcplan.online.state import StateReader, rpy_of, rpy_rate, surface_below  # noqa: E402
from mcplan.tracking import Options, mujoco_model  # noqa: E402
from mcplan.tracking.states import to_mujoco  # noqa: E402


@pytest.fixture(scope="module")
def reader():
    urdf_model = tracked.urdf_model("talos")
    return StateReader(urdf_model.robot, urdf_model)


def test_states_of_another_length_are_refused_by_name(reader):
    q, v = np.zeros(reader.urdf_model.model.nq), np.zeros(reader.urdf_model.model.nv)
    ends = len(reader.robot.end_effectors)
    for values, says in (
        ((q[:3], v, [True] * ends), f"configuration: must be {len(q)} numbers"),
        ((q, v[:-1], [True] * ends), f"velocity: must be {len(v)} numbers"),
        ((q, v, [True]), f"standing: must be {ends} numbers"),
    ):
        with pytest.raises(mp.errors.InvalidInput, match=says):
            reader.knot(*values)
    with pytest.raises(mp.errors.InvalidArgument, match="robot: must be a Robot"):
        StateReader("talos")


def test_angles_and_their_rates_are_those_of_the_rotation():
    rng = np.random.default_rng(3)
    for _ in range(20):
        rpy = rng.uniform([-1.5, -1.4, -3.1], [1.5, 1.4, 3.1])
        rotation, omega_W, step = from_rpy(rpy), rng.normal(size=3), 1e-6
        np.testing.assert_allclose(rpy_of(rotation), rpy, atol=1e-12)
        later = Rotation.from_rotvec(step * omega_W).as_matrix() @ rotation
        np.testing.assert_allclose(rpy_rate(rpy, omega_W), (rpy_of(later) - rpy) / step, atol=2e-4)


def test_states_are_what_differences_of_configurations_say(reader):
    model, rng, step = reader.urdf_model.model, np.random.default_rng(4), 1e-6
    for _ in range(5):
        q, v = tracked.random_state(model, reader.urdf_model.neutral, rng)
        now, later = (reader.knot(pin.integrate(model, q, v * s), v, [False] * 4) for s in (0.0, step))
        np.testing.assert_allclose(now.com_velocity_W, (later.com_W - now.com_W) / step, atol=1e-4)
        moved = (np.array(later.end_effectors_W) - np.array(now.end_effectors_W)) / step
        np.testing.assert_allclose(now.end_effector_velocities_W, moved, atol=1e-4)


def test_com_and_momentum_are_those_of_mujoco(reader):
    robot = mp.load_robot("talos")
    model = mujoco_model.build(robot, mp.load_scene("flat"), Options())
    data, rng = mujoco.MjData(model.mj), np.random.default_rng(5)
    for _ in range(5):
        q, v = tracked.random_state(model.urdf_model.model, model.urdf_model.neutral, rng)
        data.qpos[:], data.qvel[:] = to_mujoco(model, q, v)
        mujoco.mj_forward(model.mj, data)
        mujoco.mj_subtreeVel(model.mj, data)
        root, knot = model.base_body, reader.knot(q, v, [False] * 4)
        np.testing.assert_allclose(knot.com_W, data.subtree_com[root], atol=1e-9)
        np.testing.assert_allclose(knot.com_velocity_W, data.subtree_linvel[root], atol=1e-9)
        scale = robot.mass / reader.mass
        np.testing.assert_allclose(knot.angular_momentum_W, scale * data.subtree_angmom[root], atol=1e-8)


def test_momentum_that_is_planned_from_is_the_same_however_joints_move(reader):
    """Plans of ddp turn the base with all of it, and what swings gives its own back."""
    (plan, _), rng, model = tracked.still(), np.random.default_rng(7), reader.urdf_model.model
    feet = [True] * 2 + [False] * 2
    for _ in range(5):
        q, v = tracked.random_state(model, reader.urdf_model.neutral, rng)
        still = v.copy()
        still[6:] = 0.0
        moving, resting = (reader.read(0.0, q, u, feet, plan, 0.0).knot.angular_momentum_W for u in (v, still))
        np.testing.assert_array_equal(moving, resting)
        np.testing.assert_allclose(resting, reader.knot(q, still, feet).angular_momentum_W, atol=1e-12)
        reader.of_joints = True
        asked = reader.read(0.0, q, v, feet, plan, 0.0).knot
        reader.of_joints = False
        np.testing.assert_array_equal(asked.angular_momentum_W, reader.knot(q, v, feet).angular_momentum_W)


def test_what_stands_has_no_velocity_and_soles_head_where_they_do(reader):
    q, v = tracked.random_state(reader.urdf_model.model, reader.urdf_model.neutral, np.random.default_rng(6), speed=0.5)
    q[3:7] = Rotation.from_euler("z", 2.0).as_quat()
    q[7:] = reader.urdf_model.neutral[7:]
    knot = reader.knot(q, v, [True, False, False, False])
    speeds = np.linalg.norm(knot.end_effector_velocities_W, axis=1)
    assert speeds[0] == 0.0 and (speeds[1:] > 0.0).all()
    np.testing.assert_allclose(knot.end_effector_yaw[:2], 2.0, atol=1e-3)  # the posture's feet are straight


def test_surfaces_are_the_planned_ones_where_they_are_near():
    scene = tracked.two_lanes()
    assert surface_below(scene, np.array([0.0, 0.05, 0.0]), [0]) == 0  # 5 cm beside its edge: as planned
    assert surface_below(scene, np.array([0.0, 0.5, 0.0]), [0]) == 1
    assert surface_below(scene, np.array([0.0, 0.5, 0.5]), [0]) == -1


def test_contacts_need_force_for_a_while_and_so_do_their_ends():
    contacts = ContactFilter(np.array([False]), on_N=20.0, off_N=10.0, begin_s=0.004, end_s=0.01)
    forces = [0, 30, 30, 15, 30, 30, 30, 15, 15, 15, 15, 15, 15, 15, 5, 5, 5, 15, 5, 5, 5, 5, 5, 5, 5]
    found = [bool(contacts.update(0.002 * n, np.array([[0.0, 0.0, f]]))[0]) for n, f in enumerate(forces)]
    begins, ends = found.index(True), len(found) - found[::-1].index(True)
    assert begins == 6  # 4 ms after step 4: the force of step 3 was too small
    assert ends == 23  # 10 ms after step 18: that of step 17 was large enough
    assert found[begins:ends] == [True] * (ends - begins)
