"""What stands low across the way is stepped over: a pipe, a beam, a threshold."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import mcplan as mp

NEAR_M, FAR_M, HEIGHT_M = 0.9, 0.95, 0.2


SCENE = f"""
name = "bar"
gravity = 9.81
[start]
position = [0, 0, 0]
contacts = {{ foot = "floor" }}
[goal]
position = [2, 0, 0]
contacts = {{ foot = "floor" }}
[[surfaces]]
name = "floor"
end_effectors = ["foot"]
vertices = [[-2, -2, 0], [4, -2, 0], [4, 2, 0], [-2, 2, 0]]
[[surfaces]]
name = "bar"
end_effectors = ["right_hand"]
thickness = {HEIGHT_M}
vertices = [
  [{NEAR_M}, -2, {HEIGHT_M}], [{FAR_M}, -2, {HEIGHT_M}], [{FAR_M}, 2, {HEIGHT_M}], [{NEAR_M}, 2, {HEIGHT_M}]
]
"""


def test_talos_steps_over_a_bar_of_two_tenths_of_a_metre(tmp_path: Path) -> None:
    """The straight search moves footholds by their costs and ends with swings through the bar."""
    (tmp_path / "bar.toml").write_text(SCENE)
    result = mp.plan(tmp_path / "bar.toml", "talos")
    assert result.report.status == mp.Status.solved
    plan = result.plan
    assert all(any(s >= 0 for s in row) for row in plan.contact_sequence())
    over = {0: 0, 1: 0}
    for t in np.arange(0.0, plan.duration(), 0.01):
        for e, foot in enumerate(plan.at(t).end_effectors[:2]):
            place, half = np.array(foot.position_W), plan.robot.end_effectors[e].half_size[0]
            if place[0] + half > NEAR_M and place[0] - half < FAR_M:
                assert foot.surface < 0
                over[e] += NEAR_M < place[0] < FAR_M and place[2] > HEIGHT_M
    assert min(over.values()) > 0
    names = {plan.scene.surfaces[s].name for row in plan.contact_sequence() for s in row if s >= 0}
    assert names == {"floor"}
