"""Docstrings as Sphinx reads them: ours are plain text whose code is indented, with sections in Google's style."""

from __future__ import annotations

import re
from typing import Any

SECTIONS = ("Args:", "Attributes:", "Raises:", "Returns:", "Yields:")
CODE = re.compile(r"(``.*?``|`.*?`)")


#: Docstrings of properties, in which napoleon would take what stands before a colon for a type.
PROPERTIES: dict[str, list[str]] = {}


def as_restructured_text(_: Any, what: str, name: str, told: Any, options: Any, lines: list[str]) -> None:
    """Make a docstring, whose code is indented and whose text is plain, one that reStructuredText reads the same way."""
    out: list[str] = []
    in_section = in_code = False
    for line in lines:
        indented = line.startswith("    ")
        if line.strip() and not indented:
            in_section, in_code = line.strip() in SECTIONS, False
        if indented and not in_section and not in_code:
            out += ["", ".. code-block:: python", ""]
            in_code = True
        out.append(line if in_code else escaped(line))
    lines[:] = out
    if what in ("attribute", "property"):
        PROPERTIES[name] = out


def with_colons(_: Any, what: str, name: str, told: Any, options: Any, lines: list[str]) -> None:
    """Take back what napoleon has made of a property's docstring."""
    if name in PROPERTIES:
        lines[:] = PROPERTIES[name]


def escaped(line: str) -> str:
    """A line whose bars and trailing underscores mean themselves, but in what is marked as code."""
    parts = CODE.split(line)
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"(?<=\w)_(?!\w)", r"\\_", parts[i].replace("|", r"\|"))
    return "".join(parts)
