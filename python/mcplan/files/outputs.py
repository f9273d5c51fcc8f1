"""Every file that mcplan writes is written here: complete or not at all, and never in the place of something else.

A regular file is made beside its target under a name of its own and then renamed, so that a reader sees the old one or the
new one, also after Ctrl-C or on a full disk. A link goes on pointing where it points; devices and pipes are written through.
"""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from mcplan.arguments import require_or_path
from mcplan.errors import InvalidInput, either, shown, shown_path

#: Names of plans and runs.
ARCHIVE = (".npz",)
#: Of plans that C++ reads, too.
JSON = (".json",)
PAGE = (".html", ".htm")
TOML = (".toml",)


def write_whole(content: bytes | str, path: str | Path) -> Path:
    """Write a file at once; text is written as UTF-8.

    Raises:
        OSError: It cannot be written; ``filename`` is the path as given, and nothing half-written is left.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    with whole_file(path) as temporary:
        temporary.write_bytes(data)
    return Path(path)


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """Give a path to write to, with the target's suffix; what is there when the block ends becomes the target.

    Nothing becomes of it when the block raises.

    Raises:
        OSError: The file cannot be written; ``filename`` is the path as given.
    """
    require_named(path)
    target = Path(path)
    with _told_of(target):
        through = is_special(target)
        place = Path(tempfile.gettempdir()) if through else Path(os.path.realpath(target)).parent
        temporary = place / f".{target.stem[:40]}.{secrets.token_hex(6)}{target.suffix}"
        try:
            _require_replaceable(target)
            # The system takes the umask off; what writes by name finds the file there and keeps its mode.
            os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600 if through else 0o666))
            yield temporary
            if through:
                _pour(temporary, target)
            else:
                _move(temporary, Path(os.path.realpath(target)))
        finally:
            with suppress(OSError):
                temporary.unlink()


def is_special(path: Path) -> bool:
    """Whether a device, a pipe or a socket goes by that name: it is written through, whatever its name ends in.

    So is whatever stands behind /dev/stdout, which a rename would cut off from those who hold it open.
    """
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError:
        return False
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    return not stat.S_ISREG(mode) or os.path.abspath(path).startswith(("/dev/std", "/dev/fd/", "/proc/"))


def require_suffix(field: str, path: str | Path, suffixes: Sequence[str]) -> None:
    """Refuse a name that promises another kind of file.

    Raises:
        InvalidInput: It ends in none of the suffixes, which the message lists, and is no device or pipe; or it is empty.
    """
    require_named(path)
    target = Path(path)
    if target.suffix.lower() in suffixes or is_special(target):
        return
    raise InvalidInput(field, f"must end in {either([suffix for suffix in suffixes if suffix])}", shown_path(target))


def require_target(field: str, path: Path | None, suffixes: Sequence[str] | None = None, source: object = None) -> None:
    """Say before hours of work, not after, that a file cannot be written.

    Args:
        field: What the file is called in messages.
        path: The file; None: none is written.
        suffixes: What it may end in; None: anything.
        source: The file of which it is made, which may not be the same; anything else is no file.

    Raises:
        InvalidInput: Its folder does not exist or cannot be written to, it is a folder itself, it ends in none of the
            suffixes, or it would replace the one that it is made of.
    """
    if path is None:
        return
    require_named(path, field)
    if not path.parent.is_dir():
        raise InvalidInput(field, "must lie in a folder that exists", shown_path(path))
    if path.is_dir():
        raise InvalidInput(field, "must be a file", shown_path(path))
    try:
        if suffixes is not None:
            require_suffix(field, path, suffixes)
        if is_special(path):
            return
        if _is_there(source) and path.exists() and os.path.samefile(path, str(source)):
            raise InvalidInput(field, "must be another file than the one that is read", shown_path(path))
        _require_replaceable(path)
    except OSError as found:
        raise InvalidInput(
            field, "must be a file that can be written", f"{shown_path(path)} ({found.strerror})"
        ) from None
    require_writable(field, Path(os.path.realpath(path)).parent, path)


def require_folder(field: str, path: Path | None) -> None:
    """The same of a folder, which may not exist yet.

    Raises:
        InvalidInput: A file stands there, or it cannot be made or written to.
    """
    if path is None:
        return
    require_named(path, field)
    if path.exists() and not path.is_dir():
        raise InvalidInput(field, "must be a folder, or a name for a new one", shown_path(path))
    folder = Path(os.path.realpath(path))
    while not folder.exists():
        folder = folder.parent
    require_writable(field, folder, path)


def made_folder(path: str | Path) -> Path:
    """A folder for several files, which is made if it does not exist.

    Raises:
        OSError: The folder cannot be made.
        InvalidInput: The path is empty.
    """
    require_named(path)
    folder = Path(path)
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def require_writable(field: str, folder: Path, path: Path) -> None:
    """Raises InvalidInput if no file can be made in the folder; the message names `path`."""
    try:
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as found:
        rule = "must lie in a folder that can be written to"
        raise InvalidInput(field, rule, f"{shown_path(path)} ({found.strerror})") from None


def require_named(path: str | Path, field: str = "path") -> None:
    """Refuse what is no path, what no file can be called, and an empty path, of which ``Path`` makes the working folder.

    Raises:
        InvalidArgument: It is no path.
        InvalidInput: It is empty, has a null character or letters that cannot be encoded.
    """
    require_or_path(field, path)
    if not os.fspath(path):
        raise InvalidInput(field, "must not be empty")
    if "\0" in os.fspath(path):
        raise InvalidInput(field, "must have no null character", shown(os.fspath(path)))
    try:
        os.fsencode(path)
    except UnicodeEncodeError:
        raise InvalidInput(field, "must be text that can be encoded", shown(os.fspath(path))) from None


def _is_there(source: object) -> bool:
    return isinstance(source, str | os.PathLike) and os.path.exists(source)


def _require_replaceable(target: Path) -> None:
    """A file that may not be written is not replaced either; a name that is too long is found out here."""
    if os.path.lexists(target) and os.path.exists(target) and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(target))
    with suppress(FileNotFoundError):
        os.lstat(target)


def _move(temporary: Path, target: Path) -> None:
    with suppress(FileNotFoundError):
        os.chmod(temporary, stat.S_IMODE(os.stat(target).st_mode))
    os.replace(temporary, target)


def _pour(temporary: Path, target: Path) -> None:
    # Opened for writing alone and not cut: a device has no length.
    with open(temporary, "rb") as source, open(os.open(target, os.O_WRONLY), "wb") as sink:
        shutil.copyfileobj(source, sink)


@contextmanager
def _told_of(target: Path) -> Iterator[None]:
    """Errors name the file that was asked for, not the one beside it."""
    try:
        yield
    except OSError as found:
        if found.errno is None or (found.filename is not None and not _ours(found.filename, target)):
            raise
        raise OSError(found.errno, os.strerror(found.errno), str(target)) from None


def _ours(name: object, target: Path) -> bool:
    return os.path.basename(str(name)).startswith(f".{target.stem[:40]}.") or str(name) == str(target)
