"""TOML in and out, through the C++ library. Reading raises our errors."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan.errors import InvalidInput
from mcplan.files.reading import MAX_TOML, read_file


def read_toml(path: Path, error: type[InvalidInput]) -> dict[str, Any]:
    """Parse a TOML file; `error` names the file when it cannot be read or is not TOML."""
    source = str(path)
    try:
        return _core.toml_from(read_file(path, MAX_TOML, error))
    except InvalidInput as found:
        raise found.moved(error, source) from None


def toml_text(data: Mapping[str, Any], header: str = "") -> str:
    """A mapping as TOML: plain values first, then tables and lists of tables.

    Args:
        data: Nested mappings, lists, strings, numbers and booleans.
        header: Comment to put on top.
    """
    return _core.toml_text(data, header)
