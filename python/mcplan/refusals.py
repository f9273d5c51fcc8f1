"""Arguments that the compiled module refuses: of pybind11's list of signatures one typed line is made, naming the argument.

The module calls this for each of its functions, constructors and members (cpp/src/bindings/refusals.cpp).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mcplan import _core
from mcplan.arguments import expected, found, titled
from mcplan.errors import InvalidArgument, did_you_mean, shown

_PAIRS = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True)
class _Argument:
    name: str
    type: str
    required: bool
    by_name: bool  # alone
    default: str

    @property
    def legal(self) -> str:
        return f"{self.type} | None" if self.default == "None" else self.type


@dataclass(frozen=True)
class _Wrong:
    """Why a call does not fit a signature, and how many of its arguments do."""

    field: str
    rule: str
    value: str
    fitting: int


def refusal(text: str, given: tuple[Any, ...], named: dict[str, Any], member: str) -> InvalidArgument | None:
    """The error of a call that fits no signature; None: the text is of something else.

    Args:
        text: What pybind11 says.
        given: Arguments by position, self among them.
        named: Arguments by name.
        member: What is assigned; "": it is a call.
    """
    head = re.match(r"([\w.]*)\(\): incompatible (constructor|function) arguments\. The following", text)
    if head is None:
        return None
    if head[2] == "constructor":
        call, given = type(given[0]).__name__, given[1:]
    else:
        call = head[1]
    signatures = list(_signatures(text))
    if member and len(given) == 2 and signatures:
        misfit = _misfit(signatures[0][-1].legal, given[1])
        field, rule, value = misfit or ("", "must be another value", found(given[1]))
        return InvalidArgument(member + field, rule, value)
    misfits = [wrong for wrong in (_wrong(call, signature, given, named) for signature in signatures) if wrong]
    if not misfits:
        if (negative := _negative(signatures, given, named)) is not None:
            return negative
        values = [*map(found, given), *(f"{name}={found(value)}" for name, value in named.items())]
        return InvalidArgument(
            call, "must be called otherwise: a value is out of the range of its type", ", ".join(values)
        )
    wrong = max(misfits, key=lambda misfit: misfit.fitting)
    return InvalidArgument(wrong.field, wrong.rule, wrong.value)


def _negative(
    signatures: list[list[_Argument]], given: tuple[Any, ...], named: dict[str, Any]
) -> InvalidArgument | None:
    """Of arguments that all fit a signature by what it writes: the first that is negative, where C++ has no sign."""
    for signature in signatures:
        by_place = zip((argument for argument in signature if not argument.by_name), given, strict=False)
        by_name = ((argument, named[argument.name]) for argument in signature if argument.name in named)
        for argument, value in (*by_place, *by_name):
            if "typing.SupportsInt" in argument.legal and isinstance(value, int) and value < 0:
                return InvalidArgument(argument.name, "must be at least 0", found(value))
    return None


def no_member(made: Any) -> InvalidArgument | None:
    """The error of an enum's value that the enum does not have; None: it has it."""
    members = type(made).__members__
    if int(made) in {int(member) for member in members.values()}:
        return None
    legal = ", ".join(f"{int(member)} ({name})" for name, member in members.items())
    return InvalidArgument(type(made).__name__, f"must be one of {legal}", str(int(made)))


def _wrong(call: str, signature: list[_Argument], given: tuple[Any, ...], named: dict[str, Any]) -> _Wrong | None:
    """What is wrong with a call, its arguments by position first."""
    names = [argument.name for argument in signature if argument.name != "self"]
    places = [argument for argument in signature if not argument.by_name]
    fitting = 0
    for argument, value in zip(places, given, strict=False):
        if misfit := _misfit(argument.legal, value):
            return _Wrong(argument.name + misfit[0], misfit[1], misfit[2], fitting)
        fitting += 1
    taken = {argument.name for argument in places[: len(given)]}
    for name in named:
        if name not in names:
            rule = f"no such argument of {call}. {did_you_mean(name, names)}Arguments: {', '.join(names) or 'none'}"
            return _Wrong(name, rule, "", fitting)
        if name in taken:
            return _Wrong(name, f"must be given to {call} once", "two", fitting)
    if len(given) > len(places):
        rule = f"takes arguments by name alone: {', '.join(names)}" if names and not places else _takes(names)
        return _Wrong(call, rule, found(given[len(places)]), fitting)
    for argument in signature:
        if argument.name in named and (misfit := _misfit(argument.legal, named[argument.name])):
            return _Wrong(argument.name + misfit[0], misfit[1], misfit[2], fitting)
        fitting += argument.name in named
    for argument in signature:
        if argument.required and argument.name not in taken and argument.name not in named:
            return _Wrong(argument.name, f"is required by {call}", "", fitting)
    return None


def _takes(names: Sequence[str]) -> str:
    return f"takes no more arguments than {', '.join(names)}" if names else "takes no argument"


def _misfit(legal: str, value: Any) -> tuple[str, str, str] | None:
    """Where a value is not of a type, as "[2]" or "", the rule, and what is there; None: it is, or nobody knows."""
    options = _split(legal, " | ")
    number = {"typing.SupportsFloat", "typing.SupportsInt"}.intersection(options)
    if number:  # written as SupportsFloat | SupportsIndex
        options = [*number, *(option for option in options if not option.startswith("typing.Supports"))]
    misfits = []
    for option in options:
        kind, _, rest = option.partition("[")
        judge = _JUDGES.get(kind)
        misfit = judge(_split(rest[:-1], ", "), value) if judge else _class_misfit(kind, value)
        if misfit is None:
            return None
        misfits.append(misfit)
    if len(misfits) == 1 or (len(misfits) == 2 and misfits[-1][1] == "must be None" and misfits[0][0]):
        return misfits[0]
    kinds = [rule.removeprefix("must be ") for _, rule, _ in misfits]
    return "", expected(kinds), found(value)


def _class_misfit(kind: str, value: Any) -> tuple[str, str, str] | None:
    """The same of a class of the module."""
    wanted: Any = _core
    for part in kind.removeprefix("mcplan._core.").split("."):
        wanted = getattr(wanted, part, None)
    if not isinstance(wanted, type) or isinstance(value, wanted):
        return None
    members = getattr(wanted, "__members__", None)
    if members is None:
        return "", f"must be {titled(wanted)}", found(value)
    return "", f"must be one of {', '.join(f'{wanted.__name__}.{name}' for name in members)}", found(value)


def _number(_: list[str], value: Any) -> tuple[str, str, str] | None:
    # An array of one number has __float__, too, and pybind11 does not take it.
    is_number = not isinstance(value, np.ndarray) and (hasattr(value, "__float__") or hasattr(value, "__index__"))
    if is_number and isinstance(value, int) and abs(value) > sys.float_info.max:
        return "", "must be a number that a float can hold", f"one of {value.bit_length()} bits"
    return None if is_number else ("", "must be a number", found(value))


def _whole(_: list[str], value: Any) -> tuple[str, str, str] | None:
    if isinstance(value, float | np.floating) or not (hasattr(value, "__index__") or hasattr(value, "__int__")):
        return "", "must be a whole number", found(value)
    if isinstance(value, int) and not -(2**31) <= value < 2**31:  # the C++ type may be wider, yet this one was refused
        bits = 32 if -(2**63) <= value < 2**64 else 64
        return "", f"must be a whole number of {bits} bits", found(value)
    return None


def _instance(rule: str, *kinds: type) -> Callable[[list[str], Any], tuple[str, str, str] | None]:
    return lambda _, value: None if isinstance(value, kinds) else ("", rule, found(value))


def _function(_: list[str], value: Any) -> tuple[str, str, str] | None:
    return None if callable(value) or value is None else ("", "must be a function", found(value))


def _sequence(parts: list[str], value: Any) -> tuple[str, str, str] | None:
    if isinstance(value, str | bytes | Mapping) or not hasattr(value, "__len__") or not hasattr(value, "__getitem__"):
        return "", "must be a list", found(value)
    for index, item in enumerate(value):
        if misfit := _misfit(parts[0], item):
            return f"[{index}]{misfit[0]}", misfit[1], misfit[2]
    return None


def _pair(parts: list[str], value: Any) -> tuple[str, str, str] | None:
    if isinstance(value, str | bytes) or not hasattr(value, "__len__") or len(value) != len(parts):
        return "", "must be a pair" if len(parts) == 2 else f"must be {len(parts)} values", found(value)
    for index, (part, item) in enumerate(zip(parts, value, strict=True)):
        if misfit := _misfit(part, item):
            return f"[{index}]{misfit[0]}", misfit[1], misfit[2]
    return None


def _mapping(parts: list[str], value: Any) -> tuple[str, str, str] | None:
    if not isinstance(value, Mapping):
        return "", "must be a mapping", found(value)
    for key, item in value.items():
        if misfit := _misfit(parts[0], key):
            return "", misfit[1].replace("must be", "must have for keys", 1), misfit[2]
        if misfit := _misfit(parts[1], item):
            return f"[{shown(key)}]{misfit[0]}", misfit[1], misfit[2]
    return None


def _array(parts: list[str], value: Any) -> tuple[str, str, str] | None:
    """typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]", ...]"""
    shape = next((part.strip('"[]').split(", ") for part in parts if part.startswith('"[')), None)
    if shape is None:
        return None
    sizes = [int(size) if size.isdigit() else None for size in shape]
    column = len(sizes) == 2 and sizes[1] == 1
    if column:
        rule = "must be a list of numbers" if sizes[0] is None else f"must be {sizes[0]} numbers"
    else:
        rule = f"must be an array of numbers of shape {' x '.join(shape)}"
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return "", rule, found(value)
    wanted = [sizes[:1], sizes] if column else [sizes]
    fits = any(
        len(one) == array.ndim and all(size in (None, there) for size, there in zip(one, array.shape, strict=True))
        for one in wanted
    )
    return None if fits else ("", rule, f"shape {' x '.join(map(str, array.shape)) or 'of one number'}")


_JUDGES: dict[str, Callable[[list[str], Any], tuple[str, str, str] | None]] = {
    "object": lambda _, value: None,
    "typing.Any": lambda _, value: None,
    "None": lambda _, value: None if value is None else ("", "must be None", found(value)),
    "str": _instance("must be a string", str, bytes),
    "bytes": _instance("must be bytes", bytes, bytearray),
    "bool": _instance("must be True or False", bool, np.bool_),
    "float": _number,
    "int": _whole,
    "typing.SupportsFloat": _number,
    "typing.SupportsInt": _whole,
    "tuple": _pair,
    "dict": _mapping,
    "list": _sequence,
    "collections.abc.Sequence": _sequence,
    "collections.abc.Mapping": _mapping,
    "collections.abc.Callable": _function,
    "typing.Annotated": _array,
}


def _signatures(text: str) -> Iterator[list[_Argument]]:
    """The arguments of each signature that the text lists."""
    at = text.index("supported:\n") + len("supported:\n")
    while start := re.compile(r"\s*\d+\. [\w.]*\(").match(text, at):
        inner, at = _inside(text, start.end() - 1)
        at = text.find("\n", at)
        arguments, by_name = [], False
        for part in _split(inner, ", "):
            if part in ("*", "/", ""):
                by_name = by_name or part == "*"
                continue
            named, *default = _split(part, " = ")
            name, _, legal = named.partition(": ")
            arguments.append(_Argument(name, legal or "object", not default, by_name, default[0] if default else ""))
        yield arguments
        if at < 0:
            return


def _inside(text: str, start: int) -> tuple[str, int]:
    """What stands in the bracket that opens at a place, and where it has been closed."""
    for end in _outer(text, start + 1):
        if text[end] == _PAIRS[text[start]]:
            return text[start + 1 : end], end
    return text[start + 1 :], len(text)


def _split(text: str, separator: str) -> list[str]:
    """Parts between separators that stand in no bracket and no quotes."""
    parts, begin = [], 0
    for place in _outer(text, 0):
        if place >= begin and text.startswith(separator, place):
            parts.append(text[begin:place])
            begin = place + len(separator)
    return [*parts, text[begin:]]


def _outer(text: str, start: int) -> Iterator[int]:
    """Places that stand in no bracket and no quotes that open after the start."""
    closing: list[str] = []
    quote = ""
    skip = False
    for place in range(start, len(text)):
        character = text[place]
        if skip:
            skip = False
        elif quote:
            skip = character == "\\"
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        elif closing and character == closing[-1]:
            closing.pop()
        else:
            if not closing:
                yield place
            if character in _PAIRS:
                closing.append(_PAIRS[character])
