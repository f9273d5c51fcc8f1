"""Robots that stand at the end of a run, and those that are about to fall."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("pinocchio")

import plans_by_hand as by_hand
from mcplan.tracking.options import Options
from mcplan.tracking.recording import Recording
from mcplan.tracking.report import ending
from mcplan.tracking.result import TrackingResult
from mcplan.tracking.standing import _from_hull, beside_soles_m, falls_at_end
from recordings import measures, recorded

PLAN = by_hand.walk(by_hand.flat(), by_hand.talos())


def moved(recording: Recording, by_m: float, at_m_s: float = 0.0) -> Recording:
    """The same, with the CoM moved ahead at the end, and faster."""
    com_W = recording.com_W.copy()
    com_W[:, 0] += by_m + at_m_s * (recording.times_s - recording.times_s[-1])
    return replace(recording, com_W=com_W)


@pytest.fixture(scope="module")
def stands() -> Recording:
    return recorded(PLAN)


def result_of(recording: Recording) -> TrackingResult:
    return TrackingResult(recording, measures(), Options())


def test_a_robot_over_its_soles_stands(stands: Recording) -> None:
    assert beside_soles_m(stands) == 0.0
    assert result_of(stands).followed
    assert ending(result_of(stands)).startswith("followed to the end")


@pytest.mark.parametrize(("by_m", "at_m_s"), [(0.4, 0.0), (0.0, 1.5), (-0.4, 0.0)])
def test_a_robot_whose_capture_point_is_beside_them_does_not(stands: Recording, by_m: float, at_m_s: float) -> None:
    fallen = moved(stands, by_m, at_m_s)
    assert falls_at_end(fallen) and not result_of(fallen).followed
    assert "about to fall" in ending(result_of(fallen))


def test_velocity_towards_the_soles_is_counted_for_the_robot(stands: Recording) -> None:
    away = beside_soles_m(moved(stands, 0.4))
    omega = np.sqrt(stands.scene.gravity / stands.simulated_robot.com_height)
    assert beside_soles_m(moved(stands, 0.4, -0.2)) == pytest.approx(away - 0.2 / omega, abs=1e-3)


def test_nothing_is_said_of_a_run_that_was_cut_short_or_of_a_plan_that_ends_on_the_way(stands: Recording) -> None:
    cut = recorded(PLAN, until_s=0.5 * PLAN.duration())
    assert not falls_at_end(moved(cut, 1.0))
    on_the_way = PLAN.__copy__()
    on_the_way.open_end = True
    assert not falls_at_end(replace(moved(stands, 1.0), plan=on_the_way))


def test_with_nothing_in_contact_it_falls(stands: Recording) -> None:
    assert falls_at_end(replace(stands, contacts=np.zeros_like(stands.contacts)))


def test_distances_from_a_hull_are_those_of_its_edges_and_corners() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert _from_hull(np.array([0.5, 0.5]), square) == 0.0
    assert _from_hull(np.array([1.3, 0.5]), square) == pytest.approx(0.3, rel=1e-3)
    assert _from_hull(np.array([1.3, 1.4]), square) == pytest.approx(0.5, rel=1e-3)
    assert _from_hull(np.array([0.3, 0.4]), square[:1]) == pytest.approx(0.5, rel=1e-3)
