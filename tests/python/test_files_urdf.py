"""mcplan.files.urdf: the checked-in robots agree with their URDFs, and their reach boxes are really reached."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.reach import HEADING_STEP, headings_reached, share_reached
from mcplan.files.reach_cut import below_cut
from mcplan.files.robots import robot_to_dict
from mcplan.files.strength import sole_torsion
from mcplan.files.urdf import load_model, robot_from_urdf
from mcplan.files.urdf_limbs import contact_frame, limb_of
from mcplan.files.urdf_setups import SETUPS, End

pin = pytest.importorskip("pinocchio")
example_robot_data = pytest.importorskip("example_robot_data")


@pytest.fixture(scope="module", params=sorted(SETUPS))
def loaded(request):
    setup = SETUPS[request.param]
    model, posture, _ = load_model(request.param, setup.ends)
    return mp.load_robot(request.param), setup, model, posture


def test_mass_height_and_inertia_are_those_of_the_urdf(loaded):
    robot, setup, model, posture = loaded
    frames = [contact_frame(model, end) for end in setup.ends if end.kind == "foot"]
    data = model.createData()
    assert robot.mass == pytest.approx(pin.computeTotalMass(model), abs=1e-3)
    com_W = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    soles = [data.oMf[frame].translation[2] for frame in frames]
    assert robot.com_height == pytest.approx(com_W[2] - np.mean(soles), abs=2e-3)
    # Steiner's sum over the bodies, independent of Pinocchio's centroidal algorithm
    inertia = np.zeros((3, 3))
    for joint in range(1, model.njoints):
        placement, body = data.oMi[joint], model.inertias[joint]
        arm = placement.act(body.lever) - com_W
        inertia += placement.rotation @ body.inertia @ placement.rotation.T
        inertia += body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    np.testing.assert_allclose(robot.inertia, np.diag(inertia), atol=2e-3)


def test_posture_names_joints_of_the_urdf(loaded):
    robot, _, model, _ = loaded
    assert len(robot.posture) == sum(model.nqs[j] == 1 for j in range(2, model.njoints))
    assert all(model.existJointName(name) for name in robot.posture)


def test_nine_in_ten_random_points_of_every_reach_box_are_reached(loaded):
    robot, setup, model, posture = loaded
    for number, end in enumerate(robot.end_effectors):
        limb = limb_of(model, posture, setup.ends[number], setup.ends)
        holds = functools.partial(below_cut, end)
        share = share_reached(limb, end.usual_box(), count=60, seed=number, holds=holds)
        assert share >= 0.9, (robot.name, end.name, share)


def test_nine_in_ten_soles_turned_at_random_are_reached(loaded):
    robot, setup, model, posture = loaded
    for number, end in enumerate(robot.end_effectors):
        if end.half_size.any():
            limb = limb_of(model, posture, setup.ends[number], setup.ends)
            box, holds = end.usual_box(), functools.partial(below_cut, end)
            share = share_reached(limb, box, 60, number, tuple(end.yaw_range), holds)
            assert share >= 0.9, (robot.name, end.name, share)
        else:
            assert not np.isfinite(end.yaw_range).any()


def test_soles_of_talos_turn_as_far_as_the_first_joint_of_its_hip():
    """Yaw, roll, three pitches, roll: with rolls below 90 degrees Rz(heading) = Rz(q1) Rx Ry Rx asks for heading = q1."""
    robot, setup = mp.load_robot("talos"), SETUPS["talos"]
    model, posture, _ = load_model("talos", setup.ends)
    for side, number in (("right", 0), ("left", 1)):
        joint = model.idx_vs[model.getJointId(f"leg_{side}_1_joint")]
        limits = np.array([model.lowerPositionLimit[1 + joint], model.upperPositionLimit[1 + joint]])
        np.testing.assert_allclose(robot.end_effectors[number].yaw_range, np.clip(limits, -0.8, 0.8), atol=5e-3)
        limb = limb_of(model, posture, setup.ends[number], setup.ends)
        end = robot.end_effectors[number]
        beyond = limits[np.argmin(np.abs(limits))] * 1.3
        assert share_reached(limb, (end.reach_min_B, end.reach_max_B), 5, 0, (beyond, beyond)) == 0.0


def top_of_cut(end: mp.EndEffector, x: float) -> float:
    """Height up to which the sole is lifted there."""
    if not end.reach_cut.given:
        return float("inf")
    (normal,), (b,) = end.reach_cut.A, end.reach_cut.b
    return (b - normal[0] * x) / normal[2]


def test_soles_turn_as_far_as_inverse_kinematics_follows(loaded):
    """The range is that of the twin that turns less far; a step further one of the nine points is lost."""
    robot, setup, model, posture = loaded
    for number, end in enumerate(robot.end_effectors):
        if end.half_size.any():
            limb = limb_of(model, posture, setup.ends[number], setup.ends)
            box, top = (end.nominal_B, end.reach_min_B, end.reach_max_B), functools.partial(top_of_cut, end)
            right, left = headings_reached(limb, *box, top=top)
            np.testing.assert_allclose([right, left], end.yaw_range, atol=HEADING_STEP + 1e-9)
            assert right <= end.yaw_range[0] + 1e-9 and left >= end.yaw_range[1] - 1e-9
            assert headings_reached(limb, *box, 0.1, top) == (-0.1, 0.1)


def test_left_and_right_soles_turn_and_bear_alike(loaded):
    robot, setup, *_ = loaded
    for end, made in zip(robot.end_effectors, setup.ends, strict=True):
        twin = robot.end_effectors[robot.end_effector_index(made.twin)]
        np.testing.assert_array_equal(end.yaw_range, -twin.yaw_range[::-1])
        assert end.yaw_range[0] <= 0.0 <= end.yaw_range[1]
        assert end.max_force == twin.max_force
        # Half the weight on half of a friction of 0.7
        moment = sole_torsion(tuple(end.half_size), 0.5 * robot.mass * 9.81, 0.35)
        np.testing.assert_allclose(end.max_moment, [0.0, 0.0, moment], atol=5e-3)


def test_feet_stand_where_the_posture_has_them(loaded):
    robot, setup, model, posture = loaded
    frames = [contact_frame(model, made) for made in setup.ends]  # which may add one to the model
    data = model.createData()
    com_W = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    for end, made, frame in zip(robot.end_effectors, setup.ends, frames, strict=True):
        if made.kind == "foot":
            position_W = data.oMf[frame].translation
            np.testing.assert_allclose(end.nominal_B, position_W - com_W, atol=4e-3)


@pytest.mark.parametrize(
    "name", ["go2", *(pytest.param(name, marks=pytest.mark.slow) for name in ("anymal", "g1", "talos"))]
)
def test_the_command_makes_the_robot_that_is_built_in(name):
    made, built_in = robot_to_dict(robot_from_urdf(name)), robot_to_dict(mp.load_robot(name))
    ends = zip(made.pop("end_effectors"), built_in.pop("end_effectors"), strict=True)
    assert made == built_in
    for one, other in ends:
        assert one.pop("max_force") == pytest.approx(other.pop("max_force"), rel=0.03)  # a digit, where rounded down
        for key in ("nominal", "reach_min", "reach_max"):
            np.testing.assert_allclose(one.pop(key), other.pop(key), atol=1.1e-3)
        assert one == other


def test_points_a_leg_length_too_far_are_not_reached(loaded):
    robot, setup, model, posture = loaded
    limb = limb_of(model, posture, setup.ends[0], setup.ends)
    below = robot.end_effectors[0].nominal_B - [0, 0, robot.com_height]
    assert share_reached(limb, (below, below + 1e-6), count=3, seed=0) == 0.0


def test_jacobian_of_a_limb_agrees_with_differences(loaded):
    _, setup, model, posture = loaded
    rng = np.random.default_rng(0)
    for end in setup.ends:
        limb = limb_of(model, posture, end, setup.ends)
        joints = rng.uniform(limb.lower, limb.upper)
        jacobian = limb.jacobian(joints)[:3].copy()
        step = 1e-6
        for i in range(joints.size):
            unit = np.eye(joints.size)[i] * step
            slope = (limb.position(joints + unit) - limb.position(joints - unit)) / (2 * step)
            np.testing.assert_allclose(jacobian[:, i], slope, atol=1e-8)


def test_legs_stay_on_their_own_side(loaded):
    robot, *_ = loaded
    for end in robot.end_effectors:
        assert end.reach_min_B[1] * end.reach_max_B[1] > 0.0
        if end.kind == "foot":
            assert min(abs(end.reach_min_B[1]), abs(end.reach_max_B[1])) >= end.half_size[1]


def test_g1_stands_upright_on_level_soles_below_its_com():
    """The package has no posture for it but the one with straight legs."""
    model, posture, _ = load_model("g1")
    feet = [end for end in SETUPS["g1"].ends if end.kind == "foot"]
    frames = [contact_frame(model, end) for end in feet]
    data = model.createData()
    com_W = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    for frame in frames:
        np.testing.assert_allclose(data.oMf[frame].rotation, np.eye(3), atol=1e-6)
    middle = np.mean([data.oMf[frame].translation for frame in frames], axis=0)
    np.testing.assert_allclose(com_W[:2], middle[:2], atol=1e-3)
    assert (
        (posture[7:] > model.lowerPositionLimit[7:] + 0.05) & (posture[7:] < model.upperPositionLimit[7:] - 0.05)
    ).all()
    knee = posture[model.idx_qs[model.getJointId("left_knee_joint")]]
    assert 0.5 < knee < 1.2


ONE_LEG = """<robot name="hopper">
  <link name="body"><inertial><mass value="4"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="thigh"><inertial><origin xyz="0 0 -0.2"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="shank"><inertial><origin xyz="0 0 -0.2"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hip" type="revolute"><parent link="body"/><child link="thigh"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="50" velocity="10"/></joint>
  <joint name="knee" type="revolute"><parent link="thigh"/><child link="shank"/><origin xyz="0 0 -0.4"/><axis xyz="0 1 0"/>
    <limit lower="-0.1" upper="2.5" effort="50" velocity="10"/></joint>
</robot>"""


def test_a_contact_point_off_the_link_and_a_posture_are_taken(tmp_path):
    path = tmp_path / "hopper.urdf"
    path.write_text(ONE_LEG)
    foot = End("foot", "shank", frame_offset=(0.0, 0.0, -0.4))
    robot = robot_from_urdf(str(path), (foot,), posture={"hip": -0.5, "knee": 1.0}, step=0.05)
    bent = 0.4 * np.cos(0.5)  # each link's height
    com = -(0.5 * bent + 1.5 * bent) / 6.0  # of the whole, below the hip
    assert robot.com_height == pytest.approx(com + 2.0 * bent, abs=1e-3)
    assert robot.posture == {"hip": -0.5, "knee": 1.0}
    np.testing.assert_allclose(robot.end_effectors[0].frame_offset, [0, 0, -0.4])


@pytest.mark.parametrize(
    ("ends", "posture", "message"),
    [
        ((End("foot", "ankle"),), {}, "ends.foot: must name a link of the URDF. Did you mean 'shank'?, got \"ankle\""),
        ((End("foot", "shank"),), {"toe": 0.1}, "posture.toe: must name a joint of the URDF"),
    ],
)
def test_links_and_joints_that_do_not_exist_are_named(tmp_path, ends, posture, message):
    path = tmp_path / "hopper.urdf"
    path.write_text(ONE_LEG)
    with pytest.raises(mp.InvalidInput) as error:
        robot_from_urdf(str(path), ends, posture=posture)
    assert message in str(error.value)


def test_a_joint_and_a_link_of_one_name_are_told(tmp_path):
    path = tmp_path / "biped.urdf"
    leg = ONE_LEG[ONE_LEG.index('<link name="thigh"') : ONE_LEG.index("</robot>")]
    other = leg
    for name in ("thigh", "shank", "hip", "knee"):
        other = other.replace(f'"{name}"', f'"{name}_2"')
    path.write_text(ONE_LEG.replace("</robot>", other + "</robot>").replace('"thigh"', '"hip"'))
    with pytest.raises(mp.InvalidInput) as error:
        robot_from_urdf(str(path), (End("foot", "shank"), End("foot_2", "shank_2")), posture={"hip": -0.5}, step=0.1)
    assert "urdf: must give every link and joint a name of its own" in str(error.value) and "hip" in str(error.value)
