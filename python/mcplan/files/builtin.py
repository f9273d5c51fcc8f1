"""Finding files by built-in name or path."""

from __future__ import annotations

from pathlib import Path

from mcplan import _core
from mcplan.arguments import require_or_path
from mcplan.errors import UnknownName

DATA = Path(_core.data_folder()).resolve()


def names(folder: str) -> list[str]:
    """Sorted names of the built-in files of a kind."""
    return _core.built_in(folder)


def find(source: str | Path, folder: str, unknown: type[UnknownName]) -> Path:
    """Path of a built-in file, or `source` itself if there is such a file. A string that is a built-in name means that.

    Raises:
        InvalidArgument: It is neither a string nor a path.
        UnknownName: Of the given class; neither exists.
    """
    require_or_path("source", source, "a name")
    legal = names(folder)
    if isinstance(source, str) and source in legal:
        return Path(_core.data_folder()) / folder / f"{source}.toml"
    if exists(source):
        return Path(source)
    raise unknown(str(source), legal)


def exists(source: str | Path) -> bool:
    """Whether there is a file of that name."""
    try:
        return bool(str(source)) and Path(source).exists()
    except (OSError, ValueError):  # a name too long, or with a null byte
        return False
