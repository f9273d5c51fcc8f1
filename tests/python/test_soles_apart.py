"""Soles of feet that stand beside each other do not overlap, however the robot turns."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp


def _outline(middle_W: np.ndarray, yaw: float, half_size: np.ndarray) -> np.ndarray:
    """Points along the edges of a level sole, 2 mm apart at most."""
    share = np.linspace(-1.0, 1.0, 101)
    ends = np.ones_like(share)
    sides = [(share, ends), (share, -ends), (ends, share), (-ends, share)]
    points = np.concatenate([np.stack(side, axis=1) for side in sides]) * half_size
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    return middle_W[:2] + points @ turn.T


def _inside(points_W: np.ndarray, middle_W: np.ndarray, yaw: float, half_size: np.ndarray) -> bool:
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    return bool((np.abs((points_W - middle_W[:2]) @ turn) < half_size).all(axis=1).any())


@pytest.mark.parametrize("robot", ["talos", "humanoid44", "g1"])
def test_turning_on_the_spot_soles_keep_apart(robot: str) -> None:
    """Talos put its heels onto each other before this was asked for, 2 mm deep."""
    result = mp.plan("turn", robot)
    assert result.report.status == mp.Status.solved
    plan = result.plan
    half = [np.array(end.half_size[:2]) for end in plan.robot.end_effectors[:2]]
    room_m = 0.8 * 0.03 * plan.robot.com_height  # of what is asked for: the rows are soft
    beside = 0
    for t in plan.knot_times():
        feet = plan.at(t).end_effectors[:2]
        if any(foot.surface < 0 for foot in feet):
            continue
        places, yaws = [np.array(foot.position_W) for foot in feet], [foot.yaw for foot in feet]
        one, other = (_outline(*each) for each in zip(places, yaws, half, strict=True))
        assert not _inside(one, places[1], yaws[1], half[1]) and not _inside(other, places[0], yaws[0], half[0])
        assert np.linalg.norm(one[:, None] - other[None], axis=2).min() > room_m
        beside += 1
    assert beside > 6
