"""Whole runs: what is tracked, what falls, what comes early and late, and that a run repeats itself."""

from dataclasses import fields, replace

import numpy as np
import pytest

import mcplan as mp
import tracked
import wrenches
from standing import standing_plan
from stepping import stepping_plan

pin = pytest.importorskip("pinocchio")
pytest.importorskip("mujoco")
pytest.importorskip("proxsuite")
pytest.importorskip("example_robot_data")

from mcplan.tracking import Options, Push, controller, mujoco_model, track  # noqa: E402
from mcplan.tracking.contacts import Mode  # noqa: E402
from mcplan.tracking.runner import robot_for  # noqa: E402

SHORT = Options(hold_s=0.1)


@pytest.fixture(scope="module")
def step():
    """Talos takes a step."""
    return track(tracked.step_ahead(), options=Options(hold_s=0.4))


@pytest.fixture(scope="module")
def rest():
    """A plan of 0.2 s in which Talos stands."""
    return standing_plan(phases=1, duration_s=0.2, robot=mp.load_robot("talos"))


def test_a_step_is_taken_unassisted(step):
    found = step.measures
    assert not found.fell and found.qp_failures == 0 and found.simulator_warnings == 0
    assert found.com_rms_m < 0.005 and found.swing_rms_m < 0.005 and found.slip_m < 0.003
    assert found.torque_use <= 1.0
    assert (found.assist_force_rms_N, found.assist_moment_rms_Nm) == (0.0, 0.0)
    assert found.completed_s == pytest.approx(tracked.step_ahead().duration() + 0.4, abs=0.005)
    assert found.realtime_factor > 0.0 and found.control_ms > 0.0


@pytest.mark.slow
def test_a_turn_on_the_spot_is_followed_by_base_and_soles():
    """60 degrees in two steps: the base is the plan's, not that of postures, and feet land as they are told to head.

    Without what keeps links apart: legs that turn about each other come near to each other, and swings give way then.
    """
    robot = mp.load_robot("talos")
    plan = wrenches.turning(robot, angle=np.radians(60.0), pairs=2)
    apart = track(plan, options=Options(hold_s=0.4)).measures
    assert not apart.fell and apart.self_contacts == 0 and apart.com_rms_m < 0.002
    result = track(plan, options=Options(hold_s=0.4, self_contacts=False))
    found, run = result.measures, result.recording
    assert not found.fell and found.qp_failures == 0 and found.simulator_warnings == 0
    assert found.com_rms_m < 0.002 and found.swing_rms_m < 0.005 and found.slip_m < 0.003
    assert found.orientation_rms_deg < 0.5 and found.final_base_error_m < 0.005
    model = mujoco_model.build(robot, plan.scene).urdf_model
    data = model.model.createData()
    pin.framesForwardKinematics(model.model, data, run.configurations[-1])
    for frame in (data.oMi[1], data.oMf[model.frames[0]], data.oMf[model.frames[1]]):
        x = frame.rotation[:, 0]
        assert np.degrees(np.arctan2(x[1], x[0])) == pytest.approx(60.0, abs=2.5)
    # What turns it is planned to the newton metre: the momentum about the vertical is the plan's.
    error = run.angular_momentum_W[:, 2] - run.angular_momentum_plan_W[:, 2]
    assert np.sqrt(np.mean(error**2)) < 0.25 * run.angular_momentum_plan_W[:, 2].max()


def test_the_recording_is_what_the_robot_did(step):
    run, plan = step.recording, tracked.step_ahead()
    model = mujoco_model.build(run.simulated_robot, plan.scene).urdf_model.model
    data = model.createData()
    np.testing.assert_allclose(np.diff(run.times_s), 0.002, atol=1e-12)
    assert run.joints == tuple(model.names[2:])
    for n in range(0, len(run.times_s), 97):
        pin.centerOfMass(model, data, run.configurations[n], run.velocities[n])
        np.testing.assert_allclose(run.com_W[n], data.com[0], atol=1e-9)
        momentum = pin.computeCentroidalMomentum(model, data, run.configurations[n], run.velocities[n])
        np.testing.assert_allclose(run.angular_momentum_W[n], momentum.angular, atol=1e-8)
    # Velocities are those of the configurations, as far as a step of 2 ms tells.
    for n in range(10, len(run.times_s) - 1, 97):
        moved = pin.difference(model, run.configurations[n], run.configurations[n + 1]) / 0.002
        np.testing.assert_allclose(moved, 0.5 * (run.velocities[n] + run.velocities[n + 1]), atol=0.1)
    # The CoM obeys the contact forces: Newton's law over the run.
    mass = pin.computeTotalMass(model)
    impulse = 0.002 * (run.forces_W.sum(axis=1)[1:] - [0, 0, mass * plan.scene.gravity]).sum(axis=0)
    momenta = [
        pin.computeCentroidalMomentum(model, data, run.configurations[n], run.velocities[n]).linear.copy()
        for n in (0, -1)
    ]
    np.testing.assert_allclose(impulse, momenta[1] - momenta[0], atol=0.02 * mass)
    assert (np.abs(run.torques) <= run.torque_limits).all()
    np.testing.assert_array_equal(run.torque_limits, model.effortLimit[6:])


def test_feet_leave_and_land_when_the_plan_says(step):
    run = step.recording
    for end in range(run.contacts.shape[1]):
        planned = run.contacts_plan[:, end] >= 0
        assert (run.contacts[:, end] != planned).mean() < 0.03


def differing(one, other):
    """Names of the arrays of two recordings that are not the same bytes."""
    arrays = [item.name for item in fields(one) if isinstance(getattr(one, item.name), np.ndarray)]
    assert len(arrays) > 15
    return [name for name in arrays if getattr(one, name).tobytes() != getattr(other, name).tobytes()]


def test_a_run_repeats_itself(rest):
    one, other, changed = (track(rest, options=replace(SHORT, seed=seed)).recording for seed in (3, 3, 4))
    assert differing(one, other) == []
    assert "configurations" in differing(one, changed)


def test_a_robot_too_weak_to_stand_falls_and_that_is_a_result(rest, tmp_path):
    robot = tracked.weakened(mp.load_robot("talos"), 0.1, tmp_path)
    found = track(rest, robot, Options(hold_s=4.0))
    assert found.measures.fell and np.isfinite(found.recording.fell_at_s)
    assert found.measures.completed_s == pytest.approx(found.recording.fell_at_s) and found.measures.completed_s < 3.0
    assert found.measures.qp_failures == 0
    assert len(found.recording.times_s) == len(found.recording.torques) == len(found.recording.end_effectors_plan_W)
    assert (np.abs(found.recording.torques) <= found.recording.torque_limits).all()
    assert np.isfinite(found.recording.configurations).all()
    weak = 0.1 * mujoco_model.build(mp.load_robot("talos"), rest.scene).torque_limits
    np.testing.assert_allclose(found.recording.torque_limits, weak)


@pytest.fixture
def moving_ground(monkeypatch):
    """Runs a step during which, while the foot is in the air, the ground on which it will land moves by a height [m]."""

    def run(height_m):
        plan = stepping_plan(steps=1, scene=tracked.two_lanes(), robot=mp.load_robot("talos"))
        left = plan.robot.end_effector_index("left_foot")
        for phase in plan.phases:
            if phase.contacts[left].surface >= 0:
                phase.contacts[left].surface = 1
        assert list(plan.final_contacts)[left] == 1
        build, step = mujoco_model.build, controller.Controller.step
        models, modes, moved = [], [], []

        def built(*args):
            models.append(build(*args))
            return models[-1]

        def stepped(self, n, *state):
            command = step(self, n, *state)
            modes.append(self.contacts[left].mode)
            if not moved and self.references.returns[n, left] and self.references.swing_fraction[n, left] > 0.3:
                models[-1].mj.geom_pos[models[-1].surface_geoms[1]][2] += height_m
                moved.append(n)
            return command

        monkeypatch.setattr(mujoco_model, "build", built)
        monkeypatch.setattr(controller.Controller, "step", stepped)
        result = track(plan, options=Options(hold_s=0.8))
        assert moved
        planned = result.recording.contacts_plan[:, left] >= 0
        return result, left, planned, np.array(modes)

    return run


def test_ground_that_comes_late_is_searched_for_and_found(moving_ground):
    result, left, planned, modes = moving_ground(-0.03)
    assert not result.measures.fell and result.measures.qp_failures == 0
    searched = modes == Mode.SEARCH
    assert 0.05 < 0.002 * searched.sum() < 0.4
    assert planned[searched].all() and not result.recording.contacts[searched[1:].nonzero()[0], left].any()
    assert modes[-1] is Mode.CONTACT and result.recording.contacts[-1, left]
    assert result.recording.end_effectors_W[-1, left, 2] == pytest.approx(-0.03, abs=0.004)


def test_ground_that_comes_early_bears_at_once(moving_ground):
    result, left, planned, modes = moving_ground(0.02)
    assert not result.measures.fell and result.measures.qp_failures == 0
    early = (modes == Mode.CONTACT) & ~planned
    assert 0.005 < 0.002 * early.sum() < 0.3
    assert not (modes == Mode.SEARCH).any()
    # From the first touch near the end of the swing it stands, without leaving the ground again.
    first = np.flatnonzero(early)[0]
    assert (modes[first:] == Mode.CONTACT).all() and result.recording.contacts[first, left]
    assert result.recording.end_effectors_W[-1, left, 2] == pytest.approx(0.02, abs=0.004)


def test_pushes_and_assistance_are_recorded_and_help(rest):
    push = Push(150.0, 0.2, 0.05, 90.0)
    alone, held = (track(rest, options=Options(hold_s=0.5, pushes=(push,), assist=a)) for a in (False, True))
    pushed = (alone.recording.times_s >= 0.05 - 1e-9) & (alone.recording.times_s < 0.25 - 1e-9)
    np.testing.assert_allclose(alone.recording.pushes_W, pushed[:, None] * np.array([[0.0, 150.0, 0.0]]), atol=1e-9)
    assert not alone.recording.assist.any() and alone.measures.assist_force_rms_N == 0.0
    assert held.measures.assist_force_rms_N > 1.0
    assert held.measures.com_max_m < 0.7 * alone.measures.com_max_m
    rms = np.sqrt(np.mean(np.sum(held.recording.assist[:, :3] ** 2, axis=1)))
    assert held.measures.assist_force_rms_N == pytest.approx(rms)


def test_mass_that_the_controller_does_not_know_of_weighs_on_the_feet(rest):
    found = track(rest, options=Options(hold_s=0.8, mass_scale=1.1))
    force = found.recording.forces_W[-50:].sum(axis=1).mean(axis=0)
    assert force[2] == pytest.approx(1.1 * mp.load_robot("talos").mass * 9.8, rel=0.02)
    assert not found.measures.fell


def test_ground_that_is_elsewhere_is_stood_on(rest):
    found = track(rest, options=Options(hold_s=0.3, ground_shift_m=0.02))
    feet = found.recording.contacts_plan[-1] >= 0
    np.testing.assert_allclose(found.recording.end_effectors_W[0, feet, 2], 0.02, atol=1e-3)
    assert not found.measures.fell


def test_progress_is_told(rest):
    told = []
    track(rest, options=SHORT, progress=lambda now, whole: told.append((now, whole)))
    assert told[0][0] == 0.0 and (np.diff(told, axis=0)[:, 0] > 0).all()
    np.testing.assert_allclose([whole for _, whole in told], 0.3, atol=0.005)


def test_a_saved_plan_is_tracked_like_the_plan(rest, tmp_path):
    rest.save(tmp_path / "rest.npz")
    there, here = track(tmp_path / "rest.npz", options=SHORT), track(rest, options=SHORT)
    assert differing(there.recording, here.recording) == []


def test_the_robot_takes_the_plans_order_of_ends(rest):
    plan = rest
    robot = mp.load_robot("talos")
    robot.end_effectors = list(robot.end_effectors)[::-1]
    found = robot_for(plan, robot)
    assert [e.name for e in found.end_effectors] == [e.name for e in plan.robot.end_effectors]
    assert (found.urdf, found.mass) == (robot.urdf, robot.mass)
    assert robot_for(plan, None) is not None and robot_for(plan, "g1").name == "g1"


WRONG = [
    ("anymal", {}, mp.errors.InvalidRobot, "end_effectors: must have the plan's 'right_foot'"),
    ("humanoid44", {}, mp.errors.InvalidRobot, "urdf: must name a URDF"),
    ("talus", {}, mp.errors.UnknownRobot, "Did you mean 'talos'"),
    (
        None,
        {"control_step_s": 0.0015},
        mp.errors.InvalidOptions,
        "control_step_s: must be a multiple of simulation_step_s",
    ),
    (None, {"mass_scale": 9.0}, mp.errors.InvalidOptions, "mass_scale: must lie in 0.2 to 5"),
]


@pytest.mark.parametrize(("robot", "options", "error", "message"), WRONG)
def test_wrong_input_is_named(rest, robot, options, error, message):
    with pytest.raises(error, match=message):
        track(rest, robot, Options(**options))


def test_a_plan_out_of_reach_is_told_before_it_is_run(rest):
    with pytest.raises(mp.InvalidInput, match="must be in reach of g1"):
        track(rest, "g1")  # whose CoM is far below that of Talos


def test_a_plan_of_another_kind_is_told(tmp_path):
    (tmp_path / "no.npz").write_bytes(b"not a plan")
    with pytest.raises(mp.errors.InvalidPlan):
        track(tmp_path / "no.npz")
