"""Pydantic's findings as our errors: "file: field: rule, got value"."""

from __future__ import annotations

import typing
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from mcplan.errors import InvalidInput, did_you_mean

Model = TypeVar("Model", bound=BaseModel)

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
        error: Class raised for the first finding.
        source: File that the data come from, for the message.
    """
    try:
        return model.model_validate(data)
    except ValidationError as found:
        first = found.errors(include_url=False)[0]
        raise error(path_text(first["loc"]), _rule(model, first), _value(first), source) from None


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
        fields = _model_at(model, finding["loc"][:-1]).model_fields
        legal = [field.alias or name for name, field in fields.items()]
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
    text = repr(finding["input"])
    return text if len(text) <= 60 else text[:57] + "..."


def _model_at(model: type[BaseModel], location: tuple[Any, ...]) -> type[BaseModel]:
    """The model of the table at a location, walking through lists of tables."""
    for part in location:
        if isinstance(part, str):
            annotation = model.model_fields[part].annotation
            inner = [a for a in (annotation, *typing.get_args(annotation)) if isinstance(a, type)]
            model = next(a for a in inner if issubclass(a, BaseModel))
    return model
