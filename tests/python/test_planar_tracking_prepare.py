"""Planar tasks made ready for tracking: clearances for every swing."""

from __future__ import annotations

import pytest

from mcplan import _core, load_planar_task
from mcplan.errors import InvalidOptions, InvalidPlanarTask
from mcplan.planar.tracking.prepare import PLANNING, trackable, with_clearances


def swings(task: _core.PlanarTask) -> list[tuple[int, int, int, float]]:
    """Phase, end-effector, surface and height of every clearance."""
    return [
        (k, c.end_effector, c.surface, c.middle_height) for k, phase in enumerate(task.phases) for c in phase.clearances
    ]


def test_climbing_gets_a_clearance_for_each_swing_over_its_own_surface():
    task = load_planar_task("climbing")
    prepared = with_clearances(task, 0.03)
    a, b, c = range(3)
    slope, wall = 0, 1
    assert swings(prepared) == [(1, b, slope, 0.03), (3, a, slope, 0.03), (5, c, wall, 0.03), (7, b, slope, 0.03)]
    assert swings(task) == []
    prepared.validate()


@pytest.mark.parametrize("name", ["walking", "stairs"])
def test_clearances_that_are_there_are_left_alone(name):
    assert swings(with_clearances(load_planar_task(name))) == swings(load_planar_task(name))


def test_a_limb_that_is_not_down_yet_or_no_longer_keeps_off_the_ground():
    task = load_planar_task("cartwheel")
    extra = set(swings(with_clearances(task))) - set(swings(task))
    assert extra == {(0, 2, 0, 0.02), (2, 0, 0, 0.02)}  # limb C before the wheel, limb A after it


def test_a_swing_from_surface_to_surface_is_refused():
    task = load_planar_task("stairs")
    phases = list(task.phases)
    for phase in phases:
        phase.clearances = []
    task.phases = phases
    with pytest.raises(InvalidPlanarTask, match=r"phases\[1\].clearances: needs clearances for \w+, which swings"):
        with_clearances(task)


def test_heights_must_be_above_the_surface():
    with pytest.raises(InvalidOptions, match="height_m: must be above 0, got 0.0"):
        with_clearances(load_planar_task("climbing"), 0.0)


@pytest.mark.parametrize(("name", "limited"), [("cartwheel", False), ("climbing", True), ("walking", True)])
def test_trackable_tasks_have_clearances_and_long_ones_limits_of_their_phases(name, limited):
    task, options = trackable(load_planar_task(name))
    assert swings(task) == swings(with_clearances(load_planar_task(name)))
    assert {key: options[key] for key in PLANNING} == dict(PLANNING)
    assert ("phase_duration_s" in options) == limited
