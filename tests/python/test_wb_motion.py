"""Motions: their splines against SciPy's, their velocities against differences, their torques against Pinocchio's, files."""

from __future__ import annotations

import io
import pickle
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from mcplan.errors import InvalidInput, InvalidPlan, InvalidRobot
from mcplan.wb import Motion, splines
from standing import standing_plan

BENCH = Path(__file__).resolve().parents[2] / "bench/mcplan_bench"

pin = pytest.importorskip("pinocchio")
interpolate = pytest.importorskip("scipy.interpolate")


@pytest.fixture(scope="module")
def plan() -> mp.Plan:
    return mp.plan("flat", "talos", time_limit=5.0).plan


@pytest.fixture(scope="module")
def motion(plan: mp.Plan) -> Motion:
    return some_motion(plan)


def some_motion(plan: mp.Plan) -> Motion:
    """Any motion: random coefficients and forces, of no use but to be evaluated."""
    from mcplan.kinematics.urdf_model import load_model

    rng, ends = np.random.default_rng(0), len(plan.robot.end_effectors)
    names = list(load_model(plan.robot).model.names)[2:]
    locked = {name: 0.1 for name in names if "gripper" in name or "head" in name}
    nodes, end = 40, plan.duration()
    return Motion(
        plan=plan,
        urdf=plan.robot.urdf,
        joints=tuple(name for name in names if name not in locked),
        locked=locked,
        times_s=np.sort(np.r_[0.0, rng.uniform(0.0, end, nodes - 1), end]),
        coefficients=rng.normal(0.0, 0.3, (nodes + 3, 6 + len(names) - len(locked))),
        corner_points_S=rng.normal(0.0, 0.1, (ends, 4, 3)),
        corner_forces_S=rng.normal(0.0, 100.0, (nodes + 1, ends, 4, 3)),
        contacts=np.zeros((nodes, ends)),
    )


def changed(motion: Motion, **values: object) -> Motion:
    return Motion(**{**motion.__getstate__(), **values})


def test_splines_are_those_of_scipy(motion: Motion) -> None:
    times = np.random.default_rng(1).uniform(0.0, motion.duration(), 300)
    theirs = interpolate.BSpline(splines.knots_of(motion.times_s), motion.coefficients, 3)
    values, velocities, accelerations = motion.coordinates(times)
    np.testing.assert_allclose(values, theirs(times), atol=1e-12)
    np.testing.assert_allclose(velocities, theirs.derivative(1)(times), atol=1e-11)
    np.testing.assert_allclose(accelerations, theirs.derivative(2)(times), atol=1e-9)


def test_splines_through_values_start_and_end_at_rest(motion: Motion) -> None:
    values = np.random.default_rng(2).normal(size=(len(motion.times_s), 3))
    found, velocities, _ = splines.at_nodes(motion.times_s, splines.interpolating(motion.times_s, values))
    np.testing.assert_allclose(found, values, atol=1e-12)
    np.testing.assert_allclose(velocities[[0, -1]], 0.0, atol=1e-12)


def test_velocity_and_acceleration_are_derivatives(motion: Motion) -> None:
    times, step = np.random.default_rng(3).uniform(0.01, motion.duration() - 0.01, 100), 1e-6
    (q0, v0, _), (_, v, a), (q1, v1, _) = (motion.trajectory(times + d) for d in (-step, 0.0, step))
    slopes = [pin.difference(motion.model.model, x, y) / (2.0 * step) for x, y in zip(q0, q1, strict=True)]
    np.testing.assert_allclose(v, slopes, atol=1e-6)
    np.testing.assert_allclose(a, (v1 - v0) / (2.0 * step), atol=1e-5)


@pytest.mark.parametrize("robot", ["talos", "g1", "anymal", "go2", BENCH / "romeo.toml"])
def test_wrenches_and_torques_balance_the_motion(robot: str | Path) -> None:
    """M a + b = S^T tau + sum_l J_l^T w_l + the residual, with Jacobians in the world's axes."""
    motion = some_motion(standing_plan(robot=mp.load_robot(robot)))
    model, samples = motion.model.model, motion.sample(np.linspace(0.0, motion.duration(), 20))
    data = model.createData()
    for k in range(len(samples)):
        state = samples.state(k)
        pin.computeJointJacobians(model, data, state.q)
        pin.updateFramePlacements(model, data)
        sides = pin.crba(model, data, state.q) @ state.a + pin.nle(model, data, state.q, state.v)
        for end, frame in enumerate(motion.model.frames):
            jacobian = pin.getFrameJacobian(model, data, frame, pin.LOCAL_WORLD_ALIGNED)
            sides -= jacobian.T @ state.wrenches_W[end]
            np.testing.assert_allclose(state.end_effectors_W[end], data.oMf[frame].translation, atol=1e-12)
        np.testing.assert_allclose(sides, np.concatenate([state.base_residual_B, state.tau]), atol=1e-6)


def test_a_reduced_model_weighs_and_moves_as_the_complete_one(motion: Motion) -> None:
    samples = motion.sample([0.3])
    whole = motion.model.complete.model
    q = motion.model.complete_configurations(samples.q)[0]
    np.testing.assert_allclose(pin.centerOfMass(whole, whole.createData(), q), samples.com_W[0], atol=1e-12)
    for name, position in motion.locked.items():
        assert q[whole.idx_qs[whole.getJointId(name)]] == position
    assert (motion.model.model.armature[6:] > 0.0).all()


def test_at_is_sample_and_refuses_times_outside(motion: Motion) -> None:
    state = motion.at(0.7)
    np.testing.assert_array_equal(state.tau, motion.sample([0.7]).tau[0])
    assert motion.at(motion.duration()).time_s == motion.plan.duration()
    with pytest.raises(InvalidInput, match=r"t: must lie in \[0, "):
        motion.at(-0.1)
    with pytest.raises(InvalidInput, match=r"times\[1\]: must lie in \[0, "):
        motion.sample([0.0, 99.0])


def test_files_hold_the_same_motion(motion: Motion, tmp_path: Path) -> None:
    motion.save(tmp_path / "motion.npz")
    read = Motion.load(tmp_path / "motion.npz")
    assert read == motion
    assert (tmp_path / "motion.npz").read_bytes() == read.to_bytes()
    assert pickle.loads(pickle.dumps(motion)) == motion
    forces = motion.corner_forces_S.copy()
    forces[3, 0, 0, 0] += 1e-9
    assert changed(motion, corner_forces_S=forces) != motion


@pytest.mark.parametrize(
    ("name", "make", "message"),
    [
        ("times_s", lambda a: a[::-1], r"times_s\[0\]: must ascend|times_s\[1\]: must ascend"),
        ("times_s", lambda a: a * 0.9, r"times_s\[40\]: must be .* s, got"),
        ("coefficients", lambda a: a[1:], r"coefficients: must have shape \(43, 34\), got \(42, 34\)"),
        ("corner_forces_S", lambda a: a * np.nan, r"corner_forces_S\[0\]\[0\]\[0\]\[0\]: must be finite, got nan"),
        ("contacts", lambda a: a + 7, r"contacts\[0\]\[0\]: must lie in \[-1, 0\], got 7"),
        (
            "contacts",
            lambda a: a.astype(np.int64) + 2**32,
            r"contacts\[0\]\[0\]: must be the index of a surface, or -1, got",
        ),
        ("coefficients", lambda a: a * 1e308, r"coefficients\[0\]\[0\]: must (lie within|be finite)"),
        ("corner_forces_S", lambda a: a + 1e10, r"corner_forces_S\[0\]\[0\]\[0\]\[0\]: must lie within 1e\+09 N, got"),
        ("corner_points_S", lambda a: "points", "corner_points_S: must be an array of real numbers, got"),
        ("coefficients", lambda a: a * 1j, "coefficients: must be an array of real numbers, got"),
        ("contacts", lambda a: a + 0.5, r"contacts\[0\]\[0\]: must be the index of a surface, or -1, got 0.5"),
        ("contacts", lambda a: a * np.nan, r"contacts\[0\]\[0\]: must be the index of a surface, or -1, got nan"),
        ("urdf", lambda a: None, "urdf: must be a string, got None"),
        ("joints", lambda a: None, "joints: must be a sequence of names, got None"),
        ("locked", lambda a: list(a), "locked: must be a mapping of names to positions, got"),
        ("plan", lambda a: a.robot, 'plan: must be a Plan, got "Robot"'),
        ("locked", lambda a: a | {"gripper_left_joint": 10**400}, "locked.gripper_left_joint: must be a number, got"),
        (
            "locked",
            lambda a: a | {"gripper_left_joint": 1e9},
            r"locked.gripper_left_joint: must lie within 1e\+06 rad or m",
        ),
        ("joints", lambda a: a[:1] * 28, "joints: must be named once"),
    ],
)
def test_what_does_not_fit_is_named(motion: Motion, name: str, make: object, message: str) -> None:
    with pytest.raises(InvalidPlan, match=message):
        changed(motion, **{name: make(getattr(motion, name))})


def test_bytes_of_a_plan_that_are_none_are_refused(motion: Motion) -> None:
    """As int64 they would be cut to the bytes that they end with."""
    arrays = dict(np.load(io.BytesIO(motion.to_bytes())))
    arrays["plan"] = arrays["plan"].astype(np.int64) + 256
    file = io.BytesIO()
    np.savez(file, **arrays)
    with pytest.raises(InvalidPlan, match=r"plan: must be bytes \(uint8\), got int64"):
        Motion.from_bytes(file.getvalue())


def test_what_is_no_file_and_no_time_is_refused(motion: Motion) -> None:
    for content in ("x", None):
        with pytest.raises(InvalidPlan, match="must be the bytes of a motion's file"):
            Motion.from_bytes(content)
    with pytest.raises(InvalidInput, match="times: must be an array of numbers"):
        motion.sample([10**400])
    with pytest.raises(InvalidInput, match="t: must lie in"):
        motion.at(True)


def test_a_urdf_of_a_name_that_no_file_has_is_refused(motion: Motion) -> None:
    long = changed(motion, urdf="x" * 5000)
    for use in (long.check, lambda: long.at(0.0)):
        with pytest.raises(InvalidRobot, match="urdf: must be a readable URDF"):
            use()


def test_files_of_other_kinds_are_refused(motion: Motion, plan: mp.Plan, tmp_path: Path) -> None:
    plan.save(tmp_path / "plan.npz")
    with pytest.raises(InvalidPlan, match='plan.npz: header.kind: must be "motion", got none'):
        Motion.load(tmp_path / "plan.npz")
    motion.save(tmp_path / "motion.npz")
    with pytest.raises(InvalidPlan, match="motion.npz: must be a plan, got a motion along one"):
        mp.Plan.load(tmp_path / "motion.npz")


def test_joints_must_be_those_of_the_urdf(motion: Motion) -> None:
    locked = {**motion.locked, "no_joint": 0.0}
    with pytest.raises(InvalidPlan, match='locked: must name joints of the URDF, got "no_joint"'):
        changed(motion, locked=locked).at(0.0)
    with pytest.raises(InvalidPlan, match="joints: must be all joints of the URDF that are not locked, in its order"):
        changed(motion, joints=motion.joints[::-1]).at(0.0)
