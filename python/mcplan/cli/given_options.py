"""Errors of arguments in the words of who typed the command: the option, not what the library calls it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import typer

from mcplan.cli.usage import typed_name
from mcplan.errors import InvalidArgument, InvalidInput, InvalidOptions, InvalidSweep, apart, together


def at_least(low: int) -> Callable[[typer.CallbackParam, Any], Any]:
    """The callback of an option whose number has a least value; it stands in the help in words.

    Raises:
        InvalidInput: "--faces: must be at least 6, got 3".
    """

    def checked(param: typer.CallbackParam, value: Any) -> Any:
        if value is not None and value < low:
            raise InvalidInput(typed_name(param), f"must be at least {low}", str(value))
        return value

    return checked


def within(low: int, high: int) -> Callable[[typer.CallbackParam, Any], Any]:
    """The callback of an option whose number has a range.

    Raises:
        InvalidInput: "--jobs: must lie in [1, 1024], got 0".
    """

    def checked(param: typer.CallbackParam, value: Any) -> Any:
        if value is not None and not low <= value <= high:
            raise InvalidInput(typed_name(param), f"must lie in [{low}, {high}]", str(value))
        return value

    return checked


def require_none_given(context: typer.Context, rule: str) -> None:
    """Raises InvalidInput for an option of a group of verbs that was typed before one of them, which would not see it."""
    for param in context.command.params:
        source = context.get_parameter_source(param.name or "")
        if source is not None and source.name == "COMMANDLINE":
            raise InvalidInput(typed_name(param), rule)


@contextmanager
def named_as_typed(*names: str, **options: str) -> Iterator[None]:
    """Errors of arguments name options instead. Stands above a verb as its decorator.

    What is wrong inside of a file stays as it is, and so does what is malformed: a scene, a robot, a planar task, a plan.

    Args:
        names: Of arguments whose options are called the same: ``"time_limit"`` is ``--time-limit``.
        options: Option by the name of the argument, where they differ; ``ends="--end"`` makes "--end foot" of "ends.foot",
            unless that has a name of its own.
    """
    typed = {name: f"--{name.replace('_', '-')}" for name in names} | options
    try:
        yield
    except InvalidInput as found:
        if type(found) not in (InvalidInput, InvalidOptions, InvalidArgument, InvalidSweep):
            raise
        named: dict[str, InvalidInput] = {}
        for single in (_named(each, typed) for each in apart(found)):
            named.setdefault(single.field, single)  # one option may set several arguments
        raise together(list(named.values())) from None


def _named(found: InvalidInput, typed: dict[str, str]) -> InvalidInput:
    name, _, part = found.field.partition(".")
    name = name.partition("[")[0]  # of several, one
    if found.source or name not in typed:
        return found
    if f"{name}.{part}" in typed:
        return type(found)(typed[f"{name}.{part}"], found.rule, found.value)
    return type(found)(f"{typed[name]} {part}".strip(), found.rule, found.value)
