"""Errors of typer about the words of the command, as errors of ours: name, rule, value."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mcplan.errors import shown

#: Rules by the word of typer's message, whatever its version.
_RULES = {"integer": "must be a whole number", "number": "must be a number", "float": "must be a number"}


def usage_text(found: Any, words: Sequence[str]) -> str:
    """The line of an error of typer.

    Args:
        found: The error. Typer brings its own click or uses the installed one: what it is is known by what it has.
        words: That were typed.
    """
    param = getattr(found, "param", None)
    message = " ".join(found.format_message().split())
    rule = next((rule for word, rule in _RULES.items() if f"a valid {word}" in message), None)
    if type(found).__name__ == "MissingParameter" and param is not None:
        return f"{typed_name(param)}: is required"
    if type(found).__name__ != "BadParameter" or param is None or rule is None:
        return message
    value = _value(param.opts, words)
    return f"{typed_name(param)}: {rule}" + ("" if value is None else f", got {shown(value)}")


def typed_name(param: Any) -> str:
    """What the user types for an option, or the placeholder of an argument."""
    if param.opts[0].startswith("-"):
        return max(param.opts, key=len)
    return str(param.metavar or param.name.upper()).strip("[]")


def _value(options: Sequence[str], words: Sequence[str]) -> str | None:
    """The word after an option, or the rest of the word that begins with it; None: it is an argument."""
    for place, word in enumerate(words):
        name, is_joined, rest = word.partition("=")
        if word in options and place + 1 < len(words):
            return words[place + 1]
        if name in options and is_joined:
            return rest
    return None
