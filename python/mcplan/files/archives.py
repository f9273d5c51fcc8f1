"""What all plan files share: .npz archives without pickles, with a header of JSON, written whole or not at all."""

from __future__ import annotations

import io
import json
import math
import zipfile
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from mcplan._core import file_kind
from mcplan.errors import InvalidPlan, shown, written
from mcplan.files.reading import MAX_PLAN_INFLATED, size_text

_RULE = "must be an .npz or .json file written by mcplan"
_NO_ARCHIVE = "no zip archive, or an incomplete one"
_MAX_MEMBERS = 64  # arrays of an archive
_MEMBER_BYTES = 256  # of an array in the list of members, at most
_MAX_HEADER = 4 * 1024 * 1024  # bytes of JSON
_MAX_NUMPY_HEADER = 1000  # bytes that describe an array
_MAX_AXES = 4
_MAX_NAME, _MAX_REASON = 60, 200  # characters of names and reasons in messages


def archive_bytes(header: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> bytes:
    """The content of a file with this header and these arrays."""
    content = {"header": np.frombuffer(json.dumps(as_json(header), allow_nan=False).encode(), dtype=np.uint8), **arrays}
    buffer = io.BytesIO()
    np.savez(buffer, **cast(Any, content))
    return buffer.getvalue()


def as_json(value: Any) -> Any:
    """Plain data with "inf" and "-inf" for infinite numbers, which JSON does not have."""
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0.0 else "-inf"
    if isinstance(value, Mapping):
        return {key: as_json(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [as_json(item) for item in value]
    return value


def read_arrays(data: bytes, most: int = MAX_PLAN_INFLATED, most_arrays: int = _MAX_MEMBERS) -> dict[str, np.ndarray]:
    """The arrays of an archive.

    What the archive says of its sizes is added up first, then each array is inflated no further than it says, and its
    shape compared with what came out: memory is taken for what is in the file, never for what it claims.

    Args:
        data: Content of the file.
        most: Bytes of all arrays together, at most.
        most_arrays: How many arrays there are, at most.

    Raises:
        InvalidPlan: No such archive, a damaged one, one with arrays of anything but numbers, or too large.
    """
    _require_directory(data, most_arrays)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            _require_sizes(members, most, most_arrays)
            arrays: dict[str, np.ndarray] = {}
            for member in members:
                name = member.filename.removesuffix(".npy")
                if name in arrays:
                    raise InvalidPlan(name[:_MAX_NAME], "must be there once")
                with archive.open(member) as file:
                    arrays[name] = _array(file.read(member.file_size + 1), name[:_MAX_NAME])
            return arrays
    except InvalidPlan:
        raise
    except Exception as found:  # zipfile and its decompressors raise some twenty classes for damaged files
        raise InvalidPlan("", _RULE, _first_line(found)) from None


def _require_directory(data: bytes, most_arrays: int) -> None:
    """A directory at the end of the file that is small enough to be read, before it is."""
    end = data.rfind(b"PK\x05\x06")
    if end < 0 or len(data) < end + 22 or not zipfile.is_zipfile(io.BytesIO(data)):
        kind = file_kind(data)
        raise InvalidPlan("", _RULE, kind if kind not in ("", "an .npz archive", "a zip archive") else _NO_ARCHIVE)
    size = int.from_bytes(data[end + 12 : end + 16], "little")
    if size > _MEMBER_BYTES * most_arrays or data[max(0, end - 20) :].startswith(b"PK\x06\x07"):
        raise InvalidPlan("", f"may have {most_arrays} arrays at most", f"a directory of {size} bytes")


def _require_sizes(members: list[zipfile.ZipInfo], most: int, most_arrays: int) -> None:
    if len(members) > most_arrays:
        raise InvalidPlan("", f"may have {most_arrays} arrays at most", str(len(members)))
    for member in members:
        if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise InvalidPlan(member.filename[:_MAX_NAME], "must be stored or deflated", str(member.compress_type))
    total = sum(member.file_size for member in members)
    if total > most:
        raise InvalidPlan("", f"may have {size_text(most)} at most when inflated", f"{total} bytes")


def _array(data: bytes, name: str) -> np.ndarray:
    """An array of numbers in NumPy's format; a view of the bytes if it can be."""
    file = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(file)
        read = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}[version]
        shape, fortran, dtype = read(file, max_header_size=_MAX_NUMPY_HEADER)
    except Exception as found:  # NumPy evaluates the header as Python: all that a literal can be wrong with
        raise InvalidPlan(name, "must be an array of NumPy", _first_line(found)) from None
    if dtype.kind not in "biufUS" or dtype.shape:
        raise InvalidPlan("", _RULE, f"an array {shown(name)} of {shown(dtype)}")
    if len(shape) > _MAX_AXES or (dtype.kind in "biuf" and dtype.itemsize > 8):
        rule = f"must hold numbers of 64 bits at most along {_MAX_AXES} axes at most"
        raise InvalidPlan(name, rule, f"{dtype}, {len(shape)} axes")
    if any(size < 0 for size in shape) or math.prod(shape) * dtype.itemsize != len(data) - file.tell():
        rule = f"must have the {len(data) - file.tell()} bytes that are there"
        raise InvalidPlan(name, rule, f"shape {shown(shape)} of {dtype}")
    flat = np.frombuffer(data, dtype, offset=file.tell()).reshape(shape, order="F" if fortran else "C")
    return flat.astype(dtype.newbyteorder("="))


def read_header(arrays: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """The header of an archive.

    Raises:
        InvalidPlan: There is none, or it is no JSON object.
    """
    if "header" not in arrays:
        raise InvalidPlan("", _RULE, "an archive without `header`")
    if arrays["header"].nbytes > _MAX_HEADER:
        raise InvalidPlan("header", f"may have {size_text(_MAX_HEADER)} at most", f"{arrays['header'].nbytes} bytes")
    try:
        header = json.loads(arrays["header"].tobytes().decode("utf-8"))
    except (ValueError, RecursionError) as found:
        raise InvalidPlan("header", "must be JSON", _first_line(found)) from None
    if not isinstance(header, dict):
        raise InvalidPlan("header", "must be a JSON object", written(header))
    _require_text("header", header)
    return header


def kind_in(data: bytes) -> object:
    """The kind that the header of an archive says, whatever else is in it; None: it says none, or cannot be read."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive, archive.open("header.npy") as file:
            return read_header({"header": _array(file.read(_MAX_HEADER), "header")}).get("kind")
    except Exception:  # what is wrong with it is said where all of it is read
        return None


def kind_text(header: Mapping[str, Any]) -> str:
    """The kind that a header says, for a message; plans of contacts and CoM say none."""
    return written(header["kind"]) if header.get("kind") is not None else "none, as plans of contacts and CoM have"


def require_members(header: Mapping[str, Any], **kinds: type) -> None:
    """Raise InvalidPlan for a member of a header that is missing or of another type: texts or objects."""
    for key, kind in kinds.items():
        if not isinstance(header.get(key), kind):
            rule = f"must be {'a string' if kind is str else 'an object'}"
            raise InvalidPlan(f"header.{key}", rule, written(header[key]) if key in header else "nothing")


def require_kind(arrays: Mapping[str, np.ndarray], name: str, integers: bool = False) -> None:
    """Raise InvalidPlan for an array that is missing or has numbers of another kind."""
    if name not in arrays:
        raise InvalidPlan(name, "is required")
    if arrays[name].dtype.kind not in ("iu" if integers else "f"):
        wanted = "integers" if integers else "floating-point numbers"
        raise InvalidPlan(name, f"must hold {wanted}", str(arrays[name].dtype))


def _require_text(where: str, value: Any) -> None:
    """JSON may write halves of surrogate pairs, which are no characters and cannot be written again."""
    left = [(where, value)]
    while left:
        where, value = left.pop()
        if isinstance(value, dict):
            left += [(f"{where}.{key}", inner) for key, inner in value.items()]
            left += [(where, key) for key in value]
        elif isinstance(value, list):
            left += [(f"{where}[{i}]", inner) for i, inner in enumerate(value) if not isinstance(inner, float)]
        elif isinstance(value, str) and any("\ud800" <= character <= "\udfff" for character in value):
            raise InvalidPlan(where, "must be text", written(value))


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0][:_MAX_REASON]
