"""Pydantic's findings as our errors: "file: field: rule, got value"."""

from __future__ import annotations

import types
import typing
from collections.abc import Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from mcplan.errors import InvalidInput, did_you_mean, nearest, shown, together

Model = TypeVar("Model", bound=BaseModel)

#: Of a table.
MOST_KEYS = 1000

_TYPE_RULES = {
    "float_type": "must be a number",
    "int_type": "must be a whole number",
    "string_type": "must be a string",
    "bool_type": "must be true or false",
    "list_type": "must be a list",
    "dict_type": "must be a table",
    "model_type": "must be a table",
    "finite_number": "must be a finite number",
}


def validated(model: type[Model], data: Any, error: type[InvalidInput], source: str = "") -> Model:
    """Fill a model from plain data.

    Args:
        model: Class to fill.
        data: Nested dicts, lists and values.
        error: Class raised, with all findings.
        source: File that the data come from, for the message.
    """
    _require_few_keys(data, error, source)
    try:
        return model.model_validate(data)
    except ValidationError as found:
        raw = found.errors(include_url=False)
    findings = _without_misspelt(model, raw)
    errors = [error(path_text(f["loc"]), _rule(model, f), _value(f), source) for f in findings]
    raise together(errors)


def _require_few_keys(data: Any, error: type[InvalidInput], source: str) -> None:
    """A table has few keys; a million of them that nobody knows would be a million findings."""
    left: list[tuple[str, Any]] = [("", data)]
    while left:
        where, value = left.pop()
        if isinstance(value, dict):
            if len(value) > MOST_KEYS:
                raise error(where, f"may have {MOST_KEYS} keys at most", str(len(value)), source)
            left += [(f"{where}.{key}" if where else str(key), inner) for key, inner in value.items()]
        elif isinstance(value, list):
            left += [(f"{where}[{i}]", inner) for i, inner in enumerate(value) if isinstance(inner, dict | list)]


def _without_misspelt(model: type[BaseModel], findings: Sequence[Any]) -> list[Any]:
    """The findings without keys that are missing because they are misspelt: the unknown key beside says which it means."""
    unknown = [finding["loc"] for finding in findings if finding["type"] == "extra_forbidden"]

    def misspelt(location: tuple[Any, ...]) -> bool:
        beside = [str(other[-1]) for other in unknown if other[:-1] == location[:-1]]
        legal = _keys(_model_at(model, location[:-1])) if beside else []
        return any(nearest(key, legal) == location[-1] for key in beside)

    return [finding for finding in findings if finding["type"] != "missing" or not misspelt(finding["loc"])]


def path_text(location: tuple[Any, ...]) -> str:
    """("surfaces", 2, "vertices") -> "surfaces[2].vertices"."""
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        elif part != "[key]":
            text += f".{part}" if text else str(part)
    return text


def _rule(model: type[BaseModel], finding: Any) -> str:
    kind, context = finding["type"], finding.get("ctx", {})
    if kind in _TYPE_RULES:
        return _TYPE_RULES[kind]
    if kind == "missing":
        return "is required"
    if kind == "extra_forbidden":
        legal = _keys(_model_at(model, finding["loc"][:-1]))
        return f"no such key. {did_you_mean(str(finding['loc'][-1]), legal)}Keys: {', '.join(legal)}"
    if kind == "greater_than":
        return "must be a positive number" if context["gt"] == 0 else f"must be greater than {context['gt']}"
    if kind == "greater_than_equal":
        return f"must be at least {context['ge']:g}"
    if kind == "less_than_equal":
        return f"must be at most {context['le']:g}"
    if kind == "string_too_short":
        return "must not be empty"
    if kind == "too_long":
        return f"may have {context['max_length']} entries at most"
    if kind == "too_short":
        least = context["min_length"]
        if finding["loc"][-1] == "vertices":
            return f"needs at least {least} points"
        return f"needs at least {least} {'entry' if least == 1 else 'entries'}"
    return finding["msg"][0].lower() + finding["msg"][1:]


def _value(finding: Any) -> str:
    if finding["type"] in ("missing", "extra_forbidden"):
        return ""
    if finding["type"] in ("too_short", "too_long"):
        return str(len(finding["input"]))
    return shown(finding["input"])


def _keys(model: type[BaseModel]) -> list[str]:
    return [field.alias or name for name, field in model.model_fields.items()]


def _model_at(model: type[BaseModel], location: tuple[Any, ...]) -> type[BaseModel]:
    """The model of the table at a location, walking through lists, tables by name and alternatives."""
    annotation: Any = model
    for part in location:
        annotation = _entered(annotation, part) or annotation  # pydantic also names the alternative that it tried
    found = next((inner for inner in _alternatives(annotation) if _is_model(inner)), BaseModel)
    return typing.cast(type[BaseModel], found)


def _entered(annotation: Any, part: Any) -> Any:
    """The type of what stands at a key or index of a type, or None if there is nothing."""
    for inner in _alternatives(annotation):
        origin, arguments = typing.get_origin(inner), typing.get_args(inner)
        if origin is list and isinstance(part, int):
            return arguments[0]
        if origin is dict and isinstance(part, str):
            return arguments[1]
        if _is_model(inner):
            for name, field in inner.model_fields.items():
                if part == (field.alias or name):
                    return field.annotation
    return None


def _alternatives(annotation: Any) -> list[Any]:
    """The types that a union or an annotated type stands for."""
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is typing.Annotated:
        return _alternatives(arguments[0])
    if origin in (typing.Union, types.UnionType):
        return [inner for argument in arguments for inner in _alternatives(argument)]
    return [annotation]


def _is_model(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)
