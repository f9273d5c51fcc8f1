"""Walking while somebody pushes: a push that lasts is felt and planned for."""

import numpy as np
import pytest

import mcplan as mp

for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
    pytest.importorskip(name)

from mcplan.online import FeltPush  # noqa: E402

#: To the left, for a second, with 0.12 of the weight.
FORCE_N, LASTS_S = 109.0, 1.0


class FeelsNothing:
    """An observer as if nothing ever pushed."""

    push = FeltPush()

    def update(self, *_: object) -> FeltPush:
        return self.push


@pytest.fixture(scope="module")
def plan():
    return mp.plan("flat", "talos").plan


def pushed(plan, at_s):
    told = {"push": (FORCE_N, LASTS_S, at_s, 90.0), "latency": 0.02, "self_contacts": False}
    return mp.run(plan, duration=at_s + 2.6, **told)


def test_a_push_that_lasts_is_survived_since_it_is_felt(plan, monkeypatch):
    felt = pushed(plan, 3.0)
    assert not felt.measures.fell
    monkeypatch.setattr("mcplan.tracking.unknown_forces.PushObserver", FeelsNothing)
    assert pushed(plan, 3.0).measures.fell


def test_the_robot_leans_against_what_pushes_it(plan, tmp_path):
    """References are the CoM's, which is behind the plan's by what the push does."""
    run = pushed(plan, 2.6)
    while_pushed_s = 2.6 + 0.6
    followed = [f for f in run.plans if f.from_s <= while_pushed_s][-1]
    reference_W = run.recording.com_plan_W[np.searchsorted(run.recording.times_s, while_pushed_s)]
    ahead_m = followed.plan.at(while_pushed_s - followed.begins_s).com_W[1] - reference_W[1]
    robot = followed.plan.robot
    leans_m = FORCE_N / robot.mass * robot.com_height / followed.plan.scene.gravity  # a / omega^2, in the end
    assert ahead_m == pytest.approx(leans_m, rel=0.2)
    # But for what is left of the change from the plan before.
    assert ahead_m == pytest.approx(followed.com_shift_W[1], abs=0.02)
    path = tmp_path / "pushed.npz"
    run.save(path)
    assert [f.com_shift_W for f in type(run).load(path).plans] == [f.com_shift_W for f in run.plans]
