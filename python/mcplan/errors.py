"""Typed errors. Bad input names field, rule and value; the C++ library raises the same classes."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from typing import Any


class InvalidInput(ValueError):
    """Bad input. Reads "<source>: <field>: <rule>, got <value>"; the source (a file) and the field may be missing.

    Attributes:
        field: Where, e.g. ``"surfaces[3].vertices"``.
        rule: What must hold, e.g. ``"needs at least 3 points"``.
        value: What was found, as text.
        source: The file it was read from, or ``""``.
    """

    def __init__(self, field: str, rule: str, value: str = "", source: str = "") -> None:
        super().__init__(field, rule, value, source)
        self.field, self.rule, self.value, self.source = field, rule, value, source

    def __str__(self) -> str:
        where = [part for part in (self.source, self.field) if part]
        return ": ".join([*where, self.rule]) + (f", got {self.value}" if self.value else "")


class InvalidScene(InvalidInput):
    """A scene is malformed."""


class InvalidRobot(InvalidInput):
    """A robot is malformed."""


class InvalidMotion(InvalidInput):
    """A motion is malformed."""


class InvalidOptions(InvalidInput):
    """An option does not exist or is out of its range."""


class InvalidPlan(InvalidInput):
    """A plan is malformed."""


class UnknownName(ValueError):
    """No built-in of that name and no file of that name; the message lists the names that exist.

    Attributes:
        name: The name asked for.
        legal: The names that exist.
    """

    kind = "name"

    def __init__(self, name: str, legal: Sequence[str]) -> None:
        super().__init__(name, legal)
        self.name, self.legal = name, list(legal)

    def __str__(self) -> str:
        return (
            f"no {self.kind} {self.name!r} and no file of that name. "
            f"{did_you_mean(self.name, self.legal)}Built-in: {', '.join(self.legal)}"
        )


class UnknownScene(UnknownName):
    """No such scene."""

    kind = "scene"


class UnknownRobot(UnknownName):
    """No such robot."""

    kind = "robot"


class UnknownMotion(UnknownName):
    """No such motion."""

    kind = "motion"


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


class MissingExtra(ImportError):
    """An optional dependency is not installed; the message says what to install."""


def did_you_mean(name: str, legal: Iterable[str]) -> str:
    """``"Did you mean 'stairs'? "`` if one of the legal names is near, else ``""``."""
    near = difflib.get_close_matches(name, list(legal), n=1)
    return f"Did you mean {near[0]!r}? " if near else ""
