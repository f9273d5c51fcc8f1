"""Arguments of the public calls: one of the wrong type is named, and what is expected with it."""

from __future__ import annotations

import contextlib
import numbers
import os
from collections.abc import Iterator
from typing import Any

from mcplan._core import Plan, PlanarPlan
from mcplan.errors import InvalidArgument, InvalidPlan, InvalidRobot, InvalidScene, either, shown

#: How messages speak of the types that a path may have.
PATH = "a path"
#: Largest number of processes that any call starts side by side.
MAX_JOBS = 1024


def require(name: str, value: Any, *kinds: type, optional: bool = False) -> None:
    """Refuse an argument that is an instance of none of some classes.

    Args:
        name: Of the argument.
        value: What was given.
        *kinds: The classes.
        optional: None is legal as well.

    Raises:
        InvalidArgument: "plan: must be a Plan, got a PlanResult; its plan is result.plan".
    """
    if not isinstance(value, kinds) and not (optional and value is None):
        raise InvalidArgument(name, expected([titled(kind) for kind in kinds], optional), found(value))


def require_or_path(name: str, value: Any, *kinds: str, optional: bool = False) -> None:
    """Refuse what is no path, where a path may stand for an object; the objects have been taken out before.

    Args:
        name: Of the argument.
        value: What was given, an instance of none of `kinds`.
        *kinds: Names of the classes that the argument may have besides, and of what else a string may be.
        optional: None is legal as well.

    Raises:
        InvalidArgument: "scene: must be a Scene, a name or a path, got 3".
    """
    if optional and value is None:
        return
    if not isinstance(value, str) and not (isinstance(value, os.PathLike) and isinstance(os.fspath(value), str)):
        raise InvalidArgument(name, expected([*kinds, PATH], optional), found(value))


def require_number(name: str, value: Any) -> float:
    """The number that an argument is.

    Raises:
        InvalidArgument: It is no number, or one that is too large for a float.
    """
    try:
        if not isinstance(value, str | bytes | bytearray):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidArgument(name, "must be a number", found(value))


def require_whole(name: str, value: Any, low: int, high: int) -> int:
    """The whole number that an argument is.

    Raises:
        InvalidArgument: "jobs: must be a whole number in [1, 1024], got 0".
    """
    if isinstance(value, numbers.Integral) and not isinstance(value, bool) and low <= int(value) <= high:
        return int(value)
    raise InvalidArgument(name, f"must be a whole number in [{low}, {high}]", found(value))


def require_names(name: str, value: Any) -> None:
    """Refuse what is neither a string nor a list or tuple of strings.

    Raises:
        InvalidArgument: "joints: must be a string or a list of strings, got an ndarray".
    """
    if isinstance(value, str) or (isinstance(value, list | tuple) and all(isinstance(part, str) for part in value)):
        return
    raise InvalidArgument(name, "must be a string or a list of strings", found(value))


@contextlib.contextmanager
def named_by_file(scene: Any = None, robot: Any = None, plan: Any = None, plan_option: str = "") -> Iterator[None]:
    """Errors of what was read from files say which: what does not go together has been read without one.

    Args:
        scene: What was given for the scene; a name or a path is said with an InvalidScene.
        robot: The same of an InvalidRobot.
        plan: The same of an InvalidPlan, such as that of a warm start.
        plan_option: What precedes the file of the plan: the option of the command that it was given to.
    """
    try:
        yield
    except (InvalidScene, InvalidRobot, InvalidPlan) as error:
        given = scene if isinstance(error, InvalidScene) else robot if isinstance(error, InvalidRobot) else plan
        source = error.source or (str(given) if isinstance(given, str | os.PathLike) else "")
        if plan_option and isinstance(error, InvalidPlan):
            source = f"{plan_option} {source}"
        if source == error.source:
            raise
        raise error.moved(source=source) from None


def titled(kind: type) -> str:
    """A class with its article: "a Plan"."""
    return f"{'an' if kind.__name__[0] in 'AEIOUaeio' or kind.__name__ == 'ndarray' else 'a'} {kind.__name__}"


def expected(kinds: list[str], optional: bool = False) -> str:
    """ "must be a Plan or a PlanarPlan"; the last of several after "or"."""
    kinds = [*kinds, "None"] if optional else kinds
    return "must be " + either(kinds)


def found(value: Any) -> str:
    """What was given: plain values as they are, other things by their class, with a word on where the plan is."""
    if value is None or isinstance(value, bool | int | float | str | bytes):
        return shown(value)
    held = None
    with contextlib.suppress(Exception):  # an attribute of somebody else's class may raise what it likes
        held = getattr(value, "plan", None)
    where = "; its plan is result.plan" if isinstance(held, Plan | PlanarPlan) else ""
    return titled(type(value)) + where
