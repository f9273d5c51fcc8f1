"""Measures of recordings made by hand, whose numbers are known."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mcplan.tracking import Measures, Recording
from mcplan.tracking.measures import SETTLE_S, measure, swinging, with_touches
from mcplan.tracking.touches import Touch
from standing import standing_plan

N, DT, JOINTS = 400, 0.002, 3
FOOT, OTHER = 0, 1


@pytest.fixture(scope="module")
def plan():
    return standing_plan()


@pytest.fixture
def perfect(plan):
    """A run in which everything is where the plan has it; two feet stand, one hand is free."""
    configurations = np.zeros((N, 7 + JOINTS))
    configurations[:, 6] = 1.0
    ends = np.zeros((N, 3, 3))
    contacts_plan = np.tile(np.array([0, 0, -1]), (N, 1))
    return Recording(
        plan=plan,
        joints=("a", "b", "c"),
        times_s=DT * np.arange(N),
        configurations=configurations,
        velocities=np.zeros((N, 6 + JOINTS)),
        torques=np.zeros((N, JOINTS)),
        torque_limits=np.array([10.0, 20.0, 50.0]),
        com_W=np.zeros((N, 3)),
        com_plan_W=np.zeros((N, 3)),
        angular_momentum_W=np.zeros((N, 3)),
        angular_momentum_plan_W=np.zeros((N, 3)),
        base_quat_xyzw_plan=configurations[:, 3:7].copy(),
        end_effectors_W=ends.copy(),
        end_effectors_plan_W=ends.copy(),
        forces_W=np.zeros((N, 3, 3)),
        forces_plan_W=np.zeros((N, 3, 3)),
        contacts=contacts_plan >= 0,
        contacts_plan=contacts_plan,
        assist=np.zeros((N, 6)),
        pushes_W=np.zeros((N, 3)),
        fell_at_s=np.inf,
        velocity_limits=np.array([1.0, 2.0, 0.0]),
    )


def of(recording, **changes) -> Measures:
    changed = replace(recording, **changes)
    return measure(changed, np.zeros(7 + JOINTS))


def test_a_perfect_run_has_no_errors(perfect):
    found = of(perfect)
    assert not found.fell and found.completed_s == pytest.approx((N - 1) * DT)
    for name, value in found.as_dict().items():
        if value is None:
            assert name.startswith(("self_contact", "terrain_contact"))  # links make no contact in a run made by hand
        elif name not in ("fell", "completed_s", "leg_torque_limit_ratio"):  # a URDF says which joints are legs
            assert value == pytest.approx(0.0, abs=1e-9), name


def test_torques_at_their_limits_are_counted_by_steps(perfect):
    torques = np.zeros((N, JOINTS))
    limits = np.array([10.0, 20.0, 0.0])
    torques[3, 0], torques[3, 1], torques[5, 1], torques[7, 0] = 10.0, -20.0, -19.99, 9.98
    found = of(perfect, torques=torques, torque_limits=limits)
    assert found.torque_limit_ratio == pytest.approx(2.0 / N)


def test_numbers_go_into_json(perfect):
    found = json.loads(json.dumps(of(perfect).as_dict()))
    assert set(found) == {item for item in Measures.__dataclass_fields__}


def test_com_errors_are_root_mean_square_and_largest(perfect):
    com = np.zeros((N, 3))
    com[: N // 4] = [0.03, 0.0, 0.04]  # 5 cm for a quarter of the time
    found = of(perfect, com_W=com)
    assert found.com_max_m == pytest.approx(0.05)
    assert found.com_rms_m == pytest.approx(0.025)


def test_the_base_is_turned_by_so_many_degrees_whatever_the_sign_of_quaternions(perfect):
    configurations = perfect.configurations.copy()
    plan = Rotation.from_rotvec([0.2, -0.1, 0.4])
    turned = (Rotation.from_rotvec(np.radians(4.0) * np.array([0.6, 0.0, 0.8])) * plan).as_quat()
    configurations[:, 3:7] = turned
    configurations[::2, 3:7] *= -1.0
    quats = np.tile(plan.as_quat(), (N, 1))
    assert of(perfect, configurations=configurations, base_quat_xyzw_plan=quats).orientation_rms_deg == pytest.approx(
        4.0
    )


def test_a_fall_ends_what_was_completed(perfect):
    found = of(perfect, fell_at_s=(N - 1) * DT)
    assert found.fell and found.completed_s == pytest.approx((N - 1) * DT)


def test_swings_count_from_lift_off_to_landing(perfect):
    contacts = perfect.contacts_plan.copy()
    contacts[100:200, FOOT] = -1
    ends = perfect.end_effectors_W.copy()
    ends[150:200, FOOT] = [0.0, 0.02, 0.0]  # 2 cm for half of the swing
    ends[:100, FOOT] = [0.5, 0.0, 0.0]  # in contact: none of the swing's business
    ends[:, 2] = [9.0, 9.0, 9.0]  # never in contact: nor this
    found = of(perfect, contacts_plan=contacts, end_effectors_W=ends)
    assert found.swing_rms_m == pytest.approx(0.02 / np.sqrt(2))


def test_what_lifts_for_good_does_not_swing():
    plan = np.array([[0, -1, 0, -1], [-1, -1, 0, 0], [-1, 0, 0, -1], [0, 0, 0, -1]])
    expected = [[0, 1, 0, 1], [1, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0]]
    np.testing.assert_array_equal(swinging(plan), np.array(expected, bool))


def test_slip_is_the_longest_way_along_the_surface_in_one_contact(perfect):
    ends = perfect.end_effectors_W.copy()
    ends[:, FOOT, 0] = np.linspace(0.0, 0.0015, N)
    ends[200:300, OTHER] = [0.0018, -0.0024, 0.0]  # 3 mm and back
    ends[:, OTHER, 2] = 0.05 * np.sin(np.arange(N))  # against the surface: no slip
    assert of(perfect, end_effectors_W=ends).slip_m == pytest.approx(0.003)


def test_settling_after_touchdown_is_no_slip_and_contacts_are_apart(perfect):
    contacts, ends = perfect.contacts.copy(), perfect.end_effectors_W.copy()
    contacts[100:200, FOOT] = False
    ends[100:, FOOT, 0] = 0.3  # a step
    settled = round(SETTLE_S / DT)
    ends[200 : 200 + settled, FOOT, 0] = np.linspace(0.29, 0.3, settled)
    assert of(perfect, contacts=contacts, end_effectors_W=ends).slip_m == pytest.approx(0.0)
    ends[300:, FOOT, 0] += 0.001
    assert of(perfect, contacts=contacts, end_effectors_W=ends).slip_m == pytest.approx(0.001)


def test_contact_that_the_plan_does_not_have_is_not_measured(perfect):
    ends, contacts = perfect.end_effectors_W.copy(), perfect.contacts.copy()
    contacts[:, 2] = True
    ends[:, 2, 0] = np.linspace(0.0, 0.5, N)
    assert of(perfect, end_effectors_W=ends, contacts=contacts).slip_m == 0.0


def test_torque_use_is_the_largest_share_of_a_limit(perfect):
    torques = perfect.torques.copy()
    torques[10] = [-9.0, 15.0, 30.0]
    assert of(perfect, torques=torques).torque_use == pytest.approx(0.9)


def test_joints_without_a_motor_use_nothing(perfect):
    torques = perfect.torques.copy()
    torques[10] = [0.0, 15.0, 30.0]
    found = of(perfect, torques=torques, torque_limits=np.array([0.0, 20.0, np.inf]))
    assert found.torque_use == pytest.approx(0.75)


def test_assistance_is_root_mean_square_of_force_and_moment(perfect):
    assist = np.zeros((N, 6))
    assist[: N // 2] = [30.0, 0.0, 40.0, 0.0, 6.0, 8.0]
    found = of(perfect, assist=assist)
    assert found.assist_force_rms_N == pytest.approx(50.0 / np.sqrt(2))
    assert found.assist_moment_rms_Nm == pytest.approx(10.0 / np.sqrt(2))


def test_the_base_ends_so_far_from_the_plan_in_the_ground_plane(perfect):
    configurations = perfect.configurations.copy()
    configurations[-1, :3] = [0.03, -0.04, 0.7]
    assert of(perfect, configurations=configurations).final_base_error_m == pytest.approx(0.05)


def test_a_run_that_fell_at_once_has_measures(perfect):
    first = {
        name: getattr(perfect, name)[:1]
        for name in perfect.__dataclass_fields__
        if isinstance(getattr(perfect, name), np.ndarray) and name != "torque_limits"
    }
    found = of(perfect, **first, fell_at_s=0.0)
    assert found.fell and found.completed_s == 0.0 and found.slip_m == 0.0


def test_speeds_are_taken_over_the_limits_that_there_are(perfect):
    velocities = perfect.velocities.copy()
    velocities[3, 6:] = [-0.5, 1.6, 30.0]  # the third joint has no limit
    assert of(perfect, velocities=velocities).velocity_use == pytest.approx(0.8)
    assert np.isnan(of(perfect, velocity_limits=np.zeros(3)).velocity_use)
    assert np.isnan(of(perfect, velocity_limits=np.zeros(0)).velocity_use)


def test_a_torque_that_steps_is_measured_within_two_milliseconds_whatever_the_control_step(perfect):
    torques = perfect.torques.copy()
    torques[40:, 1] = np.minimum(np.arange(N - 40), 3) * 10.0  # 10, 20 and 30 N m in three steps, of 20
    steps = round(0.002 / DT) if DT <= 0.002 else 1
    assert of(perfect, torques=torques).torque_step_use == pytest.approx(min(3, steps) * 0.5)


def test_touches_are_counted_by_what_is_touched(perfect):
    touches = (
        Touch(("hand", "thigh"), False, 0.1, 0.2, 0.002, 40.0),
        Touch(("hand", "thigh"), False, 0.5, 0.5, 0.003, 10.0),
        Touch(("shin", "tread"), True, 0.3, 0.4, 0.001, 200.0),
    )
    found = with_touches(of(perfect), touches)
    assert (found.self_contacts, found.self_contact_N, found.self_contact_m) == (2, 40.0, 0.003)
    assert (found.terrain_contacts, found.terrain_contact_N) == (1, 200.0)
