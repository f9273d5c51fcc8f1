"""What a run says that a robot reached of commands is the velocity of its CoM in the heading of its base."""

from types import SimpleNamespace

import numpy as np
import pytest

from mcplan.online.options import OnlineOptions
from mcplan.online.velocities import MOST_LISTED, commands_reached, reached_text


def on_circles(ahead, left, turning, times_s):
    """A robot that walks at three velocities from a heading just before the angle's jump on."""
    yaw = 3.1 + turning * times_s
    velocity_W = np.stack([ahead * np.cos(yaw) - left * np.sin(yaw), ahead * np.sin(yaw) + left * np.cos(yaw)], axis=1)
    moved_W = np.cumsum(velocity_W * np.gradient(times_s)[:, None], axis=0)
    configurations = np.zeros((len(times_s), 7))
    configurations[:, 5], configurations[:, 6] = np.sin(0.5 * yaw), np.cos(0.5 * yaw)
    com_W = np.column_stack([moved_W, np.full(len(times_s), 0.9)])
    return SimpleNamespace(times_s=times_s, com_W=com_W, configurations=configurations)


@pytest.mark.parametrize("turning", [0.0, 0.4, -1.0])
def test_the_mean_of_a_steady_walk_is_its_velocity(turning):
    recording = on_circles(0.2, -0.05, turning, np.linspace(0.0, 9.0, 4501))
    (reached,) = commands_reached(recording, OnlineOptions(command=((1.0, 5.0, 0.0, 0.0),), goal=((4.0, 1, 0, 0),)))
    assert (reached.from_s, reached.to_s, reached.commanded) == (1.0, 4.0, (5.0, 0.0, 0.0))
    assert reached.reached == pytest.approx((0.2, -0.05, turning), abs=1e-3)


def test_commands_hold_until_the_next_one_and_those_that_were_not_recorded_are_left_out():
    recording = on_circles(0.1, 0.0, 0.0, np.linspace(2.0, 6.0, 2001))
    rows = tuple((float(at_s), 0.1, 0.0, 0.0) for at_s in (0, 1, 3, 4, 7))
    reached = commands_reached(recording, OnlineOptions(command=rows))
    assert [(each.from_s, each.to_s) for each in reached] == [(2.0, 3.0), (3.0, 4.0), (4.0, 6.0)]
    assert "ahead 0.1 of 0.1 m/s, left 0 of 0 m/s, turning 0 of 0 rad/s (2 to 3 s); " in reached_text(reached)
    assert reached_text(reached * 2).endswith(f"; and {6 - MOST_LISTED} more")
    assert commands_reached(recording, OnlineOptions()) == () and reached_text(()) == ""
