"""The same function on many tasks on the workers of a Dask scheduler."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from mcplan.errors import InvalidArgument, shown
from mcplan.sweep.pool import Crash

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")
#: Longest wait for the scheduler to answer [s].
_PATIENCE_S = 30


def each(
    function: Callable[[Task], Outcome], tasks: Sequence[Task], scheduler: str
) -> Iterator[tuple[int, Outcome | Crash]]:
    """As ``pool.each``, on the workers of a scheduler.

    No more tasks are sent at a time than the workers have threads: Dask suspects all that a dead worker had been given, so
    that only what it was doing is suspected. How many workers may die of a task is an option of the scheduler,
    ``distributed.scheduler.allowed-failures``.

    Args:
        function: Of a module that workers can import, too.
        tasks: Its arguments.
        scheduler: Address, "tcp://host:8786".

    Raises:
        InvalidArgument: Nobody answers at that address.
        KeyboardInterrupt: Ctrl-C was pressed; tasks that are not begun are taken back.
    """
    from distributed import Client, as_completed

    try:
        client = Client(scheduler, timeout=_PATIENCE_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InvalidArgument(
            "scheduler", f"must be the address of a Dask scheduler ({error})", shown(scheduler)
        ) from None
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
        client.close()


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
