"""What several test files share."""

from __future__ import annotations

import importlib.util
import signal
from collections.abc import Iterator

import pytest

if importlib.util.find_spec("proxsuite") is not None:
    # Who imports it first chooses its build for the whole process: mcplan, before a test asks if it is there.
    from mcplan.tracking import proxqp

    proxqp.load()


@pytest.fixture
def ctrl_c() -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt, as in a terminal: what shells start in the background ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
