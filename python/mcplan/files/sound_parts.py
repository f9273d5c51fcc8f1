"""What is wrong besides in a file that has keys or types wrong: its sound parts are looked at with the others replaced.

A polygon that is not convex is found by the C++ class, which can be made once all keys and types are right. So that
one reading says it all, tables with such findings are replaced by ones that are right, and what is then found in them is
dropped.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from typing import Any

from mcplan.errors import InvalidInput

#: Makes a right table of a wrong one, given its place in its list.
Replacement = Callable[[Any, int], Any]


def replaced(
    data: Mapping[str, Any], locations: list[tuple[Any, ...]], replacements: Mapping[str, Replacement]
) -> tuple[dict[str, Any], list[str]]:
    """The data with every part replaced in which there is a finding.

    Args:
        data: With the keys of a file.
        locations: Of the findings.
        replacements: By key; what has none is left out, so that it takes its default.

    Returns:
        The data, and the fields that were replaced.
    """
    out, fields = copy.deepcopy(dict(data)), set[str]()
    for location in locations:
        key, index = location[0], location[1] if len(location) > 1 and isinstance(location[1], int) else None
        if index is not None and key in replacements and f"{key}[{index}]" not in fields:
            out[key][index] = replacements[key](out[key][index], index)
            fields.add(f"{key}[{index}]")
        elif index is None or key not in replacements:
            value = out.pop(key, None)
            if key in replacements:
                out[key] = replacements[key](value, -1)
            fields.add(str(key))
    return out, sorted(fields)


def elsewhere(finding: InvalidInput, fields: list[str]) -> bool:
    """Whether a finding is in none of the fields that were replaced."""
    return not any(finding.field == field or finding.field.startswith((f"{field}.", f"{field}[")) for field in fields)


def name_of(value: Any, index: int) -> str:
    """The name of a table if it has one, so that others may still name it."""
    name = value.get("name") if isinstance(value, Mapping) else None
    return name if isinstance(name, str) and name else f"({index})"
