"""The folder of a sweep: its manifest, and what is there of each task."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy

from mcplan import _core
from mcplan.errors import InvalidSweep, shown, shown_path
from mcplan.files.outputs import made_folder, write_whole
from mcplan.sweep.tasks import Task
from mcplan.sweep.work import CRASHED, EXPORTS, MOTIONS, PLANS, RECORDS, TIMES, files_of, path_of

if TYPE_CHECKING:
    from mcplan.files.sweep_specs import SweepSpec

MANIFEST, INDEX, TIMES_TABLE = "manifest.json", "index.parquet", "times.parquet"
CHECKSUMS, SUMMARY = "checksums.sha256", "summary.html"
_KIND, _FORMAT = "mcplan sweep", 1


def manifest_of(spec: SweepSpec, tasks: Sequence[Task]) -> dict[str, Any]:
    """What a sweep is: versions, seeds, the whole spec, and digests of the files that it names."""
    text = spec.model_dump_json(exclude_defaults=True)
    named = {task.source for task in tasks} | {task.robot_source for task in tasks}
    files = sorted(Path(source) for source in named if source.endswith(".toml"))
    return {
        "kind": _KIND,
        "format": _FORMAT,
        "name": spec.name,
        "tasks": len(tasks),
        "seed": spec.seed,
        "planner_seeds": list(spec.seeds),
        "repeatable": not {"time_limit", "time_limit_s"} & set(spec.options),
        "versions": {"mcplan": _core.__version__, "numpy": numpy.__version__, "python": platform.python_version()},
        "spec_sha256": hashlib.sha256(text.encode()).hexdigest(),
        "files_sha256": {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files if path.is_file()},
        "spec": json.loads(text),
    }


def begin(out: Path, manifest: dict[str, Any]) -> None:
    """Make the folder, or find in it the same sweep that has been begun.

    Raises:
        InvalidSweep: It holds another sweep, the same by another version, or other things.
    """
    if (out / MANIFEST).exists():
        found = read_manifest(out)
        for key, what in (
            ("spec_sha256", "what its file says"),
            ("files_sha256", "scene or robot files"),
            ("versions", "versions"),
        ):
            if found.get(key) != manifest[key]:
                rule = f"must be a new folder, or one of the same sweep: {what} differ"
                value = f"{shown_path(out)} with {shown(found.get(key))} instead of {shown(manifest[key])}"
                raise InvalidSweep("out", rule, shown_path(out) if key == "spec_sha256" else value)
    elif out.is_dir() and any(out.iterdir()):
        raise InvalidSweep("out", "must be a new or an empty folder, or one of this sweep", shown_path(out))
    else:
        made_folder(out)
        write_whole(json.dumps(manifest, indent=1) + "\n", out / MANIFEST)


def read_manifest(out: Path) -> dict[str, Any]:
    """The manifest of a folder.

    Raises:
        InvalidSweep: There is none, or it is damaged.
    """
    try:
        found = json.loads((out / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        found = None
    if not isinstance(found, dict) or found.get("kind") != _KIND:
        raise InvalidSweep("", f"must be the folder of a sweep, with {MANIFEST}", shown_path(out))
    if found.get("format") != _FORMAT:
        raise InvalidSweep("format", f"must be {_FORMAT}", shown(found.get("format")), str(out / MANIFEST))
    return found


def read_record(out: Path, task_stem: str) -> dict[str, Any] | None:
    """What is known of a task that is done: its record, if its plan is there, too."""
    try:
        record = json.loads((out / RECORDS / f"{task_stem}.json").read_bytes())
    except (OSError, ValueError):
        return None
    if not isinstance(record, dict):
        return None
    if not all((out / record[kind]).is_file() for kind in files_of(record)):
        return None
    return record


def pending(out: Path, tasks: Iterable[Task], retry_crashed: bool = False) -> list[Task]:
    """Tasks without a record; and those that crashed, if they are to be tried again."""
    left = []
    for task in tasks:
        record = read_record(out, task.stem)
        if record is None or (retry_crashed and record.get("status") == CRASHED):
            left.append(task)
    return left


def sweep_away(out: Path, tasks: Iterable[Task]) -> None:
    """Remove half-written files that a killed process has left of these tasks."""
    stems = {task.stem.rpartition("/")[2] for task in tasks}
    for kind in (PLANS, MOTIONS, EXPORTS, RECORDS, TIMES):
        for path in (out / kind).glob("*/.*"):
            if path.name[1:].partition(".")[0] in stems:
                with suppress(OSError):
                    path.unlink()


def records(out: Path) -> Iterator[dict[str, Any]]:
    """What there is of all tasks that are done, in any order."""
    for path in (out / RECORDS).glob("*/[0-9]*.json"):
        record = read_record(out, f"{path.parent.name}/{path.stem}")
        if record is not None:
            yield record


def times(out: Path) -> Iterator[dict[str, Any]]:
    """Times of all tasks that have some, in any order."""
    for path in (out / TIMES).glob("*/[0-9]*.json"):
        with suppress(OSError, ValueError):
            yield json.loads(path.read_bytes())


def times_of(out: Path, task: Task) -> dict[str, Any]:
    """Times of a task; without them its number alone."""
    with suppress(OSError, ValueError):
        found = json.loads(path_of(out, task, TIMES, ".json").read_bytes())
        if isinstance(found, dict):
            return found
    return {"task": task.index}
