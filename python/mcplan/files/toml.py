"""TOML in and out. Reading raises our errors; writing covers tables, lists of tables, lists and plain values."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan.errors import InvalidInput, printable
from mcplan.files.reading import MOST_TOML, read_file

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_LINE_WIDTH = 110
_MOST_PARTS = 100
#: Keys a.b.c of so many parts, for which the parser takes time that grows with the square of their number.
_LONG_KEY = re.compile(rf"(?<![\w\"'-])(?:[\w\"'-]+[ \t]*\.[ \t]*){{{_MOST_PARTS}}}")


def read_toml(path: Path, error: type[InvalidInput]) -> dict[str, Any]:
    """Parse a TOML file; `error` names the file when it cannot be read or is not TOML."""
    source = str(path)
    try:
        text = read_file(path, MOST_TOML, error).decode("utf-8")
    except UnicodeDecodeError as bad:
        raise error(
            "", "must be UTF-8 text", f"byte 0x{bad.object[bad.start]:02x} at offset {bad.start}", source
        ) from None
    if not text.strip():
        raise error("", "is empty", source=source)
    if _LONG_KEY.search(text):
        raise error("", f"is not TOML of ours: a key may have {_MOST_PARTS} parts at most", source=source)
    try:
        return tomllib.loads(text.removeprefix("\ufeff"))
    except ValueError as bad:  # what TOML forbids, and whole numbers of more digits than Python reads
        reason = str(bad) or "malformed"
        raise error("", f"is not TOML: {reason[0].lower() + reason[1:]}", source=source) from None
    except RecursionError:
        raise error("", "is not TOML: nested too deep", source=source) from None


def toml_text(data: Mapping[str, Any], header: str = "") -> str:
    """A mapping as TOML: plain values first, then tables and lists of tables.

    Args:
        data: Nested mappings, lists, strings, numbers and booleans.
        header: Comment to put on top.
    """
    # Names in it may hold what TOML forbids in comments: control characters, and bytes that are no text.
    lines = [f"# {printable(line)}".rstrip() for line in header.splitlines()]
    lines += [_pair(key, value) for key, value in data.items() if not _is_table(value) and not _is_tables(value)]
    for key, value in data.items():
        if _is_table(value):
            lines += _section(_key(key), value)
        elif _is_tables(value):
            lines += [line for table in value for line in _section(_key(key), table, "[[", "]]")]
    return "\n".join(lines) + "\n"


def _section(path: str, table: Mapping[str, Any], opening: str = "[", closing: str = "]") -> list[str]:
    """A table under its title; tables in it that are too long for a line become sections of their own."""
    inner = {key: value for key, value in table.items() if _is_table(value) and len(_pair(key, value)) > _LINE_WIDTH}
    lines = ["", f"{opening}{path}{closing}"]
    lines += [_pair(key, value) for key, value in table.items() if key not in inner]
    for key, value in inner.items():
        lines += _section(f"{path}.{_key(key)}", value)
    return lines


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(item, Mapping) for item in value)


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _value(key)


def _pair(key: str, value: Any) -> str:
    line = f"{_key(key)} = {_value(value)}"
    if len(line) > _LINE_WIDTH and isinstance(value, list):
        return f"{_key(key)} = [\n" + "".join(f"  {_value(item)},\n" for item in value) + "]"
    return line


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }" if value else "{}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return str(value)
