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
from mcplan.sweep.columns import is_record, is_times
from mcplan.sweep.tasks import Task, located
from mcplan.sweep.work import CRASHED, EXPORTS, MOTIONS, PLANS, RECORDS, TIMES, files_of, path_of

if TYPE_CHECKING:
    from mcplan.files.sweep_specs import SweepSpec

MANIFEST, INDEX, TIMES_TABLE = "manifest.json", "index.parquet", "times.parquet"
CHECKSUMS, SUMMARY = "checksums.sha256", "summary.html"
_KIND, _FORMAT = "mcplan sweep", 1
#: How the name of a manifest begins that is being written.
_BEGINNING = ".manifest."


def manifest_of(spec: SweepSpec, tasks: Sequence[Task], folder: Path = Path(".")) -> dict[str, Any]:
    """What a sweep is: versions, seeds, the whole spec, and digests of the files that it names, seen from a folder."""
    text = spec.model_dump_json(exclude_defaults=True)
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
        "files_sha256": {
            name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in named_files(spec, folder)
        },
        "spec": json.loads(text),
    }


def named_files(spec: SweepSpec, folder: Path) -> list[tuple[str, Path]]:
    """Files of scenes and robots as the spec names them, and where they are; of a robot's file its URDF, too."""
    from mcplan.files.robots import load_robot

    scenes = {entry.scene for entry in spec.scenes if entry.scene is not None}
    robots = {*spec.robots, *(robot for entry in spec.scenes for robot in entry.robots or [])}
    found = {name: Path(located(name, folder)) for name in scenes | robots}
    files = {name: path for name, path in found.items() if path.is_absolute()}
    for name in robots & files.keys():
        urdf = Path(load_robot(files[name]).urdf)
        if urdf.is_file():
            files[f"{name}: {urdf.name}"] = urdf
    return sorted(files.items())


def begin(out: Path, manifest: dict[str, Any]) -> None:
    """Make the folder, or find in it the same sweep that has been begun.

    Raises:
        InvalidSweep: It holds another sweep, the same by another version, or other things.
    """
    if not (out / MANIFEST).exists():
        # Shards may begin at once: a manifest that another is about to rename is no stranger, and all write the same.
        strangers = out.is_dir() and any(not path.name.startswith(_BEGINNING) for path in out.iterdir())
        if strangers and not (out / MANIFEST).exists():
            raise InvalidSweep("out", "must be a new or an empty folder, or one of this sweep", shown_path(out))
        made_folder(out)
        if not strangers:
            write_whole(json.dumps(manifest, indent=1) + "\n", out / MANIFEST)
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
    for key, kind, rule in (("tasks", int, "must be a whole number"), ("name", str, "must be a text")):
        if not isinstance(found.get(key), kind):
            raise InvalidSweep(key, rule, shown(found.get(key)), str(out / MANIFEST))
    return found


def read_record(out: Path, task_stem: str, whole: bool = False) -> dict[str, Any] | None:
    """What is known of a task that is done: its record, if its plan and its other files are there, too.

    Args:
        out: Folder of the sweep.
        task_stem: Of the task's files.
        whole: Whether files whose content is not that of their checksum count as missing.
    """
    try:
        record = json.loads((out / RECORDS / f"{task_stem}.json").read_bytes())
    except (OSError, ValueError):
        return None
    if not is_record(record, _task_of(task_stem)):
        return None
    if not all(_is_there(out / record[kind], record[f"{kind}_sha256"] if whole else "") for kind in files_of(record)):
        return None
    return dict(record)


def _task_of(stem: str) -> int:
    return int(stem.rpartition("/")[2])


def _is_there(path: Path, digest: str) -> bool:
    """Whether a file is there, and has a digest if one is given."""
    return path.is_file() and (not digest or hashlib.sha256(path.read_bytes()).hexdigest() == digest)


def pending(out: Path, tasks: Iterable[Task], retry_crashed: bool = False) -> list[Task]:
    """Tasks without a record or with damaged files; and those that crashed, if they are to be tried again."""
    left = []
    for task in tasks:
        record = read_record(out, task.stem, whole=True)
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
            found = json.loads(path.read_bytes())
            if is_times(found, int(path.stem)):
                yield found


def times_of(out: Path, task: Task) -> dict[str, Any]:
    """Times of a task; without them its number alone."""
    with suppress(OSError, ValueError):
        found = json.loads(path_of(out, task, TIMES, ".json").read_bytes())
        if is_times(found, task.index):
            return dict(found)
    return {"task": task.index}
