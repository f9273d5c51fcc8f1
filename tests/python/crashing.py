"""Task functions for the tests of process pools: what workers are asked to do is theirs, sent by name."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path
from typing import Any


def square_or_die(task: float) -> float:
    """The square; a negative number kills its process, zero leaves it."""
    if task < 0:
        os.kill(os.getpid(), signal.SIGKILL)
    if task == 0:
        os._exit(7)
    return task * task


def die_once(path: str) -> str:
    """Kills the process that comes first; the next one finds its mark."""
    mark = Path(path)
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGSEGV)
    return mark.name


def slowly(task: Any) -> Any:
    """The task itself, after a while."""
    time.sleep(0.3)
    return task


def is_deaf(number: int) -> bool:
    """Whether this process has a signal blocked."""
    return number in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def crash_on_task_one(job: Any) -> str:
    """A task of a sweep; number one kills its process."""
    from mcplan.sweep.work import work

    if job.task.index == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return work(job)
