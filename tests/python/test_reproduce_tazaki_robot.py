"""mcplan_bench.reproduce.tazaki_robot and tazaki_tracking: the robot of 44 kg, and how plans are followed by it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench.reproduce import tazaki_robot, tazaki_tracking
from mcplan_bench.reproduce.tazaki_tracking import Run


@pytest.fixture(scope="module")
def robot(tmp_path_factory):
    return tazaki_robot.write_robot(tmp_path_factory.mktemp("robot"))


def test_it_has_the_papers_mass_and_joints():
    bodies = tazaki_robot.parts()
    com, mass = tazaki_robot.center_of_mass(bodies)
    assert mass == pytest.approx(44.0, abs=1e-12)
    assert sum(bool(body.parent) for body in bodies) == 30
    assert (
        sum(body.name.startswith("left_") for body in bodies) == sum(b.name.startswith("right_") for b in bodies) == 13
    )
    assert com[1] == pytest.approx(0.0, abs=1e-12)


def test_pinocchio_finds_the_soles_hands_and_com_of_the_robot_that_is_planned_for(robot):
    pin = pytest.importorskip("pinocchio")
    from mcplan.kinematics.urdf_model import load_model

    planned = mp.load_robot(tazaki_robot.PLANNED_FOR)
    read = load_model(robot)
    model, data = read.model, read.model.createData()
    com = pin.centerOfMass(model, data, read.neutral)
    pin.updateFramePlacements(model, data)
    assert data.mass[0] == pytest.approx(44.0, abs=1e-9)
    for end, same, frame in zip(robot.end_effectors, planned.end_effectors, read.frames, strict=True):
        assert data.oMf[frame].translation - com == pytest.approx(np.asarray(same.nominal_B), abs=1e-9)
        assert list(end.half_size) == list(same.half_size) and end.kind == same.kind
    assert robot.com_height == planned.com_height == pytest.approx(com[2] - data.oMf[read.frames[0]].translation[2])
    pin.ccrba(model, data, read.neutral, np.zeros(model.nv))
    inertia = np.diag(data.Ig.inertia)
    assert (inertia < 5.6).all()  # what the page says of it
    low, high = model.lowerPositionLimit[7:], model.upperPositionLimit[7:]
    assert ((low <= read.neutral[7:]) & (read.neutral[7:] <= high)).all()


def test_legs_are_long_enough_for_the_reach_boxes(robot):
    """From the hip, which is below the CoM, to the ankle above the sole in the farthest corner."""
    foot = robot.end_effectors[robot.end_effector_index("left_foot")]
    hip = np.array([0.0, tazaki_robot.HIP_Y, tazaki_robot.HIP_HEIGHT - robot.com_height])
    for corner in (foot.reach_min_B, foot.reach_max_B):
        for z in (foot.reach_min_B[2], foot.reach_max_B[2]):
            ankle = np.array([corner[0], corner[1], z + tazaki_robot.ANKLE_HEIGHT])
            assert np.linalg.norm(ankle - hip) < tazaki_robot.THIGH + tazaki_robot.SHANK


def test_right_limits_mirror_left_ones(robot):
    pin = pytest.importorskip("pinocchio")
    model = pin.buildModelFromUrdf(robot.urdf)
    range_of = {
        name: (model.lowerPositionLimit[j], model.upperPositionLimit[j]) for j, name in enumerate(model.names[1:])
    }
    assert range_of["right_hip_roll"] == (-range_of["left_hip_roll"][1], -range_of["left_hip_roll"][0])
    assert range_of["right_knee"] == range_of["left_knee"] == (0.0, 2.5)


def test_the_papers_help_is_inertia_of_the_pelvis_alone(tmp_path):
    pin = pytest.importorskip("pinocchio")
    free, held = tazaki_robot.write_robot(tmp_path), tazaki_robot.write_robot(tmp_path, 1000.0)
    assert (free.name, held.name) == ("humanoid44_joints", "humanoid44_joints_held")
    bases, others = [], []
    for robot in (free, held):
        model = pin.buildModelFromUrdf(robot.urdf, pin.JointModelFreeFlyer())
        bases.append(model.inertias[1])
        others.append([inertia.inertia for inertia in model.inertias[2:]])
    assert bases[1].inertia - bases[0].inertia == pytest.approx(1000.0 * np.eye(3))
    assert bases[1].mass == bases[0].mass
    assert np.array(others[0]) == pytest.approx(np.array(others[1]))


def test_the_simulated_robot_weighs_as_much(robot):
    pytest.importorskip("mujoco")
    pytest.importorskip("pinocchio")
    from mcplan.tracking import mujoco_model

    model = mujoco_model.build(robot, mp.load_scene("flat"))
    assert float(model.mj.body_mass.sum()) == pytest.approx(44.0, abs=1e-9)
    assert len(model.joints) == 30


def row_of(**values: object) -> dict[str, object]:
    blank = dict.fromkeys(tazaki_tracking.MEASURED)
    return {"scene": "gap", "plan": "ours", "setup": "free", "planned": "solved", **blank, **values}


def test_a_fall_is_told_with_what_was_seen():
    fall = row_of(
        fell=True,
        completed_s=3.125,
        duration_s=5.59,
        off_at_s=2.75,
        off_contacts="right_foot left_hand",
        off_limited="left_knee neck_yaw",
    )
    assert tazaki_tracking.ending(fall) == "fell at 3.12 s of 5.59 s"
    text = " ".join(line.strip() for line in tazaki_tracking.falls([fall, row_of(planned="infeasible")]))
    assert "50 mm off its plan from 2.75 s on" in text
    assert "right foot, left hand;" in text and "left_knee, neck_yaw." in text
    *_, last = tazaki_tracking.table([row_of(planned="infeasible")])
    assert last.startswith("| gap | ours | none | plan infeasible | - |")


def test_all_scenes_are_followed_with_and_without_help():
    chosen = tazaki_tracking.runs(("flat", "gap"), quick=False)
    assert len(chosen) == 2 * len(tazaki_tracking.PLANS) * 2 == len(set(chosen))
    assert len(tazaki_tracking.runs(("flat", "gap"), quick=True)) == 1
    assert tazaki_tracking.drawn(Run("gap", "ours", "held"), False)
    assert tazaki_tracking.drawn(Run("gap", "ours", "free"), True)
    assert not tazaki_tracking.drawn(Run("gap", "ours", "free"), False)


def test_a_snapshot_is_taken_in_the_middle_of_the_flight():
    times = np.arange(0.0, 4.001, 0.01)
    contacts = np.zeros((len(times), 2), int)
    contacts[(times > 1.9) & (times < 2.3)] = -1
    ends = [SimpleNamespace(kind="foot"), SimpleNamespace(kind="foot")]
    plan = SimpleNamespace(robot=SimpleNamespace(end_effectors=ends))
    result = SimpleNamespace(recording=SimpleNamespace(times_s=times, contacts_plan=contacts, plan=plan))
    chosen = tazaki_tracking.instants(result)
    assert len(chosen) == tazaki_tracking.FRAMES and chosen == sorted(chosen)
    assert any(abs(t - 2.1) < 0.01 for t in chosen)
    contacts[:] = 0
    assert tazaki_tracking.instants(result) == pytest.approx(np.linspace(0.0, 4.0, tazaki_tracking.FRAMES))


@pytest.mark.slow
def test_plans_are_followed_with_the_papers_help_on_all_scenes(tmp_path):
    """As in the paper. Without it the walks are followed, and the rest is told as it is."""
    pytest.importorskip("mujoco")
    pytest.importorskip("proxsuite")
    robots = {setup: tazaki_robot.write_robot(tmp_path, 1000.0 * (setup == "held")) for setup in tazaki_tracking.SETUPS}
    for scene in ("flat", "stairs", "gap", "gap_with_rail"):
        for setup in ("held", "free") if scene in ("flat", "stairs") else ("held",):
            run = Run(scene, "ours", setup)
            row, _ = tazaki_tracking.follow(run, tazaki_tracking.plan_for(run, robots["free"]), robots[setup])
            assert row["fell"] is False, (scene, setup, tazaki_tracking.ending(row))
