"""A run that is steered while it goes on: what is asked for is done, is told, and repeats the run."""

import dataclasses

import numpy as np
import pytest

import mcplan as mp
from mcplan.online import Asked
from mcplan.online import run as online_run
from mcplan.online.options import OnlineOptions
from mcplan.online.steering import steered
from mcplan.tracking.options import Options


def asked(*wishes: Asked, now_s: float = 1.0):
    """Options after one wish after the other, 0.1 s apart."""
    options, online, ends = Options(), OnlineOptions(), False
    for number, wish in enumerate(wishes):
        options, online, ends = steered(lambda _, wish=wish: wish, now_s + 0.1 * number, options, online)
    return options, online, ends


def test_velocities_become_commands_where_they_change():
    ahead, turning = (0.1, 0.0, 0.0), (0.1, 0.0, 0.2)
    _, online, ends = asked(Asked(ahead), Asked(ahead), Asked(), Asked(turning), Asked(turning))
    assert not ends
    assert [row[1:] for row in online.command] == [ahead, turning]
    np.testing.assert_allclose([row[0] for row in online.command], [1.0, 1.3])
    online.validate()


def test_pushes_begin_when_they_are_asked_for():
    options, _, ends = asked(Asked(push=(80.0, 0.2, 90.0)), Asked(ends=True))
    (push,) = options.pushes
    assert (push.force_N, push.duration_s, push.at_s, push.direction_deg) == (80.0, 0.2, 1.0, 90.0)
    assert ends


@pytest.mark.parametrize(
    ("wish", "says"),
    [
        ((0.1, 0.0, 0.0), r"steer\(\): must return an Asked, got \(0.1, 0.0, 0.0\)"),
        (Asked((0.1, 0.0)), r"steer\(\).velocity: must be three finite numbers"),
        (Asked(("1", "2", "3")), r"steer\(\).velocity: must be three finite numbers"),
        (Asked((float("nan"), 0.0, 0.0)), r"steer\(\).velocity: must be three finite numbers"),
        (Asked((50.0, 0.0, 0.0)), r"steer\(\).velocity: must have velocities of at most 10 m/s"),
        (Asked(push=("a", 1, 2)), r"steer\(\).push: must be three finite numbers"),
        (Asked(push=(10.0, -1.0, 0.0)), r"steer\(\).push\[1\]: must not be negative, got -1"),
        (Asked(ends="no"), r"steer\(\).ends: must be true or false"),
    ],
)
def test_what_cannot_be_asked_for_is_named(wish, says):
    with pytest.raises((mp.errors.InvalidInput, mp.errors.InvalidOptions), match=says):
        asked(wish)


@pytest.fixture(scope="module")
def plan():
    return mp.plan("flat", "talos").plan


def test_a_steered_run_is_repeated_by_its_options(plan):
    def steer(time_s: float) -> Asked:
        ahead = 0.1 if time_s > 0.5 else 0.0
        return Asked((ahead, 0.0, 0.0), (60.0, 0.1, 90.0) if time_s in (0.8, 1.2) else None, time_s >= 1.2)

    first = mp.run(plan, steer=steer, latency=0.02, self_contacts=False)
    assert first.measures.completed_s == pytest.approx(first.online_options.duration_s) == pytest.approx(1.2)
    assert [row[1] for row in first.online_options.command] == [0.0, 0.1]
    assert [push.at_s for push in first.options.pushes] == [0.8]  # one at the end would not act
    again = online_run(plan, None, first.options, first.online_options)
    assert first.online.replans == again.online.replans >= 10
    for item in dataclasses.fields(first.recording):
        value = getattr(first.recording, item.name)
        if isinstance(value, np.ndarray):
            assert value.tobytes() == getattr(again.recording, item.name).tobytes(), item.name


@pytest.mark.parametrize(
    ("named", "says"),
    [
        ({"command": (0.1, 0.0, 0.0)}, "command: must be left as it is by default where the run is steered"),
        ({"goal": (1.0, 0.0)}, "goal: must be left as it is"),
        ({"replanning": False}, "replanning: must be left as it is"),
        ({"engine": "rhp"}, "engine: must be left as it is .*, got .*rhp"),
    ],
)
def test_what_says_otherwise_where_to_walk_is_refused(plan, named, says):
    with pytest.raises(mp.errors.InvalidOptions, match=says):
        mp.run(plan, steer=lambda _: Asked(), **named)


@pytest.mark.parametrize("steer", [5, "ahead", False, (0.1, 0.0, 0.0)])
def test_what_is_no_function_does_not_steer(plan, steer):
    with pytest.raises(mp.errors.InvalidArgument, match="steer: must be a function of the simulated time"):
        mp.run(plan, steer=steer)


def test_a_push_at_every_step_is_one_after_the_other(plan):
    result = mp.run(plan, steer=lambda t: Asked(push=(5.0, 0.001, 90.0), ends=t > 0.05), latency=0.02)
    assert len(result.options.pushes) > 20
    np.testing.assert_allclose(np.linalg.norm(result.recording.pushes_W[:20], axis=1), 2.5)  # half of a step each
