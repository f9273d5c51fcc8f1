"""Feedback and contact settings: units and limits."""

from __future__ import annotations

import pytest

from mcplan import load_planar_robot
from mcplan.errors import InvalidOptions
from mcplan.planar.tracking.settings import ContactSettings, Feedback


def test_gains_are_in_units_of_the_weight():
    robot = load_planar_robot("climber9")  # 24.5 kg
    stiffness, damping = Feedback(stiffness=2.0, damping_s=0.1).gains(robot)
    assert stiffness == pytest.approx(2.0 * 24.5 * 9.81)
    assert damping == pytest.approx(0.1 * stiffness)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (Feedback(stiffness=-1.0), "feedback.stiffness: must not be negative, got -1.0"),
        (Feedback(damping_s=float("nan")), "feedback.damping_s: must not be negative, got nan"),
        (ContactSettings(time_constant_s=0.0), "contacts.time_constant_s: must be above 0, got 0.0"),
        (ContactSettings(impedance=1.0), "contacts.impedance: must lie between 0 and 1, got 1.0"),
        (ContactSettings(friction_impedance=0.0), "contacts.friction_impedance: must be above 0, got 0.0"),
    ],
)
def test_what_is_out_of_range_is_named(settings, message):
    with pytest.raises(InvalidOptions) as error:
        settings.validate()
    assert str(error.value) == message
