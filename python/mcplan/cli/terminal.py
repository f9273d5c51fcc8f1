"""What the command prints on: streams that show control characters, know every letter, and outlive their reader."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

from mcplan.errors import printable as printable  # where the command looks for it

#: All that moves a cursor, colours, rings, or reverses the direction of writing; line ends and tabs are ours.
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def shown(text: str) -> str:
    """Whole output with control characters written out, so that a name from a file is shown and not obeyed.

    Lines go through ``printable`` where they are put together, which leaves no line ends and tabs of names either.
    """
    return _CONTROL.sub(_written_out, text)


def say(line: str = "") -> None:
    """Print one line."""
    print(printable(line))


def control(stream: TextIO, text: str) -> None:
    """Write control characters of our own, such as the return to the line's begin."""
    if isinstance(stream, Stream):
        stream.send(text)
    else:
        stream.write(text)
    stream.flush()


#: Of streams, by file descriptor.
_NAMES = {1: "standard output", 2: "standard error output"}


class Stream:
    """A text stream before another one. Control characters are written out, letters that the terminal's encoding lacks
    are escaped, and when its reader has gone (``| head``) the rest goes nowhere: the work itself goes on."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._gone = False

    def write(self, text: str) -> int:
        self.send(shown(text))
        return len(text)

    def send(self, text: str) -> None:
        """Write the text as it is."""
        if self._gone:
            return
        try:
            try:
                self._stream.write(text)
            except UnicodeEncodeError:
                name = self._stream.encoding
                self._stream.write(text.encode(name, "backslashreplace").decode(name))
        except OSError as found:
            self._leave(found)

    def flush(self) -> None:
        if self._gone:
            return
        try:
            self._stream.flush()
        except OSError as found:
            self._leave(found)

    def writelines(self, lines: Any) -> None:
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _leave(self, found: OSError) -> None:
        """What is still in the buffer would fail again when the process ends: it goes to the null device.

        Raises:
            OSError: It is not that the reader has gone, but a full disk, for instance.
        """
        self._gone = True
        with suppress(OSError, ValueError):
            found.filename = _NAMES.get(self._stream.fileno())
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)
        if not isinstance(found, BrokenPipeError):
            raise found


@contextmanager
def guarded() -> Iterator[None]:
    """Standard output and error output as such streams."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = (Stream(stream) if stream is not None else stream for stream in before)  # type: ignore
    try:
        yield
    finally:
        streams = sys.stdout, sys.stderr
        sys.stdout, sys.stderr = before
        for stream in streams:
            if stream is not None:
                with suppress(OSError):  # said before, or no one is there to be told
                    stream.flush()


def _written_out(found: re.Match[str]) -> str:
    return found[0].encode("unicode_escape").decode("ascii")
