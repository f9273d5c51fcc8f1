"""What all plan files share: .npz archives without pickles, with a header of JSON, written whole or not at all."""

from __future__ import annotations

import io
import json
import os
import tempfile
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np

from mcplan.errors import InvalidPlan


def archive_bytes(header: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> bytes:
    """The content of a file with this header and these arrays."""
    content = {"header": np.frombuffer(json.dumps(header, allow_nan=False).encode(), dtype=np.uint8), **arrays}
    buffer = io.BytesIO()
    np.savez(buffer, **cast(Any, content))
    return buffer.getvalue()


def write_whole(data: bytes, path: str | Path) -> None:
    """Write a file, which is complete or not there at all."""
    target = Path(path)
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp makes files that only their owner can read
        os.replace(temporary, target)
    except BaseException:
        os.unlink(temporary)
        raise


def read_arrays(data: bytes) -> dict[str, np.ndarray]:
    """The arrays of an archive.

    Raises:
        InvalidPlan: No such archive, or a damaged one.
    """
    if not zipfile.is_zipfile(io.BytesIO(data)):
        raise InvalidPlan("", "must be an .npz file written by mcplan", "no zip archive, or an incomplete one")
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as archive:
            return {name: archive[name] for name in archive.files}
    except (
        ValueError,
        KeyError,
        EOFError,
        OSError,
        MemoryError,
        NotImplementedError,
        RuntimeError,
        SyntaxError,
        tokenize.TokenError,
        zipfile.BadZipFile,
        zlib.error,
    ) as found:  # what NumPy and zipfile raise for damaged files
        raise InvalidPlan("", "must be an .npz file written by mcplan", _first_line(found)) from None


def read_header(arrays: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """The header of an archive.

    Raises:
        InvalidPlan: There is none, or it is no JSON object.
    """
    if "header" not in arrays:
        raise InvalidPlan("header", "is required")
    try:
        header = json.loads(arrays["header"].tobytes())
    except (ValueError, RecursionError) as found:
        raise InvalidPlan("header", "must be JSON", _first_line(found)) from None
    if not isinstance(header, dict):
        raise InvalidPlan("header", "must be a JSON object", type(header).__name__)
    return header


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]
