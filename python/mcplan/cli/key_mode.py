"""A terminal whose keys are read one by one, and which is left as it was however the program ends."""

from __future__ import annotations

import contextlib
import os
import signal
import threading
from types import FrameType
from typing import Any


class KeyMode:
    """From begin() to end() keys come at once and are not shown; Ctrl-C stays what it is.

    Where the process is stopped, goes on, or is ended by a signal meanwhile, the terminal is what its shell needs. Signals
    are looked after in the main thread only.

    Args:
        descriptor: File descriptor of the terminal.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._usual: list[Any] | None = None
        self._handlers: dict[int, Any] = {}

    def begin(self) -> None:
        """Read keys one by one from now on."""
        import termios

        self._usual = termios.tcgetattr(self._descriptor)
        self._set_keys()
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGTSTP, signal.SIGTERM, signal.SIGHUP):
                if signal.getsignal(number) is signal.SIG_DFL:
                    self._handlers[number] = signal.signal(number, self._leave)

    def end(self) -> None:
        """The terminal as it was; nothing where it is gone."""
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        self._handlers.clear()
        self._set_usual()

    def _set_keys(self) -> None:
        import termios
        import tty

        with contextlib.suppress(termios.error, OSError):
            tty.setcbreak(self._descriptor)

    def _set_usual(self) -> None:
        import termios

        if self._usual is not None:
            with contextlib.suppress(termios.error, OSError):
                termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._usual)

    def _leave(self, number: int, frame: FrameType | None) -> None:
        """Do what the signal does by default, with the terminal as it was; after a stop keys are read again."""
        self._set_usual()
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)  # here a stop lasts until the process is told to go on
        signal.signal(number, self._leave)
        self._set_keys()
