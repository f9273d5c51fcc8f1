"""Ctrl-C while the ``mcplan`` command starts ends it at once, with exit code 130 and without a traceback.

NumPy and the compiled part take most of a short command's time to load, and an exception out of the middle of that would
reach the user as one about them. Nothing is to be kept by then. Programs that use the library are left alone.
"""

from __future__ import annotations

import os
import signal
import sys


def guard() -> None:
    """Until the command sets its own handler; a handler that is not Python's own stays."""
    if is_command() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _leave)


def is_command() -> bool:
    """Whether this process is ``mcplan`` or ``python -m mcplan``."""
    if "-m" in sys.orig_argv[1:-1] and sys.orig_argv[sys.orig_argv.index("-m") + 1] == "mcplan":
        return True
    script = getattr(sys.modules.get("__main__"), "__file__", None)
    if script is None or os.path.basename(script) != "mcplan":
        return False
    try:
        with open(script, encoding="utf-8") as file:  # what pip writes, not somebody's own program of that name
            return "mcplan.cli" in file.read(2000)
    except (OSError, ValueError):
        return False


def _leave(number: int, frame: object) -> None:
    os._exit(130)


try:
    guard()
except ValueError:  # not in the main thread
    pass
