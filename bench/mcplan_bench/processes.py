"""The same function on many tasks, in this process or in several."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from typing import Any, TypeVar

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

#: For processes whose linear algebra is to stay on one thread; read when NumPy is imported.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def each(function: Callable[[Task], Outcome], tasks: Sequence[Task], jobs: int) -> Iterator[tuple[int, Outcome]]:
    """Index of each task and what the function makes of it, as they are done.

    Args:
        function: Of a module, when there are several processes: it is sent there by name.
        tasks: Its arguments.
        jobs: Processes; 1: this one.
    """
    if jobs <= 1:
        for index, task in enumerate(tasks):
            yield index, function(task)
        return
    with _pool(jobs) as pool:
        with _deaf_to_interrupts():
            pending = {pool.submit(function, task): index for index, task in enumerate(tasks)}
        for future in as_completed(pending):
            yield pending[future], future.result()


def apart(function: Callable[..., Outcome], *arguments: Any) -> Outcome:
    """The function's result from a new process, on one thread and, where the system can say so, one core."""
    with environment(ONE_THREAD), _pool(1, _take_one_core) as pool:
        with _deaf_to_interrupts():
            future = pool.submit(function, *arguments)
        return future.result()


@contextmanager
def _pool(jobs: int, initializer: Callable[[], None] | None = None) -> Iterator[ProcessPoolExecutor]:
    """Processes that end with the block, also where it is left in the middle of their work."""
    # Spawned, not forked: a fork would copy the threads' locks of this process but not the threads.
    pool = ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn"), initializer=initializer)
    try:
        yield pool
    except BaseException:
        for process in list((pool._processes or {}).values()):
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Processes that are started meanwhile leave Ctrl-C, which a terminal sends to all, to this one; it gets its own
    afterwards."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def environment(values: Mapping[str, str]) -> Iterator[None]:
    """Environment variables for processes that are started meanwhile."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _take_one_core() -> None:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
