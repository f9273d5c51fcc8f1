"""mcplan.files.planar_urdf: the planar robot moves and weighs as Pinocchio says the URDF does."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import PlanarConfiguration, planar_inverse_dynamics, planar_kinematics
from mcplan.cli import main
from mcplan.files.planar_robots import load_planar_robot
from mcplan.files.planar_urdf import PlanarEnd, planar_robot_from_urdf

pin = pytest.importorskip("pinocchio")

LINK = (
    '<link name="{name}"><inertial><origin xyz="{com}" rpy="0.3 -0.2 0.5"/><mass value="{mass}"/>'
    '<inertia ixx="{i}" ixy="0.001" ixz="0.002" iyy="{i}" iyz="-0.001" izz="{i}"/></inertial></link>'
)
JOINT = (
    '<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
    '<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{extra}'
    '<limit lower="{lower}" upper="{upper}" effort="30" velocity="5"/></joint>'
)
LINKS = {"pelvis": 5.0, "thigh": 2.0, "shin": 1.5, "sole": 0.3, "torso": 6.0, "head": 1.0, "arm": 0.8}
ENDS = (PlanarEnd("foot", "sole", (-0.1, 0.15)), PlanarEnd("hand", "palm"))


def joint(name: str, parent: str, child: str, xyz: str, **other: object) -> dict[str, object]:
    default = {"kind": "revolute", "rpy": "0 0 0", "axis": "0 1 0", "lower": -0.5, "upper": 1.5, "extra": ""}
    return {**default, "name": name, "parent": parent, "child": child, "xyz": xyz, **other}


def joints() -> dict[str, dict[str, object]]:
    """A leg, a torso with a head, an arm. Limbs beside the plane, a frame turned about y, axes along y and against it."""
    return {
        entry["name"]: entry
        for entry in (
            joint("hip", "pelvis", "thigh", "0.02 0.1 -0.05"),
            joint("knee", "thigh", "shin", "0.01 0 -0.4", axis="0 -1 0", rpy="0 0.4 0"),
            joint("ankle", "shin", "sole", "0.02 0 -0.3", kind="fixed", rpy="0 -0.4 0"),
            joint("waist", "pelvis", "torso", "0 0 0.1", kind="continuous", rpy="0 0 3.141592653589793"),
            joint("neck", "torso", "head", "0 0 0.5", kind="fixed"),
            joint("shoulder", "torso", "arm", "0 -0.2 0.4", rpy="0 0.7 0"),
            joint("wrist", "arm", "palm", "0 0 -0.5", kind="fixed"),
        )
    }


def urdf_text(described: dict[str, dict[str, object]], masses: dict[str, float] = LINKS) -> str:
    links = [
        LINK.format(name=name, mass=mass, com=f"{0.01 * n} {0.02 * n} -0.1", i=0.01 + 0.01 * n)
        for n, (name, mass) in enumerate(masses.items())
    ]
    return "\n".join(
        [
            '<robot name="half">',
            *links,
            '<link name="palm"/>',
            *(JOINT.format(**j) for j in described.values()),
            "</robot>",
        ]
    )


@pytest.fixture
def half(tmp_path):
    """The robot from the URDF, and Pinocchio's model of it."""
    (tmp_path / "half.urdf").write_text(urdf_text(joints()))
    robot = planar_robot_from_urdf(tmp_path / "half.urdf", ENDS)
    return robot, pin.buildModelFromUrdf(str(tmp_path / "half.urdf"), pin.JointModelFreeFlyer())


def random_state(robot, model, rng):
    """A planar configuration and the same state for Pinocchio: forward = x, up = z, anti-clockwise = about -y."""
    count = robot.joint_count()
    x = PlanarConfiguration(
        base=rng.normal(size=3), base_velocity=rng.normal(size=3), base_acceleration=rng.normal(size=3),
        q=rng.uniform(-1, 1, count), velocity=rng.normal(size=count), acceleration=rng.normal(size=count),
    )  # fmt: skip
    data, neutral = model.createData(), pin.neutral(model)
    pin.computeJointJacobians(model, data, neutral)
    signs = np.array([-np.sign(data.J[4, model.idx_vs[j]]) for j in range(2, model.njoints)])
    turn = pin.rpy.rpyToMatrix(0.0, -x.base[2], 0.0)
    position, velocity, acceleration = neutral.copy(), np.zeros(model.nv), np.zeros(model.nv)
    position[:3], position[3:7] = [x.base[0], 0, x.base[1]], pin.Quaternion(turn).coeffs()
    spin = np.array([0, -x.base_velocity[2], 0])
    linear = np.array([x.base_velocity[0], 0, x.base_velocity[1]])
    velocity[:3], velocity[3:6] = turn.T @ linear, spin
    # the free joint's acceleration is in the moving frame: a_W - spin x v_W, turned
    classical = np.array([x.base_acceleration[0], 0, x.base_acceleration[1]])
    acceleration[:3] = turn.T @ (classical - np.cross(spin, linear))
    acceleration[3:6] = [0, -x.base_acceleration[2], 0]
    for number, j in enumerate(range(2, model.njoints)):
        angle = signs[number] * x.q[number]
        at = model.idx_qs[j]
        position[at : at + model.nqs[j]] = angle if model.nqs[j] == 1 else [np.cos(angle), np.sin(angle)]
        velocity[model.idx_vs[j]] = signs[number] * x.velocity[number]
        acceleration[model.idx_vs[j]] = signs[number] * x.acceleration[number]
    return x, position, velocity, acceleration, signs


def test_bodies_are_the_links_that_joints_carry_with_what_is_fixed_to_them(half):
    robot, model = half
    assert [body.name for body in robot.bodies] == ["pelvis", "thigh", "shin", "torso", "arm"]
    assert [body.parent for body in robot.bodies] == [-1, 0, 1, 0, 3]
    assert [body.mass for body in robot.bodies] == pytest.approx([5.0, 2.0, 1.8, 7.0, 0.8])
    assert robot.mass() == pytest.approx(pin.computeTotalMass(model))
    assert (robot.name, robot.bodies[1].torque_max, robot.bodies[1].velocity_max) == ("half", 30.0, 5.0)


def test_limits_turn_with_the_axis_and_continuous_joints_have_none(half):
    robot, _ = half
    ranges = {body.name: (body.position_min, body.position_max) for body in robot.bodies}
    assert ranges["thigh"] == (-1.5, 0.5)  # about +y: clockwise with x forward and z up
    assert ranges["shin"] == (-0.5, 1.5)
    assert ranges["torso"] == (-np.inf, np.inf)


def test_frames_and_com_are_pinocchios_in_random_postures(half):
    robot, model = half
    rng, data = np.random.default_rng(1), model.createData()
    for _ in range(20):
        x, position, *_ = random_state(robot, model, rng)
        frames = planar_kinematics(robot, x)
        com_W = pin.centerOfMass(model, data, position)
        pin.framesForwardKinematics(model, data, position)
        ours_W = np.zeros(2)
        for number, (body, frame) in enumerate(zip(robot.bodies, frames, strict=True)):
            placed = data.oMi[number + 1].translation
            np.testing.assert_allclose(frame.position_W, placed[[0, 2]], atol=1e-11)
            ours_W += body.mass * (frame.position_W + turned(body.com_B, frame.angle)) / robot.mass()
        np.testing.assert_allclose(ours_W, com_W[[0, 2]], atol=1e-11)
        for end, link in zip(robot.end_effectors, ("sole", "palm"), strict=True):
            sole = data.oMf[model.getBodyId(link)]
            at, angle = frames[end.body].position_W, frames[end.body].angle
            np.testing.assert_allclose(at + turned(end.position_B, angle), sole.translation[[0, 2]], atol=1e-11)
            outward = turned(np.array([0.0, 1.0]), angle + end.angle_B)
            np.testing.assert_allclose(outward, sole.rotation[[0, 2], 2], atol=1e-11)


def test_torques_are_pinocchios_in_random_motion(half):
    robot, model = half
    rng, data = np.random.default_rng(2), model.createData()
    for _ in range(20):
        x, position, velocity, acceleration, signs = random_state(robot, model, rng)
        expected = pin.rnea(model, data, position, velocity, acceleration)
        ours = planar_inverse_dynamics(robot, x)
        np.testing.assert_allclose(ours.torque, signs * expected[6:], atol=1e-10)
        wrench_W = pin.rpy.rpyToMatrix(0.0, -x.base[2], 0.0) @ expected[:3]
        np.testing.assert_allclose(ours.base_residual, [wrench_W[0], wrench_W[2], -expected[4]], atol=1e-10)


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]])


def changed(name: str, **other: object) -> dict[str, dict[str, object]]:
    described = joints()
    described[name] |= other
    return described


def added(**other: object) -> dict[str, dict[str, object]]:
    return {**joints(), "extra": joint("extra", **other)}


BROKEN = [
    (changed("knee", axis="0 0 1", rpy="0 0 0"), LINKS, "joint knee: must turn about the axis of joint hip, (0, 1, 0), got (0,"),
    (changed("knee", rpy="0.1 0 0"), LINKS, "joint knee: must turn about the axis of joint hip, (0, 1, 0), got (0, -0.995004"),
    (changed("knee", kind="prismatic"), LINKS, "joint knee: must be revolute, continuous or fixed, got Prismatic"),
    (changed("knee", extra='<mimic joint="hip"/>'), LINKS, "joint knee: may not mimic another joint"),
    (added(parent="arm", child="shin", xyz="0 0 0"), LINKS, "joint extra: must be the only joint that carries its link"),
    (added(parent="shin", child="pelvis", xyz="0 0 0"), LINKS, "joint extra: may not close a loop, got \"pelvis\""),
    (joints(), {**LINKS, "arm": 0.0}, "link arm: must have a mass, with what is fixed to it, got 0 kg"),
    (joints(), {**LINKS, "pelvis": 0.0}, "link pelvis: must have a mass"),
]  # fmt: skip


@pytest.mark.parametrize(("described", "masses", "message"), BROKEN, ids=lambda v: v[:40] if isinstance(v, str) else "")
def test_a_urdf_that_is_no_planar_robot_is_named_with_joint_or_link(described, masses, message, tmp_path):
    file = tmp_path / "bad.urdf"
    file.write_text(urdf_text(described, masses))
    with pytest.raises(mp.errors.InvalidRobot) as found:
        planar_robot_from_urdf(file, ENDS)
    assert str(found.value).startswith(f"{file}: {message}")


@pytest.mark.parametrize(
    ("text", "message"),
    [("", "is not XML"), ("<scene/>", 'must be a URDF file, with the root element robot, got "scene"')],
)
def test_a_file_that_is_no_urdf_is_named(text, message, tmp_path):
    (tmp_path / "bad.urdf").write_text(text)
    with pytest.raises(mp.errors.InvalidRobot, match=f"bad.urdf: {message}"):
        planar_robot_from_urdf(tmp_path / "bad.urdf", ENDS)
    with pytest.raises(mp.errors.InvalidRobot, match="none.urdf: cannot be read"):
        planar_robot_from_urdf(tmp_path / "none.urdf", ENDS)


def test_end_effectors_must_be_links_that_stand_in_the_plane(tmp_path):
    (tmp_path / "half.urdf").write_text(urdf_text(changed("wrist", rpy="0.3 0 0")))
    with pytest.raises(mp.InvalidInput, match=r"^ends.foot: must name a link of the URDF. Did you mean 'sole'\?"):
        planar_robot_from_urdf(tmp_path / "half.urdf", [PlanarEnd("foot", "soles")])
    with pytest.raises(mp.InvalidInput, match="^ends.hand: must name a link whose z axis lies in the plane"):
        planar_robot_from_urdf(tmp_path / "half.urdf", ENDS)
    with pytest.raises(mp.InvalidInput, match="^ends: needs one at least"):
        planar_robot_from_urdf(tmp_path / "half.urdf", [])


def test_a_robot_drawn_in_the_xy_plane_turns_about_z(tmp_path):
    text = urdf_text({"hinge": joint("hinge", "base", "rod", "0.2 0.3 0", axis="0 0 1")}, {"base": 1.0, "rod": 1.0})
    (tmp_path / "rod.urdf").write_text(text.replace('<link name="palm"/>', ""))
    robot = planar_robot_from_urdf(tmp_path / "rod.urdf", [PlanarEnd("tip", "rod")])
    np.testing.assert_allclose(robot.bodies[1].joint_P, [0.2, 0.3])
    assert (robot.bodies[1].position_min, robot.bodies[1].position_max) == (-0.5, 1.5)
    np.testing.assert_allclose(robot.bodies[1].com_B, [0.01, 0.02])


def test_the_command_writes_a_robot_that_loads(tmp_path, capsys):
    (tmp_path / "half.urdf").write_text(urdf_text(joints()))
    words = ["robots", "--planar", "--from-urdf", tmp_path / "half.urdf", "--end", "foot=sole:-0.1,0.15"]
    words += ["--end", "hand=palm", "-o", tmp_path / "half.toml"]
    assert main([str(word) for word in words]) == 0
    assert capsys.readouterr().out == f"Wrote {tmp_path / 'half.toml'}\n"
    robot = load_planar_robot(tmp_path / "half.toml")
    assert repr(robot) == repr(planar_robot_from_urdf(tmp_path / "half.urdf", ENDS))
    assert (tmp_path / "half.toml").read_text().startswith("# Made by: mcplan robots --planar --from-urdf ")
    assert main(["robots", str(tmp_path / "half.toml")]) == 0
    assert "foot          shin" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--planar"], "--planar: needs --from-urdf"),
        (["--planar", "--from-urdf", "x.urdf", "--srdf", "x.srdf"], "--srdf: may not stand beside --planar"),
        (
            ["--planar", "--from-urdf", "x.urdf", "--end", "foot"],
            "--end: must read NAME=FRAME[:POINT,...] with --planar",
        ),
        (
            ["--planar", "--from-urdf", "x.urdf", "--end", "a=b:c"],
            "--end: must read NAME=FRAME[:POINT,...] with --planar",
        ),
    ],
)
def test_options_that_do_not_fit_are_named(words, message, capsys):
    assert main(["robots", *words]) == 2
    assert message in capsys.readouterr().err
