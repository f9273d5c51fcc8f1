"""The same function on many tasks, in this process or in several."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, TypeVar

from mcplan.sweep import pool
from mcplan.sweep.pool import Crash, Crashed, deaf_to_interrupts

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

#: For processes whose linear algebra is to stay on one thread; read when NumPy is imported.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def each(
    function: Callable[[Task], Outcome],
    tasks: Sequence[Task],
    jobs: int,
    crashed: Callable[[Task, Crash], Outcome] | None = None,
) -> Iterator[tuple[int, Outcome]]:
    """Index of each task and what the function makes of it, as they are done.

    Args:
        function: Of a module, when there are several processes: it is sent there by name.
        tasks: Its arguments.
        jobs: Processes; 1: this one.
        crashed: What stands for the outcome of a task that kills its process again and again.

    Raises:
        Crashed: A task kills its process, and nothing stands for its outcome; all others have been done by then.
    """
    if jobs <= 1:
        for index, task in enumerate(tasks):
            yield index, function(task)
        return
    lost: list[str] = []
    for index, outcome in pool.each(function, tasks, jobs):
        if not isinstance(outcome, Crash):
            yield index, outcome
        elif crashed is not None:
            yield index, crashed(tasks[index], outcome)
        else:
            lost.append(f"{tasks[index]}: {outcome}")
    if lost:
        raise Crashed("\n".join(lost))


def apart(function: Callable[..., Outcome], *arguments: Any) -> Outcome:
    """The function's result from a new process, on one thread and, where the system can say so, one core."""
    with environment(ONE_THREAD), _single() as executor:
        with deaf_to_interrupts():
            future = executor.submit(function, *arguments)
        return future.result()


@contextmanager
def _single() -> Iterator[ProcessPoolExecutor]:
    """A process on one core that ends with the block, also where it is left in the middle of its work."""
    executor = ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"), initializer=_take_one_core)
    try:
        yield executor
    except BaseException:
        for process in list((executor._processes or {}).values()):
            process.terminate()
        raise
    finally:
        executor.shutdown(cancel_futures=True)


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
