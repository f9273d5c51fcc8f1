"""Reading input files: regular ones alone, opened once, and no more bytes than a limit.

A file that somebody else made may be a device, a pipe, or larger than the memory, and may name other files. What may be
read how far stands here, and in docs/scenes_and_robots.md, "Limits of files".
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from mcplan.errors import InvalidInput, shown

_KIB, _MIB = 1024, 1024 * 1024

#: Bytes of a scene, robot or planar task (TOML).
MAX_TOML = 2 * _MIB
#: Bytes of a JSON file with reach polytopes.
MAX_POLYTOPES = 8 * _MIB
#: Bytes of a plan as it lies on the disk, and of all its arrays once they are inflated.
MAX_PLAN, MAX_PLAN_INFLATED = 64 * _MIB, 128 * _MIB
#: The same of a run, whose arrays may be larger than MAX_PLAN_INFLATED by so many times the size of the file.
MAX_RUN, MAX_RUN_INFLATED, MAX_RUN_RATIO = 512 * _MIB, 1024 * _MIB, 100
#: Bytes of a URDF or SRDF, and of one of its meshes.
MAX_URDF, MAX_MESH = 16 * _MIB, 256 * _MIB

_KINDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
}
#: Neither waits for the other end of a pipe nor makes a terminal that of this process.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)


def read_file(
    path: str | Path, most: int, error: type[InvalidInput], field: str = "", source: str | None = None
) -> bytes:
    """The content of a regular file.

    The file is opened once, and what is known of it is asked of the open file, so that it cannot be exchanged meanwhile.

    Args:
        path: Of the file.
        most: Bytes at most.
        error: Class of the errors.
        field: Where another file names this one, for messages; "" where the user does.
        source: File named in messages; None: this one.

    Raises:
        InvalidInput: Of the given class: there is no such file, it cannot be read, is no regular file, or is too large.
    """
    source = str(path) if source is None else source
    named = shown(str(path)) if field else ""
    try:
        _require_regular(os.stat(path), error, field, named, source)  # devices may act when they are but opened
        handle = os.open(path, _FLAGS)
        try:
            about = os.fstat(handle)
            _require_regular(about, error, field, named, source)
            if about.st_size > most:
                raise error(field, f"may have {size_text(most)} at most", f"{about.st_size} bytes", source)
            data = _read(handle, most)
        finally:
            os.close(handle)
    except OSError as bad:
        raise error(field, f"cannot be read: {bad.strerror}", named, source) from None
    except ValueError as bad:
        if isinstance(bad, InvalidInput):
            raise
        raise error(field, "cannot be read: no name that a file can have", named, source) from None
    if len(data) > most:  # files that say nothing of their size, as those of /proc
        raise error(field, f"may have {size_text(most)} at most", "more", source)
    return data


def require_regular_file(path: Path, most: int, error: type[InvalidInput], field: str = "", source: str = "") -> None:
    """That a file which a library opens itself is a regular one and not too large.

    Raises:
        InvalidInput: Of the given class: it is not, or there is no such file.
    """
    try:
        about = os.stat(path)
    except (OSError, ValueError) as bad:
        raise error(field, f"cannot be read: {getattr(bad, 'strerror', bad)}", shown(str(path)), source) from None
    _require_regular(about, error, field, shown(str(path)), source)
    if about.st_size > most:
        raise error(field, f"may have {size_text(most)} at most", f"{about.st_size} bytes", source)


def size_text(count: int) -> str:
    """A limit of bytes in words."""
    return f"{count // _MIB} MiB" if count % _MIB == 0 else f"{count // _KIB} KiB"


def _require_regular(about: os.stat_result, error: type[InvalidInput], field: str, named: str, source: str) -> None:
    kind = stat.S_IFMT(about.st_mode)
    if kind == stat.S_IFDIR:
        raise error(field, "cannot be read: Is a directory", named, source)
    if kind != stat.S_IFREG:
        raise error(field, "must be a regular file", _KINDS.get(kind, "none"), source)


def _read(handle: int, most: int) -> bytes:
    """Up to one byte more than the limit."""
    parts, left = [], most + 1
    while left > 0:
        part = os.read(handle, min(left, _MIB))
        if not part:
            break
        parts.append(part)
        left -= len(part)
    return b"".join(parts)
