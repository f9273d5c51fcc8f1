"""Options by name: fields of a planner's options class from names and plain values."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np

from mcplan import moved
from mcplan.arguments import require
from mcplan.errors import InvalidArgument, InvalidInput, InvalidOptions, apart, did_you_mean, shown
from mcplan.logs import listen

ALIASES = {"time_limit": "time_limit_s"}
#: Names that options of rhp had until 0.1.
EARLIER = {"sole_share": "sole_ratio", "friction_share": "friction_ratio"}
_Options = TypeVar("_Options")


def start(name: str, base: _Options | None, kind: type[_Options]) -> _Options:
    """A copy of given options, or the defaults where none are given.

    Args:
        name: Of the argument that they are.
        base: The options, or None.
        kind: Their class.

    Raises:
        InvalidArgument: `base` is something else.
    """
    require(name, base, kind, optional=True)
    return kind() if base is None else copy.copy(base)


def fill(options: Any, values: Mapping[str, Any]) -> Any:
    """Set fields by name and validate.

    Args:
        options: An instance of a bound options class.
        values: By name; enumerations by the names of their members, where dashes may stand for underscores; groups of
            fields (`weights`) as mappings. None leaves a field as it is.

    Returns:
        The same object.

    Raises:
        InvalidOptions: No such option (the message lists those that exist), a wrong type, out of range, or an option
            under its name and its short or earlier name, which may differ.
    """
    for names, what in ((ALIASES, "which it is short for"), (EARLIER, "whose earlier name it is")):
        for other, name in names.items():
            if values.get(other) is not None and values.get(name) is not None:
                raise InvalidOptions(other, f"may not stand beside {name}, {what}", shown(values[other]))
    for name, value in values.items():
        if name in EARLIER and value is not None and hasattr(options, EARLIER[name]):
            moved.tell(f"rhp.Options.{name}", f"rhp.Options.{EARLIER[name]}", stacklevel=5)
        name = (ALIASES | EARLIER).get(name, name)
        if name == "weights" and isinstance(value, Mapping):
            for weight, amount in value.items():
                _set(options.weights, weight, amount, prefix="weights.")
        else:
            _set(options, name, value)
    options.validate()
    listen(options)
    return options


def option_names(cls: type) -> list[str]:
    """Names of the fields of a bound options class, in their order of declaration."""
    return [name for name, member in vars(cls).items() if isinstance(member, property)]


def _set(target: Any, name: str, value: Any, prefix: str = "") -> None:
    legal = option_names(type(target))
    if name not in legal:
        name = str(name)  # keys of a mapping may be anything
        raise InvalidOptions(prefix + name, f"no such option. {did_you_mean(name, legal)}Options: {', '.join(legal)}")
    if value is None:
        return
    if isinstance(value, str) and hasattr(type(getattr(target, name)), "__members__"):
        members = type(getattr(target, name)).__members__
        if value.replace("-", "_") not in members:
            raise InvalidOptions(prefix + name, f"must be one of {', '.join(members)}", shown(value))
        value = members[value.replace("-", "_")]
    kind = type(getattr(target, name))
    # pybind11 takes the one for the other.
    if (kind in (int, float) and isinstance(value, bool | np.bool_)) or (
        kind is bool and not isinstance(value, bool | np.bool_)
    ):
        raise InvalidOptions(prefix + name, f"must be of type {kind.__name__}", shown(value))
    try:
        setattr(target, name, value)
    except TypeError as error:
        if isinstance(error, InvalidArgument) and error.field.startswith(f"{name}["):  # an item of it
            raise InvalidOptions(prefix + error.field, error.rule, error.value) from None
        raise InvalidOptions(prefix + name, _type_rule(target, name, value), shown(value)) from None


def _type_rule(target: Any, name: str, given: Any) -> str:
    """What an option takes, by its value; whole numbers are refused only where they do not fit."""
    value = getattr(target, name)
    if type(value) is int and type(given) is int:
        return _whole_rule(target, name, given)
    if value is None:  # options that are empty by default are callbacks
        return "must be a function or None"
    return f"must be of type {type(value).__name__}"


def _whole_rule(target: Any, name: str, given: int) -> str:
    """The range of a whole number that its type cannot hold: the option's own where that ends there, else the type's."""
    limits = (0, -(2**31), -(2**63)) if given < 0 else (2**31 - 1, 2**63 - 1, 2**64 - 1)
    trial = copy.copy(target)
    nearest = [limit for limit in limits if _takes(trial, name, limit)][-1]
    try:
        trial.validate()
    except InvalidInput as error:
        for single in apart(error):
            if single.field == name:
                return single.rule
    return f"must be at {'least' if given < 0 else 'most'} {nearest}"


def _takes(target: Any, name: str, value: Any) -> bool:
    try:
        setattr(target, name, value)
    except TypeError:
        return False
    return True
