"""What a planner and its thread share: the state that waits, and the update that came of the last one."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from mcplan.errors import InvalidInput

Request = TypeVar("Request")
Done = TypeVar("Done")


class Mailbox(Generic[Request, Done]):
    """One state waits at most, with what is asked of it, and one update: later ones replace them.

    It knows no planner, so that the thread that serves it does not keep a planner alive that nobody uses any more.
    """

    def __init__(self) -> None:
        self._lock = threading.Condition()
        self._waiting: tuple[int, Request] | None = None
        self._done: Done | None = None
        self._computing = self._closed = False
        self._tickets = 0

    @property
    def busy(self) -> bool:
        """Whether a state waits or is computed from."""
        with self._lock:
            return self._computing or self._waiting is not None

    def submit(self, request: Request) -> int:
        """Put a state in; returns its number, from 1 on.

        Raises:
            InvalidInput: The mailbox is closed.
        """
        with self._lock:
            if self._closed:
                raise InvalidInput("planner", "must be open: it was closed")
            self._tickets += 1
            self._waiting = (self._tickets, request)
            self._lock.notify_all()
            return self._tickets

    def poll(self) -> Done | None:
        """Take the update out; None: there is none."""
        with self._lock:
            done, self._done = self._done, None
            return done

    def wait(self, timeout_s: float | None) -> Done | None:
        """The same, after whatever was submitted is computed, or the time is over."""
        with self._lock:
            self._lock.wait_for(lambda: not (self._computing or self._waiting), timeout_s)
        return self.poll()

    def close(self) -> None:
        """No state is computed from any more but for the present one."""
        with self._lock:
            self._closed, self._waiting = True, None
            self._lock.notify_all()

    def serve(self, compute: Callable[[int, Request], Done | None]) -> None:
        """Compute from what is submitted, one after the other, until the mailbox is closed. For the thread."""
        while True:
            with self._lock:
                self._lock.wait_for(lambda: self._closed or self._waiting is not None)
                if self._closed or self._waiting is None:
                    return
                (ticket, request), self._waiting = self._waiting, None
                self._computing = True
            done = None
            try:
                done = compute(ticket, request)
            finally:  # whoever waits must not wait for a thread that has ended
                with self._lock:
                    self._done, self._computing = done, False
                    self._lock.notify_all()
            del request, done
