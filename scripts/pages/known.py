"""Names that the product has: what tables of a page have to list."""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import fields
from functools import cache
from pathlib import Path

import mcplan
from mcplan import Status, Tolerances
from mcplan.files.planar_robots import list_planar_robots
from mcplan.files.planar_tasks import list_planar_tasks
from mcplan.files.robots import list_robots
from mcplan.files.scenes import list_scenes
from mcplan.tracking.measures import Measures
from pages import made
from pages.page import ROOT


def _status() -> list[str]:
    return list(Status.__members__)


def _solver_status() -> list[str]:
    """Those of searches that are given their contact sequence."""
    return [name for name in Status.__members__ if name != "no_sequence"]


@cache
def _checked() -> list[str]:
    """Names of constraints in the order of `Constraint`."""
    text = (ROOT / "cpp/src/plan/checker.cpp").read_text(encoding="utf-8")
    text += (ROOT / "cpp/src/plan/check_internal.hpp").read_text(encoding="utf-8")
    listed = re.search(r"enum class Constraint \{(.*?)\}", text, re.S)
    return re.findall(r"^\s*(\w+),", listed[1] if listed else "", re.M)


def _checked_bodies() -> list[str]:
    text = (ROOT / "cpp/include/mcplan/planar/checker.hpp").read_text(encoding="utf-8")
    listed = re.search(r"enum class PlanarConstraint \{(.*?)\}", text, re.S)
    return re.findall(r"^\s*(\w+),", listed[1] if listed else "", re.M)


def _fidelities() -> list[str]:
    return list(mcplan.rhp.Fidelity.__members__)


@cache
def _sip_json() -> list[str]:
    """Keys of `mcplan sip --json`, of a task that is solved at once."""
    with tempfile.TemporaryDirectory() as folder:
        return list(json.loads(made.run("mcplan sip walking --kinematics --minimise none --json -q", Path(folder))))


@cache
def _plan_json() -> list[str]:
    """Keys of `mcplan plan --json`."""
    with tempfile.TemporaryDirectory() as folder:
        return list(json.loads(made.run("mcplan plan flat --json", Path(folder))))


def _track_json() -> list[str]:
    """Keys of `mcplan track --json` for plans of humanoids, from what prints them; a run takes too long."""
    text = (ROOT / "python/mcplan/cli/track_text.py").read_text(encoding="utf-8")
    return re.findall(r'^\s+"(\w+)":', text, re.M) + [field.name for field in fields(Measures)]


def _plan_fields() -> list[str]:
    """Data of a plan: what is no method."""
    return [name for name, member in vars(mcplan.Plan).items() if isinstance(member, property)]


def _tolerances() -> list[str]:
    return [name for name, member in vars(Tolerances).items() if isinstance(member, property)]


def cmake_options() -> dict[str, str]:
    """Names and defaults of the options in CMakeLists.txt."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.findall(r'option\((MCPLAN_\w+) "[^"]*" ([^)]+)\)', text)
    found += re.findall(r'set\((MCPLAN_\w+) (\w+) CACHE STRING "[^"]*"\)', text)
    return {name: "ON at top level" if "TOP_LEVEL" in state else state for name, state in found}


LISTS: dict[str, Callable[[], list[str]]] = {
    "status": _status,
    "status of a given sequence": _solver_status,
    "constraints": _checked,
    "constraints of whole bodies": _checked_bodies,
    "scenes": list_scenes,
    "robots": list_robots,
    "planar robots": list_planar_robots,
    "planar tasks": list_planar_tasks,
    "fidelities": _fidelities,
    "keys of mcplan plan": _plan_json,
    "keys of mcplan sip": _sip_json,
    "keys of mcplan track": _track_json,
    "fields of a plan": _plan_fields,
    "tolerances": _tolerances,
    "options of CMake": lambda: list(cmake_options()),
}
