"""A planner that changes while it works is not entered a second time: by its own callback, or from another thread."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import pytest

import mcplan as mp
from mcplan.planar.planning import make_options

Logger = Callable[[Any, str], None]


def receding_horizon(logger: Logger) -> mp.rhp.RecedingHorizon:
    return mp.receding_horizon("flat", lookahead=1, cycles=1, logger=logger)


def whole_body(logger: Logger) -> mp.sip.Planner:
    given = {"forces": "uniform", "max_iterations": 1, "kinematics_first": False, "logger": logger}
    return mp.sip.Planner(mp.load_planar_task("cartwheel"), make_options("none", given))


#: What makes a planner with a logger, one of its calls, and all calls that must wait for that one.
PLANNERS: dict[str, tuple[Callable[[Logger], Any], str, dict[str, Callable[[Any], Any]]]] = {
    "rhp": (
        receding_horizon,
        "step",
        {"step": lambda planner: planner.step(), "walk": lambda planner: planner.walk()},
    ),
    "rhp walk": (
        receding_horizon,
        "walk",
        {"step": lambda planner: planner.step(mp.rhp.State()), "walk": lambda planner: planner.walk()},
    ),
    "sip": (
        whole_body,
        "solve",
        {"solve": lambda planner: planner.solve()},
    ),
}
LOOKS = ["state", "executed", "horizon", "result"]


def refused(call: Callable[[], Any]) -> mp.InvalidInput:
    with pytest.raises(mp.InvalidInput) as found:
        call()
    assert found.value.rule == "must not be called while the same planner is at work (each thread needs its own)"
    return found.value


@pytest.mark.parametrize("kind", PLANNERS)
def test_a_callback_cannot_call_the_planner_that_calls_it(kind):
    make, call, entries = PLANNERS[kind]
    errors: list[mp.InvalidInput] = []

    def enter(*_: Any) -> None:
        if not errors:
            errors.extend(refused(lambda entry=entry: entry(planner)) for entry in entries.values())

    planner = make(enter)
    getattr(planner, call)()
    assert [(error.field, error.value) for error in errors] == [
        (name, "a call from its own callback") for name in entries
    ]
    getattr(planner, call)() if kind == "sip" else planner.state()  # and is free again


@pytest.mark.parametrize("kind", PLANNERS)
def test_what_a_callback_does_not_catch_ends_the_call_and_frees_the_planner(kind):
    make, call, entries = PLANNERS[kind]
    seen = []

    def enter(*_: Any) -> None:
        seen.append(1)
        if len(seen) == 1:
            getattr(planner, call)()

    planner = make(enter)
    refused(lambda: getattr(planner, call)())
    getattr(planner, call)()
    assert len(seen) > 1


@pytest.mark.parametrize("kind", PLANNERS)
def test_a_second_thread_is_refused_until_the_first_is_done(kind):
    make, call, entries = PLANNERS[kind]
    at_work, go_on = threading.Event(), threading.Event()

    def wait(*_: Any) -> None:
        at_work.set()
        assert go_on.wait(60.0)

    planner = make(wait)
    first = threading.Thread(target=getattr(planner, call))
    first.start()
    try:
        assert at_work.wait(60.0)
        looks = {name: lambda name=name: getattr(planner, name)() for name in LOOKS if hasattr(planner, name)}
        for name, entry in [*entries.items(), *((name, lambda _, look=look: look()) for name, look in looks.items())]:
            error = refused(lambda entry=entry: entry(planner))
            assert (error.field, error.value) == (name, "a call from another thread")
    finally:
        go_on.set()
        first.join(60.0)
    assert not first.is_alive()
    for look in looks.values():
        look()
    if kind == "sip":
        planner.solve()


def test_a_callback_may_look_at_the_walk_so_far():
    steps = []
    planner = receding_horizon(lambda *_: steps.append([getattr(planner, name)() for name in LOOKS]))
    planner.step()
    assert len(steps) == 1
