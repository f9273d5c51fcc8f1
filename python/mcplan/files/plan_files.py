"""What files of all plans share: they are archives (.npz), or JSON where their name or content says so."""

from __future__ import annotations

import codecs
import errno
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

from mcplan.errors import InvalidInput, InvalidPlan
from mcplan.files.archives import kind_in
from mcplan.files.builtin import exists
from mcplan.files.outputs import ARCHIVE, JSON, require_named, require_suffix, write_whole
from mcplan.files.reading import MAX_PLAN, read_file

_Plan = TypeVar("_Plan")

_RUN = "a run of one, which mcplan track or mcplan run saved"
#: What files that are no plans are, by the kind that their headers say.
_OTHERS: Mapping[str, str] = {
    "run": _RUN,
    "planar_run": _RUN,
    "motion": "a motion along one, which mcplan motion or mcplan plan --motion saved",
}


def write_plan_file(
    plan: _Plan, path: str | Path, to_json: Callable[[_Plan], bytes], to_archive: Callable[[_Plan], bytes]
) -> None:
    """Write a plan to a file, which is complete or not there at all.

    Raises:
        InvalidInput: The name promises another kind of file.
        OSError: The file cannot be written.
    """
    require_suffix("path", path, (*ARCHIVE, *JSON, ""))
    as_json = Path(path).suffix.lower() in JSON
    write_whole(to_json(plan) if as_json else to_archive(plan), path)


def load_plan_file(
    path: str | Path, from_json: Callable[[bytes], _Plan], from_archive: Callable[[bytes], _Plan]
) -> _Plan:
    """Read a plan.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    try:
        data = read_plan_file(path)
        if is_json(data, path):
            return from_json(data)
        kind = kind_in(data)
        if isinstance(kind, str) and kind in _OTHERS:
            raise InvalidPlan("", "must be a plan", _OTHERS[kind])
        return from_archive(data)
    except InvalidInput as found:
        raise found.moved(InvalidPlan, str(path)) from None


def is_json(data: bytes, path: str | Path) -> bool:
    """Whether a file is to be read as JSON: it begins like an object, or has the ending of JSON and is no archive."""
    named = Path(path).suffix.lower() in JSON and not data.startswith(b"PK")
    return named or data[:100].removeprefix(codecs.BOM_UTF8).lstrip().startswith(b"{")


def read_plan_file(path: str | Path) -> bytes:
    """The content of a plan file of any kind.

    Raises:
        InvalidPlan: It cannot be read, or is no regular file or too large.
        InvalidInput: The path is empty.
        FileNotFoundError: There is no such file.
    """
    require_named(path)
    if not exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    return read_file(path, MAX_PLAN, InvalidPlan)
