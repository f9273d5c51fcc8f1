"""What the compiled module binds, read off the module itself: a new binding is found without being listed anywhere."""

from __future__ import annotations

import enum
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from mcplan import _core

OPENING, CLOSING = "([{", ")]}"


@dataclass(frozen=True)
class Argument:
    """One argument of a signature: its type as pybind11 prints it."""

    name: str
    type: str
    optional: bool = False
    keyword_only: bool = False


@dataclass
class Call:
    """One overload of a function, method or constructor; `owner` is the class it belongs to, if it has one."""

    name: str
    owner: type | None
    target: Callable[..., Any]
    arguments: list[Argument]

    @property
    def text(self) -> str:
        return f"{self.owner.__qualname__}.{self.name}" if self.owner else self.name


@dataclass
class Property:
    """An attribute of a class; `type` is what its setter takes, or None where it has no setter."""

    name: str
    owner: type
    type: str | None


@dataclass
class Interface:
    """All that a module and its submodules bind."""

    classes: dict[str, type] = field(default_factory=dict)
    enums: dict[str, type] = field(default_factory=dict)
    constructors: list[Call] = field(default_factory=list)
    methods: list[Call] = field(default_factory=list)
    functions: list[Call] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)


def split(text: str, separator: str = ",") -> list[str]:
    """Parts of a text at separators outside brackets and quotes."""
    parts, depth, quote, start = [], 0, "", 0
    for i, c in enumerate(text):
        if quote:
            quote = "" if c == quote and text[i - 1] != "\\" else quote
        elif c in "'\"":
            quote = c
        elif c in OPENING:
            depth += 1
        elif c in CLOSING:
            depth -= 1
        elif depth == 0 and text.startswith(separator, i):
            parts.append(text[start:i].strip())
            start = i + len(separator)
    return [part for part in [*parts, text[start:].strip()] if part]


def inside(text: str, opening: int) -> str:
    """What stands between the bracket at `opening` and the one that closes it."""
    depth, quote = 0, ""
    for i in range(opening, len(text)):
        c = text[i]
        if quote:
            quote = "" if c == quote and text[i - 1] != "\\" else quote
        elif c in "'\"":
            quote = c
        elif c in OPENING:
            depth += 1
        elif c in CLOSING:
            depth -= 1
            if depth == 0:
                return text[opening + 1 : i]
    raise ValueError(f"no end of the brackets in {text!r}")


def arguments_of(signature: str) -> list[Argument]:
    """The arguments of "name(self: A, b: int = 3, *, c: float) -> D"."""
    found, keyword_only = [], False
    for part in split(inside(signature, signature.index("("))):
        if part in ("*", "/"):
            keyword_only = keyword_only or part == "*"
            continue
        name, _, annotation = part.partition(":")
        type_and_default = split(annotation, " = ")
        found.append(
            Argument(
                name.strip(), type_and_default[0] if annotation else "object", len(type_and_default) > 1, keyword_only
            )
        )
    return found


def signatures_of(name: str, doc: str) -> list[str]:
    """The signature lines of a docstring, one for each overload."""
    if "Overloaded function." not in doc:
        return [doc.splitlines()[0]]
    return [line.split(". ", 1)[1] for line in doc.splitlines() if re.match(rf"\d+\. {re.escape(name)}\(", line)]


def written_in_python(name: str, owner: type, target: Callable[..., Any]) -> Call:
    """A method that Python gave to a compiled class; its annotations are texts."""
    parameters = [p for p in inspect.signature(target).parameters.values() if p.name != "self"]
    arguments = [Argument(p.name, str(p.annotation), p.default is not p.empty) for p in parameters]
    return Call(name, owner, target, arguments)


def calls_of(name: str, owner: type | None, target: Callable[..., Any]) -> Iterator[Call]:
    for signature in signatures_of(name, target.__doc__ or ""):
        if "(" not in signature or signature.startswith(f"{name}(*args"):
            continue
        arguments = arguments_of(signature)
        yield Call(name, owner, target, [a for i, a in enumerate(arguments) if not (i == 0 and a.name == "self")])


def add_class(found: Interface, c: type) -> None:
    if hasattr(c, "__members__") or issubclass(c, enum.Enum):
        found.enums[full_name(c)] = c
        return
    found.classes[full_name(c)] = c
    for name, member in vars(c).items():
        if isinstance(member, property) and (member.__doc__ or "").startswith("Earlier name of"):
            continue  # a warning is an error in tests
        if isinstance(member, property):
            doc = (member.fset.__doc__ or "") if member.fset else ""
            found.properties.append(Property(name, c, arguments_of(doc)[-1].type if doc else None))
        elif inspect.isroutine(member) or isinstance(member, staticmethod):
            call = getattr(c, name)
            if name == "__init__":
                found.constructors.extend(constructors_of(c))
            elif inspect.isfunction(call):
                found.methods.append(written_in_python(name, c, call))
            elif not name.startswith("_pybind11") and call.__doc__:
                found.methods.extend(calls_of(name, c, call))


def constructors_of(c: type) -> Iterator[Call]:
    doc = c.__init__.__doc__ or ""
    if doc.startswith("__init__("):
        for signature in signatures_of("__init__", doc):
            yield Call("__init__", c, c, arguments_of(signature)[1:])


def full_name(c: type) -> str:
    return f"{c.__module__}.{c.__qualname__}"


def interface_of(module: ModuleType = _core) -> Interface:
    """Everything that `module` and its submodules bind."""
    found = Interface()
    pending, seen = [module], set()
    while pending:
        here = pending.pop()
        seen.add(here.__name__)
        for name, member in sorted(vars(here).items()):
            if inspect.ismodule(member) and member.__name__ not in seen:
                pending.append(member)
            elif inspect.isclass(member) and full_name(member) not in found.classes:
                add_class(found, member)
            elif inspect.isbuiltin(member) and not name.startswith("_"):
                found.functions.extend(calls_of(name, None, member))
    return found
