"""Ctrl-C ends a simulation after the step under way, so that what was simulated until then is there to look at."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType
from typing import Any

from mcplan.errors import Interrupted


class Interruption:
    """While entered, what Ctrl-C's handler raises is kept until the end; a second one is raised at once.

    A handler that raises nothing stops nothing. Outside the main thread: nothing.

    Attributes:
        raised: What the handler raised, a KeyboardInterrupt in most programs; None: nothing.
    """

    def __init__(self) -> None:
        self.raised: BaseException | None = None
        self._before: Any = None

    @property
    def asked(self) -> bool:
        """Whether the simulation is to end."""
        return self.raised is not None

    def raise_with(self, result: object) -> None:
        """Raise what was kept, a KeyboardInterrupt as Interrupted with the result."""
        if type(self.raised) is KeyboardInterrupt:
            raise Interrupted(result) from None
        if self.raised is not None:
            raise self.raised

    def __enter__(self) -> Interruption:
        # Where SIGINT is ignored, as in what a shell starts in the background, it stays so.
        if threading.current_thread() is threading.main_thread() and callable(signal.getsignal(signal.SIGINT)):
            self._before = signal.getsignal(signal.SIGINT)  # known before the handler asks for it
            signal.signal(signal.SIGINT, self._ask)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            self._before = None
        if isinstance(error, Exception) and self.raised is not None:
            raise self.raised from error

    def _ask(self, number: int, frame: FrameType | None) -> None:
        try:
            self._before(number, frame)
        except BaseException as raised:
            if self.raised is not None:
                raise
            self.raised = raised
