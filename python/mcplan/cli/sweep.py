"""mcplan sweep"""

from __future__ import annotations

import json as json_module
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.arguments import MAX_JOBS
from mcplan.cli.given_options import named_as_typed, within

if TYPE_CHECKING:
    from mcplan.sweep.runner import Outcome, Progress

SpecArgument = Annotated[Path, typer.Argument(metavar="SPEC", help="TOML file that says what is planned.")]
OutOption = Annotated[
    Path, typer.Option("--out", metavar="DIR", help="Folder of the sweep; one that is begun goes on.")
]
JobsOption = Annotated[
    int, typer.Option("--jobs", metavar="N", callback=within(1, MAX_JOBS), help="Number of processes on this machine.")
]
SchedulerOption = Annotated[
    str, typer.Option("--scheduler", metavar="URL", help="Address of a Dask scheduler, whose workers are used instead.")
]
ShardOption = Annotated[
    str | None, typer.Option("--shard", metavar="I/N", help="Do the I-th of N shares only, counted from 1.")
]
AttemptsOption = Annotated[
    int,
    typer.Option(
        "--attempts",
        metavar="K",
        callback=within(1, 1000),
        help="How often a task may kill its process before it is given up.",
    ),
]
RetryOption = Annotated[bool, typer.Option("--retry-crashed", help="Try tasks again that are recorded as crashed.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


@named_as_typed("scheduler", "shard", "out")
def sweep(
    spec: SpecArgument,
    out: OutOption,
    jobs: JobsOption = 1,
    scheduler: SchedulerOption = "",
    shard: ShardOption = None,
    attempts: AttemptsOption = 3,
    retry_crashed: RetryOption = False,
    json: JsonOption = False,
) -> int:
    """Plan scenes x robots x options x seeds into tables and a page.

    What is done stays: the same command goes on where Ctrl-C (exit code 130), a crash or the end of a machine stopped it.
    The exit code is 0 once this share is done, whether its plans are solved or not, 1 if a task crashed or the checker
    rejects a saved plan that was called solved, and 2 if the file is wrong.

    Example: mcplan sweep examples/sweep.toml --out out/sweep --jobs 2
    """
    from mcplan.extras import require
    from mcplan.files.outputs import require_folder

    require("mcplan sweep", "sweep", "pydantic", "pyarrow", *(["distributed"] if scheduler else []))
    require_folder("--out", out)
    from mcplan.files.sweep_specs import load_sweep_spec
    from mcplan.sweep.runner import How, run
    from mcplan.sweep.tasks import parse_shard

    how = How(jobs, scheduler, parse_shard(shard) if shard is not None else None, attempts, retry_crashed)
    with _progress(quiet=json) as progress:
        outcome = run(load_sweep_spec(spec), out, spec.parent, how, progress)
    if json:
        print(json_module.dumps(summary(outcome)))
    else:
        _print(outcome)
    return 1 if outcome.crashed else 0


def summary(outcome: Outcome) -> dict[str, Any]:
    """What ``--json`` prints."""
    return {
        "out": str(outcome.out),
        "tasks": outcome.tasks,
        "share": outcome.share,
        "ran": outcome.ran,
        "left": outcome.left,
        "statuses": outcome.statuses,
        "failed": [{"task": name, "message": message} for name, message in outcome.failed],
    }


def _print(outcome: Outcome) -> None:
    from mcplan.cli.terminal import say
    from mcplan.sweep.store import INDEX, SUMMARY

    statuses = ", ".join(f"{count} {status}" for status, count in outcome.statuses.items()) or "this share is empty"
    say(f"{sum(outcome.statuses.values())} of {outcome.share} tasks: {statuses}")
    for name, message in outcome.failed[:20]:
        say(f"  {name}: {message}")
    if len(outcome.failed) > 20:
        say(f"  and {len(outcome.failed) - 20} more, in the table")
    if outcome.left:
        say(f"{outcome.left} tasks of other shares are left; who does the last one writes the tables")
    else:
        say(f"Wrote {outcome.out / INDEX}, {SUMMARY} and others beside it")


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[Progress], None] | None]:
    """A bar with rate and failures on stderr, if that is a terminal."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.fields[rate]}"), TimeRemainingColumn())
    with Bar(*columns, TextColumn("{task.fields[failures]}"), console=Console(file=sys.__stderr__)) as bar:
        shown = bar.add_task("", total=None, rate="", failures="")
        unsolved = 0

        def progress(done: Progress) -> None:
            nonlocal unsolved
            unsolved += done.status != "solved"
            speed = bar.tasks[0].speed
            rate = f"{speed:.2g} tasks/s" if speed else ""
            bar.update(shown, total=done.of, completed=done.done, rate=rate, failures=f"{unsolved} not solved")

        yield progress
