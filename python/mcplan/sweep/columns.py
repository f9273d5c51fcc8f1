"""Columns of a sweep's tables and their types in Arrow; what fits in no table is the file of no task."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mcplan.sweep.work import MEASURES, files_of

#: Columns of the index that say which task it is, before its parameters.
HEAD = {"task": "int64", "entry": "string", "robot": "string", "engine": "string", "seed": "int64"}
#: Columns of the index between parameters and options, and their types in Arrow.
RESULTS = {
    "scene": "string",
    "status": "string",
    "message": "string",
    "cost": "double",
    "iterations": "int64",
    "switches": "int64",
    "phases": "int64",
    "duration_s": "double",
    "worst_violation": "string",
    "worst_value": "double",
    "worst_tolerance": "double",
    "worst_unit": "string",
    "worst_time_s": "double",
    "contact_sequence": "list<string>",
    "durations_s": "list<double>",
    "plan": "string",
    "plan_sha256": "string",
}
#: Those of whole-body motions, in the index of sweeps that have them.
MOTION_RESULTS = {
    "motion_status": "string",
    "motion_message": "string",
    "motion_iterations": "int64",
    **{f"motion_{name}": "double" for name in MEASURES},
    "motion": "string",
    "motion_sha256": "string",
}
#: Columns of the table of times.
TIMES = {
    "task": "int64",
    "wall_s": "double",
    "cpu_s": "double",
    "plan_wall_s": "double",
    "plan_cpu_s": "double",
    "motion_cpu_s": "double",
    "export_cpu_s": "double",
    "began": "double",
    "host": "string",
    "crash": "string",
}

_TYPES: dict[str, tuple[type, ...]] = {"int64": (int,), "double": (int, float), "string": (str,)}


def is_record(found: Any, task: int) -> bool:
    """Whether what a file holds is the record of a task: all that the index asks for, of its types."""
    if not isinstance(found, dict) or found.get("task") != task or not isinstance(found.get("status"), str):
        return False
    if not all(isinstance(found.get(name), dict) for name in ("parameters", "options")):
        return False
    columns = {**RESULTS, **MOTION_RESULTS, **dict.fromkeys((n for n in found if n.startswith("export_")), "string")}
    paths = all(isinstance(found.get(name), str) for name in files_of(found))
    return paths and _fits(found, HEAD, required=True) and _fits(found, columns)


def is_times(found: Any, task: int) -> bool:
    """Whether what a file holds are the times of a task."""
    return isinstance(found, dict) and found.get("task") == task and _fits(found, TIMES)


def _fits(found: Mapping[str, Any], columns: Mapping[str, str], required: bool = False) -> bool:
    values = ((found.get(name), kind) for name, kind in columns.items())
    return all((value is None and not required) or _is(value, kind) for value, kind in values)


def _is(value: Any, kind: str) -> bool:
    if kind.startswith("list"):
        inner = kind.removeprefix("list<").removesuffix(">")
        return isinstance(value, list) and all(_is(item, inner) for item in value)
    return isinstance(value, _TYPES[kind]) and not isinstance(value, bool)
