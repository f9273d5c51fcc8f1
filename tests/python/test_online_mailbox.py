"""What a planner and its thread share: the latest state waits, the latest update is handed out once."""

import sys
import threading

import pytest

import mcplan as mp
from mcplan.online.mailbox import Mailbox


def serving(mailbox: Mailbox, compute) -> threading.Thread:
    thread = threading.Thread(target=mailbox.serve, args=(compute,), daemon=True)
    thread.start()
    return thread


def test_what_is_computed_is_handed_out_once():
    mailbox = Mailbox()
    assert mailbox.poll() is None and not mailbox.busy
    assert mailbox.submit("a") == 1 and mailbox.busy
    thread = serving(mailbox, lambda ticket, asked: (ticket, asked))
    assert mailbox.wait(60.0) == (1, "a")
    assert mailbox.poll() is None and not mailbox.busy
    assert mailbox.submit("b") == 2 and mailbox.wait(60.0) == (2, "b")
    mailbox.close()
    thread.join(60.0)
    assert not thread.is_alive()


def test_a_later_state_replaces_one_that_waits_and_not_the_one_that_is_computed_from():
    mailbox, begun, go_on, seen = Mailbox(), threading.Event(), threading.Event(), []

    def compute(ticket, asked):
        seen.append((ticket, asked))
        begun.set()
        assert go_on.wait(60.0)
        return ticket

    mailbox.submit("first")
    serving(mailbox, compute)
    assert begun.wait(60.0)
    mailbox.submit("replaced")
    mailbox.submit("last")
    assert mailbox.wait(0.0) is None and mailbox.busy
    go_on.set()
    assert mailbox.wait(60.0) == 3 and seen == [(1, "first"), (3, "last")]
    mailbox.close()


def test_a_closed_one_takes_nothing_and_drops_what_waits():
    mailbox, seen = Mailbox(), []
    mailbox.submit("dropped")
    mailbox.close()
    mailbox.serve(lambda ticket, asked: seen.append(asked))  # returns at once
    assert seen == [] and mailbox.wait(60.0) is None and not mailbox.busy
    with pytest.raises(mp.InvalidInput, match="planner: must be open"):
        mailbox.submit("late")


def test_a_thread_that_ends_with_an_exception_leaves_nobody_waiting():
    mailbox = Mailbox()
    mailbox.submit("state")
    with pytest.raises(SystemExit):
        mailbox.serve(lambda *_: sys.exit(3))
    assert mailbox.wait(60.0) is None and not mailbox.busy
