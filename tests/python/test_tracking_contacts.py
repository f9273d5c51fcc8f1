"""Early, timely and late touchdown, as a table of what the plan says, what is felt, and what follows."""

import numpy as np
import pytest

from mcplan.tracking.contacts import EARLY_FRACTION, SEARCH_DEPTH, SEARCH_SPEED, TOGETHER_S, Contact, LateLandings, Mode

FREE, CONTACT, SEARCH = Mode.FREE, Mode.CONTACT, Mode.SEARCH
SOON, LATER = EARLY_FRACTION + 0.05, EARLY_FRACTION - 0.05

# mode before, planned, in contact, fraction of the swing; mode after, came into contact just now
TABLE = [
    (FREE, False, False, 0.0, FREE, False),
    (FREE, False, False, SOON, FREE, False),
    (FREE, False, True, LATER, FREE, False),  # has not left yet, or is in contact in passing
    (FREE, False, True, SOON, CONTACT, True),  # early
    (FREE, True, True, 1.0, CONTACT, True),  # in time
    (FREE, True, False, 1.0, SEARCH, False),  # late
    (SEARCH, True, False, 1.0, SEARCH, False),
    (SEARCH, True, True, 1.0, CONTACT, True),
    (SEARCH, False, False, 0.0, FREE, False),  # given up: the plan lifts it again
    (SEARCH, False, True, 0.0, FREE, False),
    (CONTACT, True, True, 1.0, CONTACT, False),
    (CONTACT, True, False, 1.0, CONTACT, False),  # a force of nothing is no take-off
    (CONTACT, False, True, 0.0, FREE, False),  # lifts
    (CONTACT, False, False, LATER, FREE, False),
    (CONTACT, False, True, SOON, CONTACT, False),  # landed early before, stands
    (CONTACT, False, False, SOON, CONTACT, False),
]


@pytest.mark.parametrize(("before", "planned", "in_contact", "fraction", "after", "landed"), TABLE)
def test_a_step_of_the_contact(before, planned, in_contact, fraction, after, landed):
    contact = Contact(mode=before)
    assert contact.update(planned, in_contact, fraction, 0.002) is landed
    assert contact.mode is after


def test_a_foot_that_finds_no_ground_is_lowered_so_far_and_no_farther():
    contact, dt = Contact(), 0.002
    depths, speeds = [], []
    for _ in range(500):
        contact.update(True, False, 1.0, dt)
        depths.append(contact.search_depth_m)
        speeds.append(contact.search_speed)
    expected = np.minimum(SEARCH_SPEED * dt * np.arange(1, 501), SEARCH_DEPTH)
    np.testing.assert_allclose(depths, expected, atol=1e-12)
    moving = np.diff(depths) > 0.9 * SEARCH_SPEED * dt
    np.testing.assert_allclose(np.diff(depths)[moving], np.array(speeds[:-1])[moving] * dt, atol=1e-12)
    assert set(np.array(speeds[1:])[~moving]) == {0.0}
    assert contact.update(True, True, 1.0, dt) and contact.search_depth_m == 0.0
    # The next time it begins anew.
    contact.update(False, False, 0.0, dt)
    contact.update(True, False, 1.0, dt)
    assert contact.search_depth_m == pytest.approx(SEARCH_SPEED * dt)


def test_a_search_that_the_plan_ends_is_forgotten():
    contact = Contact()
    for _ in range(50):
        contact.update(True, False, 1.0, 0.002)
    contact.update(False, False, 0.0, 0.002)
    assert contact.search_depth_m == 0.0 and contact.mode is FREE


def test_early_landing_lands_once():
    contact = Contact()
    landed = [contact.update(False, in_contact, SOON, 0.002) for in_contact in (False, True, False, True)]
    landed.append(contact.update(True, True, 1.0, 0.002))
    assert landed == [False, True, False, False, False]


def test_no_foot_is_lifted_before_a_late_one_has_landed():
    dt, late = 0.002, LateLandings()
    feet = [Contact(mode=CONTACT), Contact(mode=SEARCH)]
    assert late.update(feet, [True, True], dt) == [True, True]
    assert late.update(feet, [False, True], dt) == [True, True]  # the plan lifts the one that stands: it stays
    feet[1].mode = CONTACT
    kept = [late.update(feet, [False, True], dt)[0] for _ in range(60)]
    assert sum(kept) == pytest.approx(TOGETHER_S / dt, abs=1.5) and kept == sorted(kept, reverse=True)


def test_feet_in_the_air_are_not_kept_down_and_flights_are_flown():
    late = LateLandings()
    assert late.update([Contact(mode=FREE), Contact(mode=SEARCH)], [False, True], 0.002) == [False, True]
    late = LateLandings()  # nothing is late where the plan has both feet in the air
    assert late.update([Contact(mode=CONTACT), Contact(mode=SEARCH)], [False, False], 0.002) == [False, False]


@pytest.mark.parametrize(
    ("mode", "firmly", "in_contact", "moved_m", "stands"),
    [
        (CONTACT, False, False, 0.003, True),  # it bears nothing, and is where it landed
        (CONTACT, False, False, 0.02, False),  # the robot tips over, and it is in the air
        (CONTACT, False, True, 0.02, True),
        (CONTACT, True, False, 0.02, True),
        (FREE, True, True, 0.0, False),  # it is being lifted
        (SEARCH, False, True, 0.0, False),  # one touch is no landing yet
        (SEARCH, True, True, 0.0, True),
        (SEARCH, False, False, 0.0, False),
    ],
)
def test_what_a_planner_is_told_of_a_foot(mode, firmly, in_contact, moved_m, stands):
    assert Contact(mode).stands(firmly, in_contact, moved_m) is stands
