"""Ctrl-C in the command: whatever it was doing, the exit code is 130, and nothing is printed about it."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable
from types import FrameType
from typing import TYPE_CHECKING, Any, TypeVar

from mcplan import starting
from mcplan.errors import Interrupted

if TYPE_CHECKING:
    from types import TracebackType

Result = TypeVar("Result")

#: What shells say of a program that SIGINT ended.
CODE = 130


class Watch:
    """While entered, remembers that SIGINT came, also where some library swallows the KeyboardInterrupt.

    Attributes:
        told: It came.
    """

    def __init__(self, last: bool) -> None:
        self.told = False
        self._last = last  # nothing but the process's end comes after
        self._before: Any = None
        self._unraisable = sys.unraisablehook

    def __enter__(self) -> Watch:
        sys.unraisablehook = self._hook
        # Where SIGINT is ignored, as in what a shell starts in the background, it stays so.
        if threading.current_thread() is threading.main_thread() and callable(signal.getsignal(signal.SIGINT)):
            self._before = signal.getsignal(signal.SIGINT)  # known before the handler asks for it
            signal.signal(signal.SIGINT, self._handle)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> bool:
        if self._before is not None:
            # At the end of the process there is nothing left to interrupt: it has said what it did.
            after = signal.SIG_IGN if self._last else self._before
            while signal.getsignal(signal.SIGINT) is not after:
                try:
                    signal.signal(signal.SIGINT, after)
                except KeyboardInterrupt:  # it came just now, and is told
                    pass
        if not self._last:
            sys.unraisablehook = self._unraisable
        return self.told or isinstance(error, KeyboardInterrupt)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        self.told = True
        if self._before in (signal.default_int_handler, starting._leave):
            raise KeyboardInterrupt
        self._before(number, frame)

    def _hook(self, what: sys.UnraisableHookArgs) -> None:
        """Interrupts and closed pipes that reach a destructor are no news."""
        if not issubclass(what.exc_type, (KeyboardInterrupt, BrokenPipeError)):
            self._unraisable(what)


def as_far_as_it_came(solve: Callable[[], Result]) -> tuple[Result, bool]:
    """The result, and whether Ctrl-C ended the solve; without any result the interrupt goes on."""
    try:
        return solve(), False
    except Interrupted as stop:
        if stop.result is None:
            raise
        return stop.result, True
