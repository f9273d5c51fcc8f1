"""Ctrl-C asks once, and breaks off when it is pressed again."""

from __future__ import annotations

import signal
import threading

import pytest

from mcplan.tracking.interruption import Interruption


def test_the_first_one_asks_and_the_second_one_breaks_off(ctrl_c):
    before = signal.getsignal(signal.SIGINT)
    with Interruption() as stop:
        assert not stop.asked
        signal.raise_signal(signal.SIGINT)
        assert stop.asked
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is before


def test_the_handler_comes_back_after_an_exception(ctrl_c):
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(OSError), Interruption():
        raise OSError
    assert signal.getsignal(signal.SIGINT) is before


def test_what_ignores_the_signal_goes_on_ignoring_it(ctrl_c):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with Interruption() as stop:
        signal.raise_signal(signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN and not stop.asked


def test_other_threads_leave_the_handler_alone(ctrl_c):
    before, seen = signal.getsignal(signal.SIGINT), []

    def look() -> None:
        with Interruption():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=look)
    thread.start()
    thread.join()
    assert seen == [before]
