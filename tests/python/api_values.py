"""Arguments for the API fuzz test: by the type that a signature names, plausible, edited or hostile."""

from __future__ import annotations

import copy
import random
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from api_signatures import Interface, full_name, inside, split

FLOATS = [0.0, -0.0, 1.0, -1.0, 0.5, 0.05, 3.0, 9.81, 1e-9, 1e-300, 1e9, 1e300, -1e300, float("nan"), float("inf")]
FLOATS += [-float("inf"), 5e-324, 1.7976931348623157e308]
INTEGERS = [0, 1, -1, 2, 3, 4, 5, 7, 8, 9, 12, 13, 64, 1000, 2**31 - 1, -(2**31), 2**31, 2**63, -(2**63), 10**30]
TEXTS = ["", "left_foot", "right_foot", "foot", "ground", "flat", "ddp", "humanoid44", "talos_wang", "\0", "\x1b[31m"]
TEXTS += ["ä" * 3, "\ud800", "x" * 5000, "/dev/null", "../x", "a\nb", "nan"]
JUNK: list[Any] = [
    None,
    True,
    3,
    -1.5,
    "text",
    b"bytes",
    [],
    {},
    (),
    [[1]],
    [[1, 2, 3]],
    [[1, 2], [3]],
    object(),
    set(),
]
JUNK += [float("nan"), [None], {"a": 1}, np.zeros((2, 3)), np.zeros((0, 3)), np.zeros(3), np.array("x"), 1j, print]


class Values:
    """Draws values; `pool` holds objects by the full name of their class."""

    def __init__(self, rng: random.Random, interface: Interface, pool: dict[str, list[Any]]) -> None:
        self.rng, self.interface, self.pool = rng, interface, pool
        self.hostility = 0.2

    def of(self, type_text: str) -> Any:
        """A value for an argument of that type; now and then one of another type."""
        if self.rng.random() < 0.02:
            return self.rng.choice(JUNK)
        return self.plain(type_text)

    def plain(self, text: str) -> Any:
        text = text.strip()
        if text.endswith("| None"):
            return None if self.rng.random() < 0.3 else self.plain(text[: -len("| None")])
        if text in self.interface.enums:
            return self.rng.choice(list(self.interface.enums[text].__members__.values()))  # type: ignore[attr-defined]
        if text in self.interface.classes:
            return self.instance(text)
        if text.startswith("typing.Annotated"):
            return self.array(text)
        simple: dict[str, Callable[[], Any]] = {
            "bool": lambda: self.rng.random() < 0.5,
            "str": self.text,
            "dict": dict,
            "object": self.anything,
        }
        if text in simple:
            return simple[text]()
        if text.startswith("typing.SupportsInt"):
            return self.integer()
        if text.startswith("typing.SupportsFloat"):
            return self.number()
        return self.container(text)

    def container(self, text: str) -> Any:
        if "Callable" in text:
            return self.rng.choice([None, None, *CALLBACKS])
        if "[" not in text:
            return self.anything()
        parts = split(inside(text, text.index("[")))
        if text.startswith("tuple"):
            return tuple(self.of(part) for part in parts)
        if "Mapping" in text:
            return {self.plain(parts[0]): self.of(parts[1]) for _ in range(self.size(3))}
        return [self.of(parts[0]) for _ in range(self.size(5))]

    def size(self, usual: int) -> int:
        return self.rng.choice([300, 40]) if self.rng.random() < 0.02 else self.rng.randint(0, usual)

    def instance(self, name: str) -> Any:
        objects = self.pool.get(name)
        return self.rng.choice(objects) if objects else None

    def number(self) -> Any:
        if self.rng.random() < self.hostility:
            return self.rng.choice(FLOATS)
        return self.rng.choice([self.rng.uniform(-2.0, 2.0), self.rng.uniform(0.0, 1.0), self.rng.randint(0, 3)])

    def integer(self) -> Any:
        return self.rng.choice(INTEGERS) if self.rng.random() < 2 * self.hostility else self.rng.randint(-1, 6)

    def text(self) -> str:
        names = [getattr(o, "name", "") for objects in self.pool.values() for o in objects[:3]] or [""]
        pick = self.rng.choice(TEXTS) if self.rng.random() < 2 * self.hostility else self.rng.choice(names)
        return pick if isinstance(pick, str) else ""

    def array(self, text: str) -> Any:
        match = re.search(r'"\[(.*?)\]"', text)
        sizes = [s.strip() for s in match.group(1).split(",")] if match else ["m"]
        shape = [int(s) if s.isdigit() else self.size(6) for s in sizes if s != "1"]
        if self.rng.random() < 0.05:
            shape = [self.size(6) for _ in range(self.rng.randint(0, 3))]
        return self.filled(shape)

    def filled(self, shape: list[int]) -> Any:
        values = np.array([self.rng.gauss(0.0, 0.5) for _ in range(int(np.prod(shape)))]).reshape(shape)
        if values.size and self.rng.random() < self.hostility:
            values.flat[self.rng.randrange(values.size)] = self.rng.choice(FLOATS)
        order = self.rng.random()
        if order < 0.1:
            return np.asfortranarray(values)
        return values.tolist() if order < 0.2 else values

    def anything(self) -> Any:
        draw = self.rng.random()
        if draw < 0.5:
            return self.filled([self.size(6), 3])
        if draw < 0.6:
            return self.filled([self.size(6)])
        if draw < 0.8:
            objects = [o for some in self.pool.values() for o in some]
            return self.rng.choice(objects) if objects else None
        return self.rng.choice(JUNK)

    def edited(self, name: str) -> Any:
        """A copy of a pooled object with one or two attributes anywhere below it replaced."""
        value = copy.deepcopy(self.instance(name))
        for _ in range(self.rng.randint(1, 2)):
            self.edit(value)
        return value

    def edit(self, value: Any) -> None:
        """Walk down from an object by random attributes and replace one on the way."""
        for _ in range(6):
            properties = [p for p in self.interface.properties if isinstance(value, p.owner)]
            if not properties:
                return
            chosen = self.rng.choice(properties)
            below = self.below(getattr(value, chosen.name))
            if below is not None and self.rng.random() < 0.75:
                value = below
                continue
            if chosen.type is not None:
                setattr(value, chosen.name, self.replacement(value, chosen.name, chosen.type))
                return

    def below(self, member: Any) -> Any:
        """A bound object that `member` is or holds, if any."""
        if isinstance(member, tuple) and member:
            member = self.rng.choice(member)
        return member if full_name(type(member)) in self.interface.classes else None

    def replacement(self, owner: Any, name: str, type_text: str) -> Any:
        """Fewer, more or other entries of what is there, or a value of that type."""
        old = getattr(owner, name)
        if isinstance(old, tuple | np.ndarray) and len(old) and self.rng.random() < 0.6:
            rows = list(old)
            kind = self.rng.randrange(4)
            if kind == 0:
                del rows[self.rng.randrange(len(rows))]
            elif kind == 1:
                rows.append(self.rng.choice(rows))
            elif kind == 2:
                rows = []
            else:
                rows = rows[: self.rng.randrange(len(rows))]
            return rows
        return self.of(type_text)


def fails(*_: Any) -> None:
    """A callback that raises."""
    raise ValueError("raised in a callback")


def silent(*_: Any) -> None:
    """A callback that does nothing."""


def answers(*_: Any) -> int:
    """A callback that returns what nobody asked for."""
    return 3


CALLBACKS: list[Callable[..., Any]] = [fails, silent, answers]
