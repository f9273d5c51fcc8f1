"""Options out of range are named; pushes act when and where they are to."""

from dataclasses import fields

import numpy as np
import pytest

import mcplan as mp
from mcplan.tracking import Gains, Options, Push

NAN, INF = float("nan"), float("inf")

WRONG = [
    ("simulation_step_s", [0.0, -0.001, 1e-9, 0.9e-5, 0.0051, NAN, INF]),
    ("control_step_s", [0.0005, 0.0015, 0.0, -0.002, 0.051, 1.0, NAN, INF]),
    ("mass_scale", [0.19, 5.1, 0.0, -1.0, NAN, INF]),
    ("friction_scale", [0.0, -0.1, 10.1, NAN, INF]),
    ("ground_shift_m", [0.21, -0.21, NAN, INF]),
    ("hold_s", [-0.1, 60.1, NAN, INF]),
    ("seed", [-1]),
    ("noise_seed", [-1]),
    ("torque_bandwidth_hz", [0.5, -1.0, 1001.0, NAN, INF]),
    ("torque_delay_s", [-0.001, 0.051, NAN, INF]),
    ("sensor_noise", [-0.1, 101.0, NAN, INF]),
]


def refused(**values):
    with pytest.raises(mp.errors.InvalidOptions) as found:
        Options(**values).validate()
    return found.value


def test_the_defaults_are_accepted():
    Options().validate()


@pytest.mark.parametrize(("field", "value"), [(field, value) for field, values in WRONG for value in values])
def test_a_number_out_of_range_is_named(field, value):
    error = refused(**{field: value})
    assert error.field == field and error.rule and error.value == str(value)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("simulation_step_s", 0.002),
        ("simulation_step_s", 1e-5),
        ("control_step_s", 0.001),
        ("control_step_s", 0.004),
        ("control_step_s", 0.05),
        ("mass_scale", 0.2),
        ("mass_scale", 5.0),
        ("friction_scale", 10.0),
        ("ground_shift_m", -0.2),
        ("hold_s", 0.0),
        ("seed", 7),
        ("pushes", (Push(-40.0, 1.1, -1.0),)),
    ],
)
def test_the_ends_of_ranges_are_accepted(field, value):
    Options(**{field: value}).validate()


@pytest.mark.parametrize(
    ("push", "field"),
    [
        (Push(NAN, 0.2, 1.0), "force_N"),
        (Push(INF, 0.2, 1.0), "force_N"),
        (Push(40.0, INF, 1.0), "duration_s"),
        (Push(40.0, -0.1, 1.0), "duration_s"),
        (Push(40.0, 0.2, NAN), "at_s"),
        (Push(40.0, 0.2, 1.0, INF), "direction_deg"),
    ],
)
def test_a_push_that_cannot_be_meant_is_named_with_its_place(push, field):
    assert refused(pushes=(Push(40.0, 0.2, 1.0), push)).field == f"pushes[1].{field}"


@pytest.mark.parametrize("name", [item.name for item in fields(Gains)])
def test_a_gain_out_of_range_is_named(name):
    for value in (NAN, INF, -INF, -1e6, -1e-9, 1.1e6, "much", None):
        error = refused(gains=Gains(**{name: value}))
        assert (error.field, error.rule) == (f"gains.{name}", "must be a number in 0 to 1e+06")
    for value in (0, 1e6, np.float64(3.0)):
        Options(gains=Gains(**{name: value})).validate()


def test_a_push_that_does_not_act_in_the_run_is_refused():
    ends = Push(40.0, 0.2, 2.9), Push(40.0, 0.2, -0.1), Push(40.0, 0.0, 0.0)
    Options(pushes=ends).require_pushes_within(3.0)
    for at_s, rule in ((3.0, "before the end of the run, 3 s"), (1e9, "before the end"), (-0.2, "before the start")):
        with pytest.raises(mp.errors.InvalidOptions, match=rule) as found:
            Options(pushes=(*ends, Push(40.0, 0.2, at_s))).require_pushes_within(3.0)
        assert found.value.field == "pushes[3].at_s"


def test_such_a_push_is_refused_before_anything_is_simulated():
    plan = mp.plan("flat", "talos", phases=6, max_iterations=5, restarts=0).plan
    with pytest.raises(mp.errors.InvalidOptions, match=r"pushes\[0\].at_s: must lie before the end of the run"):
        mp.track(plan, pushes=[(40.0, 0.2, plan.duration() + 1.0, 90.0)])


def test_a_push_acts_from_its_time_for_its_duration():
    push = Push(40.0, 0.2, 1.0)
    for time_s, acts in ((0.0, 0.0), (0.998, 0.0), (0.999, 0.5), (1.0, 1.0), (1.1, 1.0), (1.198, 1.0), (1.21, 0.0)):
        assert np.linalg.norm(push.force_W(time_s, 0.002)) == pytest.approx(40.0 * acts)


@pytest.mark.parametrize(("duration_s", "at_s"), [(0.001, 0.301), (0.001, 0.3), (0.003, 0.301), (0.1, 0.2), (0.2, 0.1)])
def test_the_impulse_of_a_push_is_its_own_whenever_it_begins(duration_s, at_s):
    push, step_s = Push(100.0, duration_s, at_s), 0.002
    forces = np.array([push.force_W(n * step_s, step_s) for n in range(300)])
    assert step_s * np.linalg.norm(forces, axis=1).sum() == pytest.approx(100.0 * duration_s, rel=1e-5)
    acts = np.linalg.norm(forces, axis=1) > 0.0
    assert acts.sum() <= np.ceil(round(duration_s / step_s, 6)) + 1


@pytest.mark.parametrize(("angle", "towards"), [(0, [1, 0, 0]), (90, [0, 1, 0]), (180, [-1, 0, 0]), (-90, [0, -1, 0])])
def test_a_push_points_where_its_angle_says(angle, towards):
    np.testing.assert_allclose(Push(10.0, 1.0, 0.0, angle).force_W(0.5, 0.002), 10.0 * np.array(towards), atol=1e-12)
