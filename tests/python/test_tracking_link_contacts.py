"""Links meet each other and the terrain in the simulation, and motors lose their torque with speed."""

import numpy as np
import pytest

import folding
import mcplan as mp
import simulated

pytest.importorskip("mujoco")
pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.kinematics.urdf_model import load_model  # noqa: E402
from mcplan.tracking import Options  # noqa: E402
from mcplan.tracking.link_shapes import ABOVE_SOLE_M, link_shapes  # noqa: E402
from mcplan.tracking.mujoco_model import build  # noqa: E402
from mcplan.tracking.simulation import Simulation  # noqa: E402


def turned(tmp_path, hinge_Nm, options=None):
    """The simulation after two seconds in which the hinge was driven by a torque, and all touches in them by links."""
    simulation = Simulation(build(folding.robot(tmp_path), simulated.level(), options))
    simulation.reset(folding.standing(simulation.model.urdf_model.neutral))
    order, touches, fastest = list(simulation.model.joints), {}, 0.0
    torques = np.zeros(2)
    torques[order.index("hinge")] = hinge_Nm
    for _ in range(200):
        simulation.advance(torques, steps=10)
        fastest = max(fastest, abs(simulation.state()[1][6 + order.index("hinge")]))
        touches |= {touch.links: touch for touch in simulation.touches()}
    return simulation.state()[0][7 + order.index("hinge")], fastest, touches


def test_a_boom_comes_to_rest_on_the_block_below_it(tmp_path):
    angle, _, touches = turned(tmp_path, 1.0)
    assert set(touches) == {("base", "boom")} and not touches[("base", "boom")].terrain
    assert 0.5 < angle < 2.2 and touches[("base", "boom")].force_N > 1.0
    through, _, none = turned(tmp_path, 1.0, Options(self_contacts=False))
    assert through > angle + 0.3 and not none  # as it was: it passes through block and ground


def test_a_boom_that_is_no_end_effector_meets_the_ground(tmp_path):
    angle, _, touches = turned(tmp_path, -1.0)
    assert ("boom", "ground") in touches and touches[("boom", "ground")].terrain
    through, _, _ = turned(tmp_path, -1.0, Options(self_contacts=False))
    assert through < angle - 0.05


def test_contacts_of_links_are_no_forces_on_end_effectors(tmp_path):
    simulation = Simulation(build(folding.robot(tmp_path), simulated.level()))
    configuration = folding.standing(simulation.model.urdf_model.neutral)
    simulation.reset(configuration)
    simulation.advance(np.array([0.0, 1.0]), steps=2000)
    weight = pin.computeTotalMass(simulation.model.urdf_model.model) * 9.81
    assert simulation.touches()
    np.testing.assert_allclose(simulation.contact_forces_W()[0], [0.0, 0.0, weight], atol=0.03 * weight)


@pytest.mark.parametrize("torque", [5.0, -5.0])
def test_no_motor_drives_its_joint_beyond_the_velocity_limit(tmp_path, torque):
    robot, scene = folding.robot(tmp_path), simulated.level()
    fastest = {}
    for limited in (True, False):
        options = Options(speed_limits=limited, self_contacts=False)
        simulation = Simulation(build(robot, scene, options))
        simulation.reset(folding.standing(simulation.model.urdf_model.neutral))
        index = list(simulation.model.joints).index("swivel")
        torques = np.zeros(2)
        torques[index] = torque
        speeds = []
        for _ in range(1000):
            before = simulation.state()[1][6 + index]
            given = simulation.advance(torques)[index]
            if limited and before * np.sign(torque) >= 1.0:  # the block below it turns a little, too
                assert given * np.sign(torque) <= 0.0
            speeds.append(abs(before))
        fastest[limited] = max(speeds)
    assert fastest[False] > 2.0  # of 1 rad/s
    assert 0.9 < fastest[True] < 1.01


def test_shapes_of_a_foot_begin_above_its_sole_and_keep_their_extent(tmp_path):
    urdf_model = load_model(folding.robot(tmp_path))
    base, mast, boom = sorted(link_shapes(urdf_model), key=lambda shape: shape.joint)
    assert [base.link, mast.link, boom.link] == ["base", "mast", "boom"]
    np.testing.assert_allclose(base.points.min(axis=0), [-0.1, -0.1, -folding.SOLE_M + ABOVE_SOLE_M], atol=1e-12)
    np.testing.assert_allclose(base.points.max(axis=0), [0.1, 0.1, 0.1], atol=1e-12)
    np.testing.assert_allclose(boom.points.max(axis=0)[2], 0.4, atol=1e-12)
    assert all(shape.on_terrain for shape in (base, mast, boom))


def test_pairs_that_meet_in_the_nominal_posture_or_that_the_srdf_disables_are_left_out(tmp_path):
    robot = folding.robot(tmp_path)
    assert build(robot, simulated.level()).link_pairs == 1  # base and boom: the mast is a neighbour of both
    (tmp_path / "folding.srdf").write_text(
        '<robot name="folding"><disable_collisions link1="boom" link2="base"/></robot>'
    )
    assert build(robot, simulated.level()).link_pairs == 0
    (tmp_path / "folding.srdf").unlink()
    robot.posture = {"hinge": 2.0}  # the boom lies in the block
    assert build(robot, simulated.level()).link_pairs == 0
    assert build(robot, simulated.level(), Options(self_contacts=False)).link_pairs == 0


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_hands_make_contact_with_thighs_and_by_their_balls_alone_with_the_terrain(name):
    model = build(mp.load_robot(name), simulated.level())
    assert model.link_pairs > 100
    urdf_model = model.urdf_model
    hands = {
        int(urdf_model.model.frames[frame].parentJoint)
        for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True)
        if end.kind == "hand"
    }
    shapes = link_shapes(urdf_model)
    assert all(shape.on_terrain == (shape.joint not in hands) for shape in shapes)
    assert any(shape.joint in hands for shape in shapes)


@pytest.mark.slow
def test_arms_are_not_thrown_about_where_the_hips_have_no_torque_left():
    """Arms that are to do for the base what saturated hips cannot were driven beyond their speeds, and into the thighs."""
    pytest.importorskip("proxsuite")
    plan = mp.walk(mp.load_scene("up_and_down"), mp.load_robot("talos_wang"), fidelity="point", cycles=4).plan
    result = mp.track(plan, "talos", hold_s=0.0)
    assert not result.measures.fell and result.measures.torque_use > 0.99
    assert result.measures.velocity_use < 1.0 and result.measures.self_contacts == 0
