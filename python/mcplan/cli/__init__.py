"""The ``mcplan`` command. One file per verb; errors are a line each on stderr and exit code 2."""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Iterator, Sequence
from typing import Any

from mcplan.cli.interrupts import CODE, Watch
from mcplan.cli.terminal import guarded, printable
from mcplan.errors import InvalidInput, MissingExtra, SimplerDrawing, SuspiciousGeometry, SuspiciousName, UnknownName

_OURS = (SimplerDrawing, SuspiciousGeometry, SuspiciousName)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        arguments: Words after ``mcplan``; None: those of the process.

    Returns:
        The exit code: 0 done, 1 done with a negative answer (not solved, plan violated), 2 bad input, 130 interrupted,
        also where Ctrl-C came while it was starting, drawing or writing. A reader that goes away early, as in
        ``| head``, changes nothing.
    """
    code = CODE
    with Watch(last=arguments is None) as watch, guarded():
        code = _run(list(sys.argv[1:] if arguments is None else arguments) or ["--help"])
    if not watch.told:
        return code
    # CPython ends a process by SIGINT, whatever its exit code, if a KeyboardInterrupt has left an exec() of a text, as
    # named tuples and data classes are made; the next such exec() makes it forget that.
    exec("")
    return CODE


def _run(words: list[str]) -> int:
    try:
        _require_no_empty(words)
        from mcplan.cli.app import app, complete

        complete(words[0])
        with _warnings_as_lines():
            code = app(args=words, prog_name="mcplan", standalone_mode=False)
        if sys.stdout is not None:
            sys.stdout.flush()  # here a full disk is still an error with a message
        return code if isinstance(code, int) else 0
    except (InvalidInput, UnknownName, MissingExtra) as found:
        return _fail(str(found))
    except OSError as found:
        return _fail(printable(f"{found.filename}: {found.strerror}" if found.filename else str(found)))
    except KeyboardInterrupt:
        return CODE
    except Exception as found:
        # Usage errors of typer, whose class is known by what it does.
        if hasattr(found, "format_message"):
            from mcplan.cli.usage import usage_text

            return _fail(usage_text(found, words))
        if type(found).__name__ == "Abort":
            return CODE
        raise


def _require_no_empty(words: list[str]) -> None:
    """Refuse an empty word before a path is made of it, which would be the working folder.

    Raises:
        InvalidInput: No option or argument of any verb may be empty; shells make that of a variable that is not set.
    """
    for before, word in zip(["", *words], words, strict=False):
        option, is_value, value = word.partition("=")
        if word == "" or (word.startswith("--") and is_value and value == ""):
            where = option if word else f"the word after {before}" if before else "the first word"
            raise InvalidInput(where, "must not be empty: is a variable of the shell not set?")


@contextlib.contextmanager
def _warnings_as_lines() -> Iterator[None]:
    """Warnings of ours are one line on stderr, each time."""
    with warnings.catch_warnings():
        others = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
            if issubclass(category, _OURS):
                print(f"warning: {printable(' '.join(str(message).split()))}", file=sys.stderr)
            else:
                others(message, category, *where, **more)

        for ours in _OURS:
            warnings.simplefilter("always", ours)
        warnings.showwarning = show
        yield


def _fail(message: str) -> int:
    for line in message.splitlines() or [""]:
        print(f"error: {printable(' '.join(line.split()))}", file=sys.stderr)
    return 2
