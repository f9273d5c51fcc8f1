"""Ctrl-C reaches the loop around every verb, with the best result; nothing else stops a solve."""

from __future__ import annotations

import functools
import os
import random
import signal
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest

import mcplan as mp
from mcplan import _core
from standing import standing_plan

pytestmark = pytest.mark.usefixtures("ctrl_c")

VERBS: dict[str, Callable[..., Any]] = {
    "plan": lambda **more: mp.plan("stairs", **more),
    "walk": lambda **more: mp.walk("rubbles", cycles=2, **more),
    "whole_body": lambda **more: mp.whole_body("cartwheel", **more),
}


class OwnStop(Exception):
    """What a user's handler raises."""


def press_after(delay_s: float) -> threading.Timer:
    timer = threading.Timer(delay_s, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def long_plan() -> mp.Plan:
    return standing_plan(phases=40, duration_s=20.0)


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("seed", range(3))
def test_ctrl_c_ends_a_loop_over_any_verb_and_keeps_its_result(verb, seed):
    """Also at the moment at which a stage of the search converges: Python tells of a signal once."""
    timer = press_after(random.Random(seed).uniform(0.0, 0.6))
    with pytest.raises(KeyboardInterrupt) as stop:
        for _ in range(1000):
            VERBS[verb]()
    timer.join()
    if isinstance(stop.value, mp.Interrupted):  # not so between two of them, or before the search began
        assert str(stop.value.result.report.status) in {str(status) for status in mp.Status.__members__.values()}
        assert stop.value.result.plan is not None


@functools.cache
def count_of_lines(verb: str) -> int:
    lines: list[str] = []
    VERBS[verb](logger=lambda level, text: lines.append(text))
    return len(lines)


@pytest.mark.parametrize("verb", ["plan", "whole_body"])
@pytest.mark.parametrize("share", [0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
def test_an_interrupt_while_any_line_is_logged_is_not_lost(verb, share):
    """The last line is written when there is nothing left to stop."""
    line, lines = 1 + round(share * (count_of_lines(verb) - 1)), []

    def logger(level, text):
        lines.append(text)
        if len(lines) == line:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(mp.Interrupted) as stop:
        VERBS[verb](logger=logger)
    assert stop.value.result.plan is not None
    assert str(stop.value.result.report.status) in ("interrupted", "solved")


def test_a_check_can_be_interrupted_and_what_is_not_checked_is_not_ok():
    plan = long_plan()
    assert mp.check(plan).complete
    timer = press_after(0.05)
    with pytest.raises(KeyboardInterrupt) as stop:
        for _ in range(1000):
            mp.check(plan)
    timer.join()
    assert isinstance(stop.value, mp.Interrupted)
    found = stop.value.result
    if not found.complete:
        assert not found.ok() and "stopped before the end" in str(found)


@pytest.mark.parametrize("verb", VERBS)
def test_what_the_users_own_handler_raises_comes_out_as_it_is(verb):
    def handler(number, frame):
        raise OwnStop

    signal.signal(signal.SIGINT, handler)
    timer = press_after(0.2)
    with pytest.raises(OwnStop):
        for _ in range(1000):
            VERBS[verb]()
    timer.join()


@pytest.mark.parametrize("verb", ["plan", "whole_body"])
def test_a_handler_that_raises_nothing_stops_nothing(verb):
    pressed = []
    signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    timers = [press_after(0.02 * n) for n in range(5)]
    until = time.process_time() + 0.3
    while time.process_time() < until or any(timer.is_alive() for timer in timers):
        assert str(VERBS[verb]().report.status) == "solved"
    assert len(pressed) > 0


def test_solves_in_other_threads_go_on():
    """Signals are the main thread's; the others neither see them nor keep them from it."""
    results: list[Any] = []
    thread = threading.Thread(target=lambda: results.append(mp.plan("flat")))
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    thread.join()
    assert str(results[0].report.status) == "solved"


def test_a_solve_within_a_loggers_call_leaves_the_outer_ones_watch_alone():
    inner = []

    def logger(level, text):
        if not inner:
            inner.append(mp.plan("flat"))
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(mp.Interrupted) as stop:
        mp.plan("stairs", logger=logger)
    assert stop.value.result.plan.scene.name == "stairs" and str(inner[0].report.status) == "solved"


def test_an_interrupted_proof_leaves_the_motion(monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(_core.sip, "certify", interrupted)
    with pytest.raises(mp.Interrupted) as stop:
        mp.whole_body("cartwheel", certify=True)
    assert str(stop.value.result.report.status) == "solved" and stop.value.result.certificate is None


def test_an_interrupt_is_a_keyboard_interrupt_and_no_exception():
    assert issubclass(mp.Interrupted, KeyboardInterrupt) and not issubclass(mp.Interrupted, Exception)
    assert mp.Interrupted().result is None and str(mp.Interrupted(3)) == "interrupted"


def test_a_check_costs_no_more_where_surfaces_lie_out_of_reach():
    """CPU time of this process, as a ratio: 60 times the surfaces cost 40 times as much when each was looked at in every
    sample of a swing; now their boxes are, once in a while."""
    plan = mp.plan("flat").plan

    def cpu_s(idle: int) -> float:
        scene = mp.load_scene("flat")
        more = []
        for n in range(idle):
            vertices = [[50.0 + n, -1.0, 0.3], [50.5 + n, -1.0, 0.3], [50.5 + n, 1.0, 0.3], [50.0 + n, 1.0, 0.3]]
            more.append(mp.model.Surface(name=f"idle{n}", vertices_W=vertices))
        scene.surfaces = [*scene.surfaces, *more]
        best = float("inf")
        for _ in range(3):
            began = time.process_time()
            assert mp.check(plan, scene).ok()
            best = min(best, time.process_time() - began)
        return best

    assert cpu_s(900) < 6.0 * cpu_s(15)
