"""Finding files by built-in name or path."""

from __future__ import annotations

from pathlib import Path

from mcplan.errors import UnknownName

DATA = Path(__file__).resolve().parent.parent / "data"


def names(folder: str) -> list[str]:
    """Sorted names of the built-in files of a folder of ``mcplan/data``."""
    return sorted(path.stem for path in (DATA / folder).glob("*.toml"))


def find(source: str | Path, folder: str, unknown: type[UnknownName]) -> Path:
    """Path of a built-in file, or `source` itself if there is such a file. A string that is a built-in name means that.

    Raises:
        UnknownName: Of the given class; neither exists.
    """
    legal = names(folder)
    if isinstance(source, str) and source in legal:
        return DATA / folder / f"{source}.toml"
    path = Path(source)
    try:
        if str(source) and path.exists():
            return path
    except (OSError, ValueError):  # a name too long, or with a null byte
        pass
    raise unknown(str(source), legal)
