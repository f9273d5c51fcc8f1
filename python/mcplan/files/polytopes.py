"""Reach polytopes from and to plain data: inline as A and b, or by reference to a JSON file

{"about": "...", "licence": "...", "polytopes": {"com_in_left": {"A": [[...], ...], "b": [...]}, ...}}

beside the robot's file, where the numbers are long.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan._core import Polytope
from mcplan.errors import MOST_FINDINGS, InvalidRobot, did_you_mean, shown
from mcplan.files.reading import MOST_POLYTOPES, read_file, referenced


def polytope_to_dict(polytope: Polytope) -> dict[str, Any]:
    """Plain data with the keys of a robot file, inline."""
    return {"A": polytope.A.tolist(), "b": polytope.b.tolist()}


def polytope_from_dict(data: Mapping[str, Any] | None) -> Polytope:
    """Inverse of polytope_to_dict; None: not given."""
    return Polytope(A=data["A"], b=data["b"]) if data else Polytope()


def read_polytope(data: Mapping[str, Any], folder: Path | None, field: str, source: str) -> dict[str, Any]:
    """The polytope of a robot file's table, inline.

    Args:
        data: Table with A, b, file and name; those left out are empty.
        folder: Where `file` is looked for; None where files may not be named, as in plans.
        field: Path of the table, for messages.
        source: The robot's file, for messages.

    Raises:
        InvalidRobot: Given twice or not at all, or no such file or name in it; or the file is malformed.
    """
    from mcplan.files.fields import validated
    from mcplan.files.models import PolytopeModel

    if not data["file"]:
        if not data["A"]:
            raise InvalidRobot(f"{field}.A", "is required, or file and name", source=source)
        return {"A": data["A"], "b": data["b"]}
    if data["A"] or data["b"]:
        raise InvalidRobot(f"{field}.file", "must stand alone, without A and b", shown(data["file"]), source)
    if folder is None:
        raise InvalidRobot(f"{field}.file", "may be used in files alone; here A and b", shown(data["file"]), source)
    path = referenced(folder, data["file"], InvalidRobot, f"{field}.file", source)
    entries = _entries(path, f"{field}.file", source)
    if data["name"] not in entries:
        names = ", ".join(name[:60] for name in list(entries)[:MOST_FINDINGS])
        near = did_you_mean(data["name"], entries)
        rule = f"must be in {path.name} ({names}). {near}".strip()
        raise InvalidRobot(f"{field}.name", rule, shown(data["name"]), source)
    found = validated(PolytopeModel, entries[data["name"]], InvalidRobot, f"{path}: {data['name']}")
    return {"A": found.A, "b": found.b}


def _entries(path: Path, field: str, source: str) -> dict[str, Any]:
    text = read_file(path, MOST_POLYTOPES, InvalidRobot, field, source)
    try:
        content = json.loads(text.decode("utf-8"))
    except (ValueError, RecursionError) as bad:
        reason = (str(bad).splitlines() or ["malformed"])[0]
        raise InvalidRobot(field, "must be a JSON file", f"{path.name}: {reason}", source) from None
    entries = content.get("polytopes") if isinstance(content, dict) else None
    if not isinstance(entries, dict):
        raise InvalidRobot(field, "must hold an object `polytopes`", shown(path.name), source)
    return entries
