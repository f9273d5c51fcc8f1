"""Disturbances are the same for the same seed, within their ranges, and fill them."""

import numpy as np
import pytest

from mcplan.tracking import Options, Push
from mcplan.tracking.disturbances import (
    BANDWIDTH_HZ,
    DELAY_S,
    FRICTION,
    GROUND_M,
    MASS,
    NOISE,
    PUSH_N,
    PUSH_S,
    PUSHED_MASS,
    disturbed,
)


def test_a_seed_means_always_the_same():
    assert disturbed(Options(), 5, 4.0) == disturbed(Options(), 5, 4.0)
    assert len({disturbed(Options(), seed, 4.0).mass_scale for seed in range(20)}) == 20
    assert disturbed(Options(), 5, 4.0).seed == 5


def test_draws_stay_in_their_ranges_and_reach_most_of_them():
    drawn = [disturbed(Options(), seed, 4.0) for seed in range(300)]
    pushes = [options.pushes[0] for options in drawn]

    def spread(values, low, high):
        values = np.array(list(values))
        assert low <= values.min() and values.max() <= high
        assert values.max() - values.min() > 0.9 * (high - low)
        assert values.mean() == pytest.approx(0.5 * (low + high), abs=0.1 * (high - low))

    spread((o.mass_scale for o in drawn), 1 - MASS, 1 + MASS)
    spread((o.friction_scale for o in drawn), 1 - FRICTION, 1 + FRICTION)
    spread((o.ground_shift_m for o in drawn), -GROUND_M, GROUND_M)
    spread((p.force_N for p in pushes), 0.0, PUSH_N)
    spread((p.at_s for p in pushes), 0.0, 4.0)
    spread((p.direction_deg for p in pushes), 0.0, 360.0)
    spread((o.torque_delay_s for o in drawn), 0.0, DELAY_S)
    spread((o.torque_bandwidth_hz for o in drawn), *BANDWIDTH_HZ)
    spread((o.sensor_noise for o in drawn), 0.0, NOISE)
    assert [o.noise_seed for o in drawn] == list(range(300))
    assert {p.duration_s for p in pushes} == {PUSH_S}
    for options in drawn:
        options.validate()
    # What one draw says of the mass says nothing of the others.
    table = np.array(
        [[o.mass_scale, o.friction_scale, o.ground_shift_m, p.force_N] for o, p in zip(drawn, pushes, strict=True)]
    )
    assert np.abs(np.corrcoef(table.T) - np.eye(4)).max() < 0.2


def test_light_robots_are_pushed_less_and_heavy_ones_no_more():
    force = {mass: disturbed(Options(), 3, 4.0, mass).pushes[0].force_N for mass in (30.0, PUSHED_MASS, 200.0)}
    assert force[30.0] == pytest.approx(force[PUSHED_MASS] / 3)
    assert force[200.0] == force[PUSHED_MASS]


def test_disturbances_come_on_top_of_what_is_asked_for():
    own = Push(10.0, 0.1, 0.5)
    start = Options(mass_scale=1.2, friction_scale=0.5, ground_shift_m=0.03, pushes=(own,), hold_s=0.7, assist=True)
    plain, found = disturbed(Options(), 9, 4.0), disturbed(start, 9, 4.0)
    assert found.mass_scale == pytest.approx(1.2 * plain.mass_scale)
    assert found.friction_scale == pytest.approx(0.5 * plain.friction_scale)
    assert found.ground_shift_m == pytest.approx(0.03 + plain.ground_shift_m)
    assert found.pushes == (own, *plain.pushes)
    lagging = disturbed(Options(torque_delay_s=0.004, torque_bandwidth_hz=10.0, sensor_noise=2.0), 9, 4.0)
    assert lagging.torque_delay_s == pytest.approx(0.004 + plain.torque_delay_s)
    assert lagging.torque_bandwidth_hz == 10.0 and lagging.sensor_noise == pytest.approx(2.0 + plain.sensor_noise)
    assert (found.hold_s, found.assist, found.gains) == (0.7, True, start.gains)
