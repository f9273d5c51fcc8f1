"""Runs in .npz files: arrays and a JSON header, no pickles.

The header (bytes of UTF-8 JSON) holds the kind "run" or "planar_run", the format's version, the version of mcplan, the
options, the measures, how the run ended, the names of joints, and the robot if it is not the plan's. The arrays are those
of Recording or PlanarRecording under their names, and `plan`, the bytes of the plan's file. Arrays are compressed.
"""

from __future__ import annotations

import errno
import io
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mcplan._core import __version__
from mcplan.errors import InvalidInput, shown
from mcplan.files import plans, whole_body_plans
from mcplan.files.archives import read_arrays, read_header
from mcplan.files.builtin import exists
from mcplan.files.outputs import ARCHIVE, require_suffix, write_whole
from mcplan.files.reading import MOST_PLAN_INFLATED, MOST_RUN, MOST_RUN_INFLATED, MOST_RUN_RATIO, read_file
from mcplan.files.robots import robot_from_dict, robot_to_dict

from .measures import Measures
from .options import Gains, Options, Push
from .planar.measures import PlanarMeasures
from .planar.recording import PlanarRecording
from .recording import Recording
from .result import TrackingResult

if TYPE_CHECKING:
    from .planar import PlanarResult

FORMAT = 1
RUN, PLANAR_RUN = whole_body_plans.RUN_KINDS
#: How a run ended, by kind: the time of it, infinite in most.
_ENDS = {RUN: "fell_at_s", PLANAR_RUN: "left_plan_at_s"}
_NAMES = {RUN: ("joints",), PLANAR_RUN: ("joints", "ends")}


def save_run(result: TrackingResult | PlanarResult, path: str | Path) -> None:
    """Write a run to a file, which is complete or not there at all."""
    require_suffix("path", path, (*ARCHIVE, ""))
    recording = result.recording
    kind = RUN if isinstance(recording, Recording) else PLANAR_RUN
    header: dict[str, Any] = {
        "kind": kind,
        "format": FORMAT,
        "mcplan": __version__,
        "options": asdict(result.options),
        "measures": _plain(result.measures.as_dict()),
        "interrupted": result.interrupted,
        "ended_at_s": _plain(getattr(recording, _ENDS[kind])),
    }
    header |= {name: list(getattr(recording, name)) for name in _NAMES[kind]}
    if isinstance(recording, Recording):
        header["robot"] = None if recording.robot is None else robot_to_dict(recording.robot)
        plan = plans.plan_to_bytes(recording.plan)
    else:
        plan = whole_body_plans.plan_to_bytes(recording.plan)
    content = {name: getattr(recording, name) for name in _array_names(type(recording))}
    content["header"] = np.frombuffer(json.dumps(header, allow_nan=False).encode(), dtype=np.uint8)
    content["plan"] = np.frombuffer(plan, dtype=np.uint8)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **cast(Any, content))
    write_whole(buffer.getvalue(), path)


def load_run(path: str | Path) -> TrackingResult | PlanarResult:
    """Read a run written by save_run.

    Raises:
        InvalidInput: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    if not exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    data = read_file(path, MOST_RUN, InvalidInput)
    try:
        arrays = read_arrays(data, min(MOST_RUN_INFLATED, MOST_RUN_RATIO * len(data) + MOST_PLAN_INFLATED))
        header = read_header(arrays)
        kind = header.get("kind")
        if not isinstance(kind, str) or kind not in _ENDS:
            raise InvalidInput("header.kind", f"must be {RUN!r} or {PLANAR_RUN!r}: no file of a run", shown(kind))
        if header.get("format") != FORMAT:
            raise InvalidInput(
                "header.format", f"must be {FORMAT} for this version of mcplan", shown(header.get("format"))
            )
        try:
            return _planar_result(header, arrays) if kind == PLANAR_RUN else _result(header, arrays)
        except InvalidInput:
            raise
        except (KeyError, TypeError, AttributeError, ValueError, OverflowError) as found:
            raise InvalidInput("header", "must hold what mcplan track --save writes", shown(str(found))) from None
    except InvalidInput as found:
        raise found.moved(InvalidInput, str(path)) from None


def _result(header: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> TrackingResult:
    plan = plans.plan_from_bytes(arrays["plan"].tobytes())
    robot = None if header["robot"] is None else robot_from_dict(header["robot"])
    columns = _columns(Recording, arrays)
    recording = Recording(
        plan=plan, joints=tuple(header["joints"]), fell_at_s=float(header["ended_at_s"]), robot=robot, **columns
    )
    measures = Measures(**_measures(header["measures"]))
    return TrackingResult(recording, measures, _options(header["options"]), bool(header["interrupted"]))


def _planar_result(header: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> PlanarResult:
    from .planar import PlanarResult

    columns = _columns(PlanarRecording, arrays)
    recording = PlanarRecording(
        plan=whole_body_plans.plan_from_bytes(arrays["plan"].tobytes()),
        joints=tuple(header["joints"]),
        ends=tuple(header["ends"]),
        left_plan_at_s=float(header["ended_at_s"]),
        **columns,
    )
    measures = PlanarMeasures(**_measures(header["measures"]))
    return PlanarResult(recording, measures, _options(header["options"]), bool(header["interrupted"]))


def _array_names(recording: type) -> list[str]:
    """Fields that hold arrays: all but those of the header."""
    others = {"plan", "robot", *_ENDS.values(), *_NAMES[PLANAR_RUN]}
    return [item.name for item in fields(recording) if item.name not in others]


def _columns(recording: type, arrays: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """The arrays of a recording.

    Raises:
        InvalidInput: One is missing, or has not a row for each instant.
    """
    names = _array_names(recording)
    for name in names:
        if name not in arrays:
            raise InvalidInput(name, "is required")
        rows = len(arrays["times_s"]) if "times_s" in arrays else 0
        if name != "torque_limits" and len(arrays[name]) != rows:
            raise InvalidInput(name, f"must have {rows} rows", str(len(arrays[name])))
    return {name: arrays[name] for name in names}


def _options(data: Mapping[str, Any]) -> Options:
    pushes = tuple(Push(**push) for push in data["pushes"])
    return Options(**{**data, "pushes": pushes, "gains": Gains(**data["gains"])})


def _plain(value: Any) -> Any:
    """With "nan" and "inf" for numbers that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return str(value) if isinstance(value, float) and not np.isfinite(value) else value


def _measures(data: Mapping[str, Any]) -> dict[str, Any]:
    return {key: float(value) if isinstance(value, str) else value for key, value in data.items()}
