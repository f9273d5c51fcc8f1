"""Typed errors. Bad input names field, rule and value; the C++ library raises the same classes.

Texts that are values stand in double quotes, as files write them; names that a sentence speaks of in single ones.

A file of a plan, motion or run that is not there, and any that cannot be written, is no error of these: readers and writers
raise Python's own ``OSError`` (``FileNotFoundError``), whose ``filename`` is the path as given.
"""

from __future__ import annotations

import difflib
import json
import os
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

__all__ = [
    "Interrupted",
    "InvalidArgument",
    "InvalidInput",
    "InvalidOptions",
    "InvalidPlan",
    "InvalidPlanarTask",
    "InvalidRobot",
    "InvalidScene",
    "InvalidSweep",
    "MissingExtra",
    "PlanViolated",
    "SimplerDrawing",
    "SuspiciousGeometry",
    "SuspiciousName",
    "UnknownName",
    "UnknownPlanarTask",
    "UnknownRobot",
    "UnknownScene",
]

#: Findings that a message lists before it says how many there are more.
MAX_FINDINGS = 20
_MAX_TEXT, _MAX_PATH = 60, 400  # characters of a value, of a path that a message shows


def printable(text: str) -> str:
    """A text whose control characters and halves of surrogate pairs are escaped, so that any terminal can show it."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode("ascii") for c in text)


def shown(value: Any, most: int = _MAX_TEXT) -> str:
    """A value as text for a message: short, printable, and never an error of its own. Texts are as files write them.

    Args:
        value: Whatever was found.
        most: Characters at most.
    """
    try:
        text = _quoted(value)
    except Exception:  # whole numbers of more digits than Python writes, what is nested too deep, or is not ours
        text = f"a whole number of {value.bit_length()} bits" if isinstance(value, int) else f"a {type(value).__name__}"
    text = printable(text)
    return text if len(text) <= most else text[: most - 3] + "..."


def shown_path(path: str | os.PathLike[str]) -> str:
    """A path as text for a message, with its end even where it is long."""
    return shown(os.fspath(path), _MAX_PATH)


def either(words: Sequence[str]) -> str:
    """ "a, b or c"."""
    return " or ".join(part for part in (", ".join(words[:-1]), words[-1]) if part)


def _quoted(value: Any) -> str:
    """The repr, with texts in double quotes, in lists and dictionaries too."""
    if type(value) is str:
        return '"' + re.sub(r'(["\\])', r"\\\1", value) + '"'
    if type(value) in (list, tuple):
        inner = ", ".join(_quoted(item) for item in value)
        return f"[{inner}]" if type(value) is list else f"({inner}{',' * (len(value) == 1)})"
    if type(value) is dict:
        return "{" + ", ".join(f"{_quoted(key)}: {_quoted(item)}" for key, item in value.items()) + "}"
    return repr(value)


def written(value: Any, most: int = _MAX_TEXT) -> str:
    """A value from a file as text for a message, in the words of the file and not of Python: true, null, "x".

    Args:
        value: As JSON has them; others are shown as Python does.
        most: Characters at most.
    """
    try:
        text = printable(json.dumps(value, ensure_ascii=False))
    except (TypeError, ValueError, RecursionError):
        return shown(value, most)
    return text if len(text) <= most else text[: most - 3] + "..."


def digits(number: int) -> str:
    """A whole number as text; one of more digits than Python writes in words."""
    try:
        return str(number)
    except ValueError:
        return shown(number)


class InvalidInput(ValueError):
    """Bad input. Reads "<source>: <field>: <rule>, got <value>"; the source (a file) and the field may be missing.

    Where more than one thing is wrong the message lists all of them, a line each.

    Attributes:
        field: Where, e.g. ``"surfaces[3].vertices"``.
        rule: What must hold, e.g. ``"needs at least 3 points"``.
        value: What was found, as text.
        source: The file it was read from, or ``""``.
        others: What else is wrong with the same input, errors of the same kind.
    """

    def __init__(self, field: str, rule: str, value: str = "", source: str = "") -> None:
        super().__init__(field, rule, value, source)
        self.field, self.rule, self.value, self.source = field, rule, value, source
        self.others: tuple[InvalidInput, ...] = ()

    def __str__(self) -> str:
        findings = [self, *self.others]
        lines = [printable(finding._line()) for finding in findings[:MAX_FINDINGS]]
        if len(findings) > MAX_FINDINGS:
            lines.append(f"and {len(findings) - MAX_FINDINGS} more")
        return "\n".join(lines)

    def _line(self) -> str:
        where = [part for part in (self.source, self.field) if part]
        return ": ".join([*where, self.rule]) + (f", got {self.value}" if self.value else "")

    def moved(self, kind: type[InvalidInput] | None = None, source: str = "", prefix: str = "") -> InvalidInput:
        """This error and the others as errors of another kind, of another file, or of a field within another one.

        Args:
            kind: Class of the new errors; None: as they are.
            source: The file; "": as it was.
            prefix: What to put before every field, e.g. ``"header.scene"``.
        """
        made = [_moved(finding, kind, source, prefix) for finding in (self, *self.others)]
        made[0].others = tuple(made[1:])
        return made[0]


def apart(error: InvalidInput) -> list[InvalidInput]:
    """An error and its others, each on its own."""
    return [_moved(finding, None, "", "") for finding in (error, *error.others)]


def _moved(finding: InvalidInput, kind: type[InvalidInput] | None, source: str, prefix: str) -> InvalidInput:
    field = ".".join(part for part in (prefix, finding.field) if part)
    return (kind or type(finding))(field, finding.rule, finding.value, source or finding.source)


def together(findings: Sequence[InvalidInput]) -> InvalidInput:
    """The first of some findings, with all that follow as its others.

    Args:
        findings: One at least.
    """
    flat = [single for finding in findings for single in (finding, *finding.others)]
    first = flat[0].moved()
    first.others = tuple(finding.moved() for finding in flat[1:])
    return first


class InvalidScene(InvalidInput):
    """A scene is malformed."""


class InvalidRobot(InvalidInput):
    """A robot is malformed."""


class InvalidPlanarTask(InvalidInput):
    """A planar task is malformed."""


class InvalidSweep(InvalidInput):
    """The file of a sweep is malformed, or a folder holds none, or another one."""


class InvalidOptions(InvalidInput):
    """An option does not exist or is out of its range."""


class InvalidPlan(InvalidInput):
    """A plan is malformed."""


class InvalidArgument(InvalidInput, TypeError):
    """An argument is of a type that the call does not take; a TypeError as well."""


class SuspiciousGeometry(UserWarning):
    """A file says what it can hardly mean, such as lengths in millimetres. It is read nevertheless."""


class SuspiciousName(UserWarning):
    """A scene has a name of an end-effector that the robot has almost, or none that it has. It is passed over."""


class SimplerDrawing(UserWarning):
    """A robot is drawn as a stick robot, since its meshes cannot be: none to be read, or no posture follows the plan."""


class UnknownName(ValueError):
    """No built-in of that name and no file of that name; the message lists the names that exist.

    Attributes:
        name: The name asked for.
        legal: The names that exist.
        hint: What the name may mean instead: a sentence and a space, or nothing.
    """

    kind = "name"
    hint = ""

    def __init__(self, name: str, legal: Sequence[str]) -> None:
        super().__init__(name, legal)
        self.name, self.legal = name, list(legal)

    def __str__(self) -> str:
        if not self.name:
            return f"a {self.kind} must have a name or a path that is not empty. Built-in: {', '.join(self.legal)}"
        return (
            f"no {self.kind} {self.name!r} and no file of that name. "
            f"{self.hint or did_you_mean(self.name, self.legal)}Built-in: {', '.join(self.legal)}"
        )


class UnknownScene(UnknownName):
    """No such scene."""

    kind = "scene"


class UnknownRobot(UnknownName):
    """No such robot."""

    kind = "robot"


class UnknownPlanarTask(UnknownName):
    """No such planar task."""

    kind = "planar task"


class PlanViolated(RuntimeError):
    """The checker rejects a plan.

    Attributes:
        violations: What it found, worst first.
    """

    def __init__(self, violations: Sequence[Any]) -> None:
        super().__init__(violations)
        self.violations = list(violations)

    def __str__(self) -> str:
        more = len(self.violations) - 1
        return str(self.violations[0]) + (f" (and {more} more)" if more else "")


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a solve, a check or a run; a KeyboardInterrupt, so that it ends the loop around it as well.

    Attributes:
        result: What the call would have returned, as far as it came: a ``PlanResult``, ``Walk``, ``sip.Result``,
            ``ipm.Result``, ``CheckResult`` or run, with status ``interrupted`` unless it was done just then.
    """

    def __init__(self, result: Any = None) -> None:
        super().__init__(result)
        self.result = result

    def __str__(self) -> str:
        return "interrupted"


class MissingExtra(ImportError):
    """An optional dependency is not installed; the message says what to install."""


def did_you_mean(name: str, legal: Iterable[str]) -> str:
    """``"Did you mean 'stairs'? "`` if one of the legal names is near, else ``""``."""
    near = nearest(name, legal)
    return f"Did you mean {printable(repr(near))}? " if near else ""


def nearest(name: str, legal: Iterable[str]) -> str:
    """The legal name that is most like a name, or "" if none is like it."""
    if len(name) > _MAX_TEXT:  # comparing takes the square of the length
        return ""
    near = difflib.get_close_matches(name, [entry for entry in legal if len(entry) <= _MAX_TEXT], n=1)
    return near[0] if near else ""


if TYPE_CHECKING:
    # Names of until 0.1.
    InvalidMotion, UnknownMotion = InvalidPlanarTask, UnknownPlanarTask
else:
    _MOVED = {"InvalidMotion": "InvalidPlanarTask", "UnknownMotion": "UnknownPlanarTask"}

    def __getattr__(name: str) -> Any:
        if name not in _MOVED:
            raise AttributeError(f"module 'mcplan.errors' has no attribute {name!r}", name=name, obj=None)
        from mcplan import moved

        moved.tell(f"errors.{name}", f"errors.{_MOVED[name]}")
        return globals()[_MOVED[name]]
