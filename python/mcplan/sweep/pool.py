"""The same function on many tasks in processes of this machine, of which any may die without ending the others.

A pool of the standard library is lost with the first process that dies. Here each worker has a pipe of its own, so that it
is known which task killed it: that task is tried again in a new process, and after some attempts told as a ``Crash``.
"""

from __future__ import annotations

import multiprocessing
import signal
import traceback
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from typing import Any, Generic, TypeVar

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

#: How often a task may kill its worker before it is given up.
ATTEMPTS = 3
#: Longest wait for a process that has nothing left to do [s].
_PATIENCE_S = 10.0


@dataclass(frozen=True)
class Crash:
    """A task whose workers died.

    Attributes:
        attempts: How many of them.
        reason: How the last one ended, e.g. "its process was ended by SIGSEGV".
    """

    attempts: int
    reason: str

    def __str__(self) -> str:
        return f"{self.reason}, in {self.attempts} of {self.attempts} attempts"


class Crashed(RuntimeError):
    """A task killed its workers, and who asked for it has no use for a ``Crash``; the message names the task."""


@dataclass
class _Worker(Generic[Task]):
    process: Any
    pipe: Connection
    index: int = -1  # of the task that it has


@dataclass
class _Queue(Generic[Task]):
    """What is still to be done, and how often each task has killed a worker."""

    tasks: Sequence[Task]
    attempts: int
    left: deque[int] = field(default_factory=deque)
    deaths: dict[int, int] = field(default_factory=dict)

    def died(self, index: int, exit_code: int | None) -> Crash | None:
        """Put a task back whose worker died, in front; or give it up."""
        self.deaths[index] = self.deaths.get(index, 0) + 1
        if self.deaths[index] >= self.attempts:
            return Crash(self.deaths[index], _how(exit_code))
        self.left.appendleft(index)
        return None


def each(
    function: Callable[[Task], Outcome], tasks: Sequence[Task], jobs: int, attempts: int = ATTEMPTS
) -> Iterator[tuple[int, Outcome | Crash]]:
    """Index of each task and what the function makes of it, as they are done; always in other processes than this one.

    Args:
        function: Of a module: it is sent there by name. An exception of it comes out here.
        tasks: Its arguments.
        jobs: Processes.
        attempts: How often a task may kill its worker before its outcome is a ``Crash``.

    Raises:
        KeyboardInterrupt: Ctrl-C was pressed; the processes are ended, in the middle of their work.
    """
    queue = _Queue(tasks, max(1, attempts), deque(range(len(tasks))))
    workers: list[_Worker[Task]] = []
    try:
        while queue.left or workers:
            while queue.left and len(workers) < jobs:
                workers.append(_start(function))
                _give(workers[-1], queue)
            yield from _finished(workers, queue)
    finally:
        for worker in workers:
            worker.process.terminate()
        for worker in workers:
            _end(worker)


def _finished(workers: list[_Worker[Task]], queue: _Queue[Task]) -> Iterator[tuple[int, Any]]:
    """Outcomes of the workers that have one, or have died; who is idle gets the next task, or leaves."""
    ready = set(wait([worker.pipe for worker in workers]))
    for worker in [worker for worker in workers if worker.pipe in ready]:
        index = worker.index
        try:
            good, outcome = worker.pipe.recv()
        except (EOFError, OSError):
            workers.remove(worker)
            _end(worker)
            crash = queue.died(index, worker.process.exitcode)
            if crash is not None:
                yield index, crash
            continue
        if not good:
            raise outcome
        if queue.left:
            _give(worker, queue)
        else:
            workers.remove(worker)
            _end(worker)
        yield index, outcome


def _start(function: Callable[[Any], Any]) -> _Worker[Any]:
    # Spawned, not forked: a fork would copy the threads' locks of this process but not the threads.
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_work, args=(theirs, function), daemon=True)
    with deaf_to_interrupts():
        process.start()
    theirs.close()  # else its end would go unnoticed
    return _Worker(process, ours)


def _give(worker: _Worker[Task], queue: _Queue[Task]) -> None:
    worker.index = queue.left.popleft()
    with suppress(OSError):  # a worker that has died already: its pipe says so next
        worker.pipe.send(queue.tasks[worker.index])


def _end(worker: _Worker[Any]) -> None:
    worker.pipe.close()
    worker.process.join(_PATIENCE_S)
    if worker.process.exitcode is None:
        worker.process.kill()
        worker.process.join()


def _work(pipe: Connection, function: Callable[[Any], Any]) -> None:
    """What a worker does until there is nobody left to ask."""
    with suppress(EOFError, OSError):
        while True:
            task = pipe.recv()
            try:
                answer = True, function(task)
            except Exception as error:
                if hasattr(error, "add_note"):  # from Python 3.11 on
                    error.add_note(f"In a worker:\n{traceback.format_exc()}")
                answer = False, error
            pipe.send(answer)


def _how(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        with suppress(ValueError):
            return f"its process was ended by {signal.Signals(-exit_code).name}"
    return f"its process ended with exit code {exit_code}"


@contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """Processes that are started meanwhile leave Ctrl-C, which a terminal sends to all, to this one; it gets its own
    afterwards."""
    # It starts with the first process otherwise, between our blocking SIGINT and that process, and unblocks it.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
