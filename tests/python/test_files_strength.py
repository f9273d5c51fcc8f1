"""What limbs bear: against inverse dynamics with an external force, and against two links by hand."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.strength import largest_force_N, sole_torsion, strengths_in_box
from mcplan.files.urdf import load_model, robot_from_urdf
from mcplan.files.urdf_limbs import limb_of
from mcplan.files.urdf_setups import SETUPS, End
from test_files_urdf import ONE_LEG

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")
G = 9.81
UP = np.array([0.0, 0.0, 1.0])


@pytest.fixture(scope="module", params=sorted(SETUPS))
def loaded(request):
    setup = SETUPS[request.param]
    model, posture, _ = load_model(request.param, setup.ends)
    return mp.load_robot(request.param), setup, model, posture


def torques(limb, joints, force_W, moment_W=(0.0, 0.0, 0.0)):
    """Of the limb's joints at rest [N m], with a force and a moment on its contact point, by inverse dynamics."""
    model, q = limb.model, np.concatenate([limb.base, joints])
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    frame = model.frames[limb.frame]
    point = pin.SE3(np.eye(3), data.oMf[limb.frame].translation)
    on_joint = data.oMi[frame.parentJoint].actInv(point).act(pin.Force(np.asarray(force_W), np.asarray(moment_W)))
    external = pin.StdVec_Force()
    external.extend([pin.Force.Zero() for _ in range(model.njoints)])
    external[frame.parentJoint] = on_joint
    zero = np.zeros(model.nv)
    return pin.rnea(model, data, q, zero, zero, external)[6:]


def test_the_largest_force_brings_one_joint_to_its_limit(loaded):
    _, setup, model, posture = loaded
    rng = np.random.default_rng(5)
    for end in setup.ends:
        limb = limb_of(model, posture, end, setup.ends)
        limits = limb.model.effortLimit[6:]
        for _ in range(20):
            joints, push = rng.uniform(limb.lower, limb.upper), rng.normal(size=3)
            push /= np.linalg.norm(push)
            q = np.concatenate([limb.base, joints])
            force, weak = largest_force_N(limb.model, limb.model.createData(), limb.frame, q, push)
            if force == 0.0:  # the limb does not even bear itself
                assert (np.abs(torques(limb, joints, np.zeros(3))) > limits).any()
                continue
            used = np.abs(torques(limb, joints, -force * push)) / limits
            assert used.max() == pytest.approx(1.0, abs=1e-9), (end.name, joints, push)
            assert limb.model.names[2 + int(np.argmax(used))] == weak


def test_half_of_the_postures_bear_the_cap(loaded):
    """Points on a grid, postures from other starts: the median was not one of the draw."""
    robot, setup, model, posture = loaded
    rng = np.random.default_rng(8)
    shares = {"foot": np.linspace(0.06, 0.94, 5)[:, None], "hand": np.linspace(0.1, 0.9, 4)[:, None]}
    for number, end in enumerate(robot.end_effectors):
        limb = limb_of(model, posture, setup.ends[number], setup.ends)
        foot = end.kind == "foot"
        axes = list((end.reach_min_B + shares[end.kind] * (end.reach_max_B - end.reach_min_B)).T)
        if foot:
            axes[2] = end.nominal_B[2:]  # standing
        bears = []
        for target in np.array(np.meshgrid(*axes)).reshape(3, -1).T:
            starts = (rng.uniform(limb.lower, limb.upper), limb.nominal)
            joints = next((j for start in starts if (j := limb.solve(target, start)) is not None), None)
            if joints is not None:
                pulls = [UP, -target / np.linalg.norm(target)] if foot else [UP]
                used = [
                    np.abs(torques(limb, joints, end.max_force * pull)) / limb.model.effortLimit[6:] for pull in pulls
                ]
                bears.append(min(use.max() for use in used) <= 1.0)
        assert len(bears) >= 20
        assert 0.35 < np.mean(bears) < 0.75, (robot.name, end.name, np.mean(bears))


def test_one_leg_in_its_posture_bears_the_robot(loaded):
    robot, setup, model, posture = loaded
    weight = robot.mass * G
    for number, end in enumerate(robot.end_effectors):
        if end.kind == "foot":
            assert end.max_force > weight
            limb = limb_of(model, posture, setup.ends[number], setup.ends)
            turn = [0.0, 0.0, end.max_moment[2]]
            for moment in (turn, [-part for part in turn]):
                assert (np.abs(torques(limb, limb.nominal, weight * UP, moment)) < limb.model.effortLimit[6:]).all()


def test_hands_of_talos_bear_a_tenth_of_its_weight():
    """As measured apart from this code: a push straight down of 77 to 92 N in the median posture beside the body."""
    robot = mp.load_robot("talos")
    for hand in ("right_hand", "left_hand"):
        cap = robot.end_effectors[robot.end_effector_index(hand)].max_force
        assert 0.10 < cap / (robot.mass * G) < 0.15


def planar_leg(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest upward forces [N] of ONE_LEG by hand over a fine grid of joint angles with the foot in a box; weight of each.

    Two links of 0.4 m with 1 kg in the middle of each on a body of 4 kg: with e(a) = (-sin a, -cos a) the foot is at
    0.4 e(hip) + 0.4 e(hip + knee), the CoM at 0.1 e(hip) + 0.2/6 e(hip + knee). An area dx dz of the foot's positions
    relative to the CoM is 0.3 x 0.3667 |sin knee| d(hip) d(knee).
    """
    hip, knee = np.meshgrid(np.linspace(-2.0, 2.0, 1601), np.linspace(-0.1, 2.5, 1041), indexing="ij")
    shank = hip + knee
    x = -0.3 * np.sin(hip) - 0.36667 * np.sin(shank)
    z = -0.3 * np.cos(hip) - 0.36667 * np.cos(shank)
    inside = (x >= low[0]) & (x <= high[0]) & (z >= low[2]) & (z <= high[2]) & (knee > 0.0)
    sin_hip, sin_shank, sin_knee = np.sin(hip[inside]), np.sin(shank[inside]), np.sin(knee[inside])
    to_knee, to_foot = -0.4 * sin_hip, -0.4 * sin_hip - 0.4 * sin_shank  # levers about the hip
    weights = [G * (0.5 * to_knee + to_knee - 0.2 * sin_shank), G * -0.2 * sin_shank]
    forces = np.full(to_foot.shape, np.inf)
    for lever, weight in zip([to_foot, to_foot - to_knee], weights, strict=True):
        # |lever F - weight| <= 50 N m
        forces = np.minimum(forces, (50.0 + np.sign(lever) * weight) / np.maximum(np.abs(lever), 1e-12))
    return forces, sin_knee


def test_forces_of_a_planar_leg_are_those_by_hand(tmp_path):
    path = tmp_path / "hopper.urdf"
    path.write_text(ONE_LEG)
    ends = (End("foot", "shank", frame_offset=(0.0, 0.0, -0.4)),)
    model, posture, _ = load_model(str(path), ends, posture={"hip": -0.5, "knee": 1.0})
    limb = limb_of(model, posture, ends[0], ends)
    low, high = np.array([-0.1, 0.0, -0.62]), np.array([0.2, 0.0, -0.45])
    found = strengths_in_box(limb, low, high, points=400, seed=3)
    assert len(found) > 400
    forces, share = planar_leg(low, high)
    order = np.argsort(forces)
    cumulated = np.cumsum(share[order]) / share.sum()
    for part in (0.25, 0.5, 0.75):
        # Of 400 points the quantile is one of the true ones within three times 0.5 / sqrt(400).
        least, most = (forces[order][np.searchsorted(cumulated, part + away)] for away in (-0.075, 0.075))
        assert least < np.quantile(found, part) < most


def test_a_foot_that_only_one_posture_reaches_gets_the_force_of_that(tmp_path):
    """The leg of one plane has no box but its nominal point. The force that points at the CoM has the shorter lever at the knee.

    With hip -0.5 and knee 1.0 the knee is at (0.4 sin 0.5, -0.4 cos 0.5) of the hip, the foot below the hip, twice as far down.
    """
    path = tmp_path / "hopper.urdf"
    path.write_text(ONE_LEG)
    foot = End("foot", "shank", frame_offset=(0.0, 0.0, -0.4))
    robot = robot_from_urdf(str(path), (foot,), posture={"hip": -0.5, "knee": 1.0}, step=0.05)
    sin, cos = np.sin(0.5), np.cos(0.5)
    com = np.array([0.3 * sin - 0.36667 * sin, -0.3 * cos - 0.36667 * cos])  # of the foot against it, x and z
    direction = -com / np.linalg.norm(com)
    lever = 0.4 * cos * -direction[0] + 0.4 * sin * direction[1]  # z fx - x fz about y, of the foot against the knee
    force = (50.0 + G * 0.2 * sin) / lever
    assert lever < 0.4 * sin
    assert force - 10.0 <= robot.end_effectors[0].max_force <= force + 0.5
    assert robot.end_effectors[0].yaw_range.tolist() == [-np.inf, np.inf]  # a point has no heading


def test_a_box_out_of_reach_has_no_forces(loaded):
    _, setup, model, posture = loaded
    limb = limb_of(model, posture, setup.ends[0], setup.ends)
    assert len(strengths_in_box(limb, np.full(3, 5.0), np.full(3, 5.1), points=3)) == 0


def test_torsion_of_a_sole_is_that_of_the_disc_in_it():
    half, force, friction = (0.10, 0.06), 443.0, 0.35
    radius = np.linspace(0.0, 0.06, 4001)
    middle = 0.5 * (radius[1:] + radius[:-1])
    pressure = force / (np.pi * 0.06**2)
    moment = np.sum(friction * pressure * middle * 2.0 * np.pi * middle * np.diff(radius))
    assert sole_torsion(half, force, friction) == pytest.approx(moment, rel=1e-6)
    # All of the sole, pressed down evenly, bears more.
    x, y = np.meshgrid(np.linspace(-0.10, 0.10, 201), np.linspace(-0.06, 0.06, 121))
    assert sole_torsion(half, force, friction) < friction * force * np.mean(np.hypot(x, y))
    assert sole_torsion((0.0, 0.0), force, friction) == 0.0
