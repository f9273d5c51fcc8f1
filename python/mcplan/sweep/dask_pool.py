"""The same function on many tasks on the workers of a Dask scheduler."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from mcplan.errors import InvalidArgument, shown
from mcplan.sweep.pool import Crash

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")
#: Addresses that Dask knows: a host and a port, or a scheduler in this process.
_ADDRESS = re.compile(r"((tcp|tls|ws|wss|ucx|ucxx)://)?(\[[0-9a-fA-F:.%]+\]|[^\s/:]+):[0-9]{1,5}|inproc://\S+")
#: Longest wait for the scheduler to answer [s].
_PATIENCE_S = 30


@contextmanager
def connected(scheduler: str) -> Iterator[Any]:
    """A client of a scheduler, which is closed at the end.

    Args:
        scheduler: Address, "tcp://host:8786".

    Raises:
        InvalidArgument: Nobody answers at that address.
    """
    from distributed import Client

    if not _ADDRESS.fullmatch(scheduler):  # Dask asks a client that it could not make for a minute
        raise InvalidArgument(
            "scheduler", 'must be the address of a Dask scheduler, such as "tcp://host:8786"', shown(scheduler)
        )
    try:
        client = Client(scheduler, timeout=_PATIENCE_S, set_as_default=False)
    except Exception as error:  # also an AssertionError, of a scheme that it does not know
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InvalidArgument(
            "scheduler", f"must be the address of a Dask scheduler ({reason})", shown(scheduler)
        ) from None
    try:
        yield client
    finally:
        client.close()


def each(
    client: Any, function: Callable[[Task], Outcome], tasks: Sequence[Task]
) -> Iterator[tuple[int, Outcome | Crash]]:
    """As ``pool.each``, on the workers of a scheduler.

    No more tasks are sent at a time than the workers have threads: Dask suspects all that a dead worker had been given, so
    that only what it was doing is suspected. How many workers may die of a task is an option of the scheduler,
    ``distributed.scheduler.allowed-failures``.

    Args:
        client: Of the scheduler.
        function: Of a module that workers can import, too.
        tasks: Its arguments.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed; tasks that are not begun are taken back.
    """
    from distributed import as_completed

    left = deque(range(len(tasks)))
    sent: dict[Any, int] = {}
    try:
        waiting = as_completed(loop=client.loop)
        _send(client, function, tasks, left, sent, waiting)
        for future in waiting:
            index = sent.pop(future)
            outcome = _outcome(future)
            _send(client, function, tasks, left, sent, waiting)
            yield index, outcome
    finally:
        if sent:
            client.cancel(list(sent))


def _send(
    client: Any, function: Any, tasks: Sequence[Any], left: deque[int], sent: dict[Any, int], waiting: Any
) -> None:
    """Send tasks until every thread of the workers has one; at least one, for workers that are still to come."""
    threads = max(1, sum(client.nthreads().values()))
    while left and len(sent) < threads:
        index = left.popleft()
        future = client.submit(function, tasks[index], pure=False)
        sent[future] = index
        waiting.add(future)


def _outcome(future: Any) -> Any:
    """Result of a future; what killed its workers is a ``Crash``, and an exception of the function comes out."""
    from distributed import KilledWorker

    error = future.exception() if future.status == "error" else None
    if isinstance(error, KilledWorker):
        return Crash(error.allowed_failures + 1, "its Dask worker died")
    return future.result()
