"""Options of a run by name."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan.planar.tracking import DEFAULT_OPTIONS
from mcplan.tracking import Gains, Options, Push
from mcplan.tracking.choice import make_options


def test_names_become_fields_and_the_rest_stays():
    assert make_options({}) == Options() and make_options({}, DEFAULT_OPTIONS) is not Options()
    chosen = make_options({"assist": True, "mass_scale": np.float64(1.1), "hold_s": 2, "gains": {"com_kp": 40.0}})
    assert chosen == Options(assist=True, mass_scale=1.1, hold_s=2, gains=Gains(com_kp=40.0))
    assert make_options({"hold_s": 0.5}, DEFAULT_OPTIONS).simulation_step_s == DEFAULT_OPTIONS.simulation_step_s


def test_pushes_are_objects_or_four_numbers():
    pushes = make_options({"pushes": [Push(40.0, 0.2, 3.0), (25, 0.1, 1, -90)]}).pushes
    assert pushes == (Push(40.0, 0.2, 3.0), Push(25.0, 0.1, 1.0, -90.0))
    one = (40.0, 0.2, 3.0, 90.0)
    for given in (Push(*one), one, list(one), np.array(one), [one], np.array([one])):
        assert make_options({"pushes": given}).pushes == (Push(*one),)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"asist": True}, "asist: no such option. Did you mean 'assist'? Options: simulation_step_s, "),
        ({"gains": {"com": 1.0}}, "gains.com: no such option. Did you mean 'com_kp'? Options: com_kp, "),
        ({"gains": {"com_kp": "high"}}, 'gains.com_kp: must be a number, got "high"'),
        ({"gains": 3.0}, "gains: must be of type Gains, got 3.0"),
        ({"mass_scale": "heavy"}, 'mass_scale: must be a number, got "heavy"'),
        ({"mass_scale": True}, "mass_scale: must be a number, got True"),
        ({"mass_scale": 7.0}, "mass_scale: must lie in 0.2 to 5, got 7.0"),
        ({"seed": 1.5}, "seed: must be of type int, got 1.5"),
        ({"seed": True}, "seed: must be of type int, got True"),
        ({"assist": 1}, "assist: must be of type bool, got 1"),
        ({"pushes": 40.0}, "pushes: must be a list, got 40.0"),
        ({"pushes": [40.0, 0.2]}, "pushes[0]: must be force_N, duration_s, at_s, direction_deg, got 2 values"),
        ({"pushes": [40.0, (25, 0.1, 1, -90)]}, "pushes[0]: must be force_N, duration_s, at_s, direction_deg, got 2"),
        ({"pushes": [(40.0, 0.2)]}, "pushes[0]: must be force_N, duration_s, at_s, direction_deg, got 2 values"),
        ({"pushes": np.array(40.0)}, "pushes: must be a list, got "),
        ({"pushes": "40"}, 'pushes: must be a list, got "40"'),
        ({"pushes": [(40.0, [0.2, 1.0], 3.0, 0.0)]}, "pushes[0].duration_s: must be a number, got [0.2, 1.0]"),
        ({"pushes": b"\x01\x01\x01\x01"}, "pushes: must be a list, got "),
        ({"pushes": (10**400, 0.2, 3.0, 0.0)}, "pushes[0].force_N: must be a number, got 1"),
        ({"pushes": Push("hard", 0.2, 3.0)}, 'pushes[0].force_N: must be a number, got "hard"'),
        ({"pushes": [Push(40.0, 0.2, None)]}, "pushes[0].at_s: must be a number, got None"),
        ({"pushes": [(40.0, "x", 3.0, 0.0)]}, 'pushes[0].duration_s: must be a number, got "x"'),
        ({"pushes": [(40.0, -1.0, 3.0, 0.0)]}, "pushes[0].duration_s: must be above 0, got -1.0"),
    ],
)
def test_what_is_no_option_is_told_by_name(values, message):
    with pytest.raises(mp.errors.InvalidOptions) as found:
        make_options(values)
    assert str(found.value).startswith(message)
