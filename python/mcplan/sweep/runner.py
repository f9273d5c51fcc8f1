"""A sweep run: what is left of it is handed to workers, here or on other machines, and tables are made at the end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan.arguments import MAX_JOBS, require, require_or_path, require_whole
from mcplan.files.outputs import require_folder
from mcplan.sweep import pool, store
from mcplan.sweep.tasks import Task, require_shard, share_of, tasks_of
from mcplan.sweep.work import CRASHED, RECORDS, REFUSED, REJECTED, TIMES, Job, head, work, write

if TYPE_CHECKING:
    from mcplan.files.sweep_specs import SweepSpec

    _Each = Callable[[Callable[[Job], str], Sequence[Job]], Iterator[tuple[int, Any]]]

#: How often a task may kill its worker at most.
MAX_ATTEMPTS = 1000


@dataclass(frozen=True)
class How:
    """How a sweep is run, which changes nothing of what comes of it.

    Attributes:
        jobs: Processes on this machine, at most MAX_JOBS.
        scheduler: Address of a Dask scheduler, "tcp://host:8786", whose workers are used instead; the folder of the sweep
            must be the same for all of them. "": none.
        shard: (i, n), 1 <= i <= n: do the i-th of n shares only.
        attempts: How often a task may kill its worker before it is recorded as crashed, at most MAX_ATTEMPTS.
        retry_crashed: Whether tasks that are recorded as crashed are tried again.
    """

    jobs: int = 1
    scheduler: str = ""
    shard: tuple[int, int] | None = None
    attempts: int = pool.ATTEMPTS
    retry_crashed: bool = False

    def __post_init__(self) -> None:
        """Raises InvalidArgument for a value of another type or out of its range."""
        require_whole("jobs", self.jobs, 1, MAX_JOBS)
        require_whole("attempts", self.attempts, 1, MAX_ATTEMPTS)
        require("scheduler", self.scheduler, str)
        require("retry_crashed", self.retry_crashed, bool)
        require_shard(self.shard)


@dataclass(frozen=True)
class Progress:
    """A task that is done.

    Attributes:
        task: Which.
        status: How it ended.
        done: Tasks of this share that are done, with those of earlier calls.
        of: Tasks of this share.
    """

    task: Task
    status: str
    done: int
    of: int


@dataclass
class Outcome:
    """What a call came to.

    Attributes:
        out: Folder of the sweep.
        tasks: Number of tasks of the whole sweep.
        share: Number of those of this share.
        ran: Number of those that this call has done.
        left: Number of tasks of the whole sweep that nobody has done yet; the tables are made when there are none.
        statuses: Number of tasks of this share by status.
        failed: Names and messages of those that crashed, were refused or whose plans were rejected.
    """

    out: Path
    tasks: int
    share: int
    ran: int = 0
    left: int = 0
    statuses: dict[str, int] = field(default_factory=dict)
    failed: list[tuple[str, str]] = field(default_factory=list)

    @property
    def crashed(self) -> int:
        """Tasks of this share that killed their workers, or whose saved plan the checker rejects."""
        return self.statuses.get(CRASHED, 0) + self.statuses.get(REJECTED, 0)


def run(
    spec: SweepSpec,
    out: str | Path,
    folder: str | Path = ".",
    how: How | None = None,
    progress: Callable[[Progress], None] | None = None,
    function: Callable[[Job], str] = work,
) -> Outcome:
    """Run what is left of a sweep.

    Args:
        spec: The sweep.
        out: Its folder, a new one or that of the same sweep.
        folder: From which the paths of the sweep are seen.
        how: Workers, share, attempts.
        progress: Called with each task that is done; first of all with none of this call done, if some are already.
        function: What does a task, of a module, and returns its status.

    Raises:
        InvalidArgument: An argument is of another type; nobody answers at the scheduler's address, and nothing is begun.
        InvalidInput: The folder cannot be made or written to.
        InvalidSweep: The folder holds something else.
        KeyboardInterrupt: Ctrl-C was pressed; what is done stays, and the same call goes on.
    """
    from mcplan.files.sweep_specs import SweepSpec

    require("spec", spec, SweepSpec)
    require("how", how, How, optional=True)
    require_or_path("out", out)
    require_or_path("folder", folder)
    how, out = how or How(), Path(out)
    require_folder("out", out)
    tasks = tasks_of(spec, Path(folder))
    share = share_of(tasks, how.shard)
    with _workers(how) as each:
        store.begin(out, store.manifest_of(spec, tasks, Path(folder)))
        left = store.pending(out, share, how.retry_crashed)
        store.sweep_away(out, left)
        done = len(share) - len(left)
        for task, status in _done(left, out, each, function):
            done += 1
            if progress is not None:
                progress(Progress(task, status, done, len(share)))
    outcome = Outcome(out, len(tasks), len(share), ran=len(left))
    records = _count(outcome, share, tasks)
    if outcome.left == 0:
        from mcplan.sweep.index import write_tables

        write_tables(out, tasks, [records[task.index] for task in tasks])
    return outcome


@contextmanager
def _workers(how: How) -> Iterator[_Each]:
    """What has a function called with each of some jobs by the workers, and gives index and outcome as they are done."""
    if not how.scheduler:
        yield lambda function, jobs: pool.each(function, jobs, how.jobs, how.attempts)
        return
    from mcplan.sweep import dask_pool

    with dask_pool.connected(how.scheduler) as client:
        yield lambda function, jobs: dask_pool.each(client, function, jobs)


def _done(tasks: Sequence[Task], out: Path, each: _Each, function: Callable[[Job], str]) -> Iterator[tuple[Task, str]]:
    """Tasks as they are done, and their status."""
    jobs = [Job(task, str(out.resolve())) for task in tasks]
    for index, outcome in each(function, jobs):
        if isinstance(outcome, pool.Crash):
            _record_crash(out, tasks[index], outcome)
            outcome = CRASHED
        yield tasks[index], outcome


def _record_crash(out: Path, task: Task, crash: pool.Crash) -> None:
    """How its processes ended is no property of the task, and stands beside its times."""
    write(out, task, TIMES, {"task": task.index, "crash": str(crash)})
    write(out, task, RECORDS, head(task) | {"status": CRASHED, "message": "killed every process that worked on it"})


def _count(outcome: Outcome, share: Sequence[Task], tasks: Sequence[Task]) -> dict[int, dict[str, Any]]:
    """Fill in what there is, and give all records by task."""
    records = {
        task.index: record for task in tasks if (record := store.read_record(outcome.out, task.stem)) is not None
    }
    outcome.left = len(tasks) - len(records)
    mine = [(task, records[task.index]) for task in share if task.index in records]
    outcome.statuses = dict(sorted(Counter(str(record["status"]) for _, record in mine).items()))
    outcome.failed = [
        (task.name, f"{record['status']}: {record['message']}")
        for task, record in mine
        if record["status"] in (CRASHED, REJECTED, REFUSED)
    ]
    return records
