"""Runs in .npz files: arrays and a JSON header, no pickles.

The header (bytes of UTF-8 JSON) has the kind "run" or "planar_run", the format's version, the version of mcplan, the
options, the measures, how the run ended, the names of joints, and the robot if it is not the plan's. The arrays are
those of the recording under their names (where a field was renamed, under the earlier one), and `plan`, the bytes of
the plan's file. Arrays are compressed.

What is of one kind alone is beside its recording and its result: they hand it to save_run and load_run.
"""

from __future__ import annotations

import errno
import io
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, Protocol, TypeVar, cast

import numpy as np

from mcplan._core import __version__
from mcplan.errors import InvalidInput, shown, written
from mcplan.files import whole_body_plans
from mcplan.files.archives import as_json, kind_text, read_arrays, read_header
from mcplan.files.builtin import exists
from mcplan.files.outputs import ARCHIVE, require_named, require_suffix, write_whole
from mcplan.files.plan_files import is_json
from mcplan.files.reading import MAX_PLAN_INFLATED, MAX_RUN, MAX_RUN_INFLATED, MAX_RUN_RATIO, read_file

from .options import Gains, Options, Push

FORMAT = 1
#: Arrays of a file, at most: one for each plan that was followed, some ten a second, and those of the recording.
MAX_ARRAYS = 16384
RUN, PLANAR_RUN = whole_body_plans.RUN_KINDS
#: Fields of recordings that are no arrays: those of the header, and what the plan's file contains.
_OTHERS = {"plan", "robot", "joints", "end_effectors", "fell_at_s", "left_plan_at_s", "touches", "true_scene"}
#: Arrays without a row for each instant, and those that files of earlier versions lack.
_WITHOUT_ROWS, _LATER = {"torque_limits", "velocity_limits"}, {"velocity_limits"}

T = TypeVar("T")
Header = Mapping[str, Any]
Arrays = Mapping[str, np.ndarray]


class _Measures(Protocol):
    def as_dict(self) -> dict[str, Any]: ...


@dataclass(frozen=True)
class RunParts:
    """The content of the file of a run.

    Attributes:
        kind: RUN or PLANAR_RUN.
        recording: A dataclass; its arrays are saved under their names.
        plan: Bytes of the plan's file.
        measures: Measures of the run.
        options: Options as they were used.
        interrupted: Whether Ctrl-C ended the run.
        ended_at_s: Time at which the run ended early; infinite: it did not.
        more: Other entries of the header: names of joints, the robot.
        files: Bytes of further files by name, such as plans that were followed.
    """

    kind: str
    recording: Any
    plan: bytes
    measures: _Measures
    options: Options
    interrupted: bool
    ended_at_s: float
    more: dict[str, Any]
    files: Mapping[str, bytes] = field(default_factory=dict)


def save_run(parts: RunParts, path: str | Path) -> None:
    """Write a run to a file, which is complete or not there at all."""
    require_suffix("path", path, (*ARCHIVE, ""))
    header: dict[str, Any] = {
        "kind": parts.kind,
        "format": FORMAT,
        "mcplan": __version__,
        "options": asdict(parts.options),
        "measures": plain(parts.measures.as_dict()),
        "interrupted": parts.interrupted,
        "ended_at_s": plain(parts.ended_at_s),
        **parts.more,
    }
    names = _array_names(type(parts.recording))
    content = {in_file: getattr(parts.recording, name) for name, in_file in names.items()}
    most = MAX_ARRAYS - len(content) - 2
    if len(parts.files) > most:
        rule = f"must be at most {most}, which a file can have (keep the end of the run alone with keep_s)"
        raise InvalidInput("plans", rule, str(len(parts.files)))
    content["header"] = np.frombuffer(json.dumps(as_json(header), allow_nan=False).encode(), dtype=np.uint8)
    for name, data in {"plan": parts.plan, **parts.files}.items():
        content[name] = np.frombuffer(data, dtype=np.uint8)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **cast(Any, content))
    write_whole(buffer.getvalue(), path)


def load_run(
    path: str | Path,
    makers: Mapping[str, Callable[[Header, Arrays], T]],
    otherwise: Callable[[str | Path], T] | None = None,
) -> T:
    """Read a run written by save_run.

    Args:
        path: The file.
        makers: By kind: what makes the run of the header and the arrays.
        otherwise: Called for a file that is of no run; None: it is refused.

    Raises:
        InvalidInput: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    require_named(path)
    if not exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    data = read_file(path, MAX_RUN, InvalidInput)
    if otherwise is not None and is_json(data, path):
        return otherwise(path)
    try:
        inflated = min(MAX_RUN_INFLATED, MAX_RUN_RATIO * len(data) + MAX_PLAN_INFLATED)
        arrays = read_arrays(data, inflated, MAX_ARRAYS)
        header = read_header(arrays)
        kind = header.get("kind")
        if not isinstance(kind, str) or kind not in (RUN, PLANAR_RUN):
            if otherwise is not None:
                return otherwise(path)
            raise InvalidInput(
                "header.kind", f"must be {written(RUN)} or {written(PLANAR_RUN)}: no file of a run", kind_text(header)
            )
        if header.get("format") != FORMAT:
            raise InvalidInput(
                "header.format", f"must be {FORMAT} for this version of mcplan", written(header.get("format"))
            )
        if kind not in makers:
            others = {
                RUN: "that of a planar robot; see TrackingResult.load",
                PLANAR_RUN: "that of a robot with a URDF; see PlanarResult.load",
            }
            raise InvalidInput("header.kind", f"must be {others[kind]}", "")
        try:
            return makers[kind](header, arrays)
        except InvalidInput:
            raise
        except (KeyError, TypeError, AttributeError, ValueError, OverflowError) as found:
            raise InvalidInput("header", "must be as mcplan track --save writes it", shown(str(found))) from None
    except InvalidInput as found:
        raise found.moved(InvalidInput, str(path)) from None


def columns_of(recording: type, arrays: Arrays) -> dict[str, Any]:
    """The arrays of a recording.

    Raises:
        InvalidInput: One is missing, or has not a row for each instant.
    """
    names = _array_names(recording)
    for name in names.values():
        if name in _LATER and name not in arrays:
            continue
        if name not in arrays:
            raise InvalidInput(name, "is required")
        rows = len(arrays["times_s"]) if "times_s" in arrays else 0
        if name not in _WITHOUT_ROWS and len(arrays[name]) != rows:
            raise InvalidInput(name, f"must have {rows} rows", str(len(arrays[name])))
    return {name: arrays[in_file] for name, in_file in names.items() if in_file in arrays}


def options_of(header: Header) -> Options:
    """The options of the run."""
    # Runs of earlier versions had full torque at every speed, and links passed through each other.
    data = {"speed_limits": False, "self_contacts": False, **header["options"]}
    pushes = tuple(Push(**push) for push in data["pushes"])
    return Options(**{**data, "pushes": pushes, "gains": Gains(**data["gains"])})


def measures_of(header: Header) -> dict[str, Any]:
    """The measures of the run, by name."""
    return numbers(header["measures"])


def _array_names(recording: type) -> dict[str, str]:
    """Names in files of the arrays of a recording, by the names of its fields."""
    own = [item for item in fields(recording) if item.name not in _OTHERS]
    return {item.name: item.metadata.get("in_file", item.name) for item in own}


def numbers(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by name as they were before ``plain``: those that are text are "nan" or "inf"."""
    return {key: float(value) if isinstance(value, str) else value for key, value in values.items()}


def plain(value: Any) -> Any:
    """With "nan" and "inf" for numbers that JSON cannot represent."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return str(value) if isinstance(value, float) and not np.isfinite(value) else value
