"""Options of a run by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from mcplan.errors import InvalidOptions, did_you_mean, shown

from .options import Gains, Options, Push


def make_options(values: Mapping[str, Any], base: Options | None = None) -> Options:
    """Options from names and values; `gains` as Gains or by name, `pushes` as Push or four numbers, one or several.

    Raises:
        InvalidOptions: No such option (the message lists those that exist), a wrong type, or out of range.
    """
    base = base or Options()
    given = dict(values)
    _require_known(given, Options, "")
    if isinstance(given.get("gains"), Mapping):
        _require_known(given["gains"], Gains, "gains.")
        for name, value in given["gains"].items():
            _require_number(f"gains.{name}", value)
        given["gains"] = replace(base.gains, **given["gains"])
    if "pushes" in given:
        pushes = given["pushes"]
        several = [pushes] if isinstance(pushes, Push) or is_row(pushes) else _listed("pushes", pushes)
        given["pushes"] = tuple(_push(i, push) for i, push in enumerate(several))
    for name, value in given.items():
        kind = type(getattr(base, name))
        if kind is float:
            _require_number(name, value)
        elif not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            raise InvalidOptions(name, f"must be of type {kind.__name__}", shown(value))
    options = replace(base, **given)
    options.validate()
    return options


def is_row(values: Any) -> bool:
    """Whether these are numbers, not rows of them; an array of NumPy is either."""
    listed = (isinstance(values, Sequence) and not isinstance(values, str | bytes)) or (
        isinstance(values, np.ndarray) and values.ndim > 0
    )
    return listed and len(values) > 0 and hasattr(values[0], "__float__") and np.ndim(values[0]) == 0


def _require_known(values: Mapping[str, Any], kind: type, prefix: str) -> None:
    legal = [item.name for item in fields(kind)]
    for name in values:
        if name not in legal:
            rule = f"no such option. {did_you_mean(name, legal)}Options: {', '.join(legal)}"
            raise InvalidOptions(prefix + name, rule)


def _require_number(name: str, value: Any) -> None:
    if isinstance(value, bool | str) or not hasattr(value, "__float__"):
        raise InvalidOptions(name, "must be a number", shown(value))
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):  # arrays, and integers that are larger than any float
        raise InvalidOptions(name, "must be a number", shown(value)) from None


def _listed(name: str, value: Any) -> list[Any]:
    is_number = isinstance(value, np.ndarray) and value.ndim == 0
    if isinstance(value, Push | str | bytes) or is_number or not hasattr(value, "__iter__"):
        raise InvalidOptions(name, "must be a list", shown(value))
    return list(value)


def _push(i: int, push: Any) -> Push:
    names = [item.name for item in fields(Push)]
    numbers = [getattr(push, name) for name in names] if isinstance(push, Push) else _listed(f"pushes[{i}]", push)
    if len(numbers) != len(names):
        raise InvalidOptions(f"pushes[{i}]", f"must be {', '.join(names)}", f"{len(numbers)} values")
    for name, value in zip(names, numbers, strict=True):
        _require_number(f"pushes[{i}].{name}", value)
    return Push(*(float(value) for value in numbers))
