"""Contact forces that balance a base: the lever rule, cones, the plan's forces where balance leaves a choice."""

import numpy as np
import pytest

from mcplan.tracking.contact_wrenches import Contact, balanced_wrenches

pytest.importorskip("scipy")
UP = np.array([0.0, 0.0, 1.0])
G = 9.81


def contact(x: float, force, friction: float = 0.5, half: float = 0.0, normal=UP, moment=None) -> Contact:
    """At (x, 0, -1) below a base whose axes are the world's: its Jacobian is that of a rigid body."""
    position = np.array([x, 0.0, -1.0])
    corners = [position + [a, b, 0.0] for a in {-half, half} for b in {-half, half}]
    skew = np.array([[0.0, -position[2], position[1]], [position[2], 0.0, -x], [-position[1], x, 0.0]])
    jacobian = np.block([[np.eye(3), -skew], [np.zeros((3, 3)), np.eye(3)]])
    force = np.asarray(force, float)
    return Contact(np.array(corners), np.asarray(normal, float), friction, force, position, jacobian, moment)


def weight(mass: float) -> np.ndarray:
    return np.array([0.0, 0.0, mass * G, 0.0, 0.0, 0.0])


def test_two_points_share_a_weight_by_the_lever_rule():
    contacts = [contact(-0.1, [0, 0, 100.0]), contact(0.3, [0, 0, 100.0])]
    wrenches, residual = balanced_wrenches(contacts, weight(40.0), 1.0)
    assert wrenches[0][2] == pytest.approx(40.0 * G * 0.75, abs=0.5)
    assert wrenches[1][2] == pytest.approx(40.0 * G * 0.25, abs=0.5)
    assert np.abs(residual).max() < 0.05


def test_a_load_beyond_the_sole_is_left_over():
    """One sole of 0.2 m, 0.3 m beside the CoM: it can come no nearer than 0.2 m. No friction to lean on."""
    _, residual = balanced_wrenches([contact(0.3, [0, 0, 40.0 * G], 0.0, half=0.1)], weight(40.0), 1.0)
    share = 1.0 / (1.0 + 0.2**2)  # least squares of (W - f, 0.2 f)
    assert residual[2] == pytest.approx(40.0 * G * (1.0 - share), rel=1e-2)
    assert residual[4] == pytest.approx(40.0 * G * share * 0.2, rel=1e-2)


def test_a_sole_leaves_no_moment_that_its_centre_of_pressure_can_bear():
    wrenches, residual = balanced_wrenches([contact(0.08, [0, 0, 40.0 * G], half=0.1)], weight(40.0), 1.0)
    assert np.abs(residual).max() < 0.05
    assert wrenches[0][4] == pytest.approx(40.0 * G * 0.08, rel=1e-3)  # about the sole's middle


def test_the_choice_that_balance_leaves_is_the_plans():
    """Three points on a line: which bears how much is open."""
    planned = [150.0, 100.0, 40.0 * G - 250.0]
    places = [-0.2, 0.0, 0.2]
    moment = sum(x * f for x, f in zip(places, planned, strict=True))
    base = weight(40.0) + np.array([0, 0, 0, 0, -moment, 0.0])
    contacts = [contact(x, [0, 0, f]) for x, f in zip(places, planned, strict=True)]
    wrenches, _ = balanced_wrenches(contacts, base, 1.0)
    assert [w[2] for w in wrenches] == pytest.approx(planned, rel=2e-3)


def test_the_centre_of_pressure_that_balance_leaves_is_the_plans():
    """Two soles beside the CoM: how far both centres of pressure move apart is open, and so is a twist of one against the
    other."""
    half_weight = 20.0 * G
    moments = [np.array([0.0, s * 0.05 * half_weight, s * 3.0]) for s in (1.0, -1.0)]
    contacts = [contact(x, [0, 0, half_weight], half=0.1, moment=m) for x, m in zip((-0.2, 0.2), moments, strict=True)]
    wrenches, residual = balanced_wrenches(contacts, weight(40.0), 1.0)
    assert np.abs(residual).max() < 0.1
    for wrench, moment in zip(wrenches, moments, strict=True):
        assert wrench[2] == pytest.approx(half_weight, rel=5e-3)
        assert wrench[3:] == pytest.approx(moment, rel=0.03, abs=0.1)
    open_ones = [contact(s * 0.2, [0, 0, half_weight], half=0.1) for s in (-1, 1)]
    for wrench in balanced_wrenches(open_ones, weight(40.0), 1.0)[0]:
        assert np.abs(wrench[3:]).max() < 1.0


def test_forces_stay_in_the_friction_cone():
    base = weight(40.0) + np.array([0.8 * 40.0 * G, 0, 0, 0, 0, 0])
    contacts = [contact(x, [0.0, 0, 20.0 * G], friction=0.5) for x in (-2.0, 2.0)]
    wrenches, residual = balanced_wrenches(contacts, base, 1.0)
    for wrench in wrenches:
        assert abs(wrench[0]) <= 0.5 * wrench[2] + 1e-9
    assert residual[0] > 10.0
    held, nothing = balanced_wrenches([contact(x, [0.0, 0, 20.0 * G], np.inf) for x in (-2.0, 2.0)], base, 1.0)
    assert np.abs(nothing).max() < 0.1 and sum(w[0] for w in held) == pytest.approx(0.8 * 40.0 * G, rel=1e-3)


def test_in_flight_all_is_left_over():
    wrenches, residual = balanced_wrenches([], weight(3.0), 1.0)
    assert wrenches == [] and (residual == weight(3.0)).all()
