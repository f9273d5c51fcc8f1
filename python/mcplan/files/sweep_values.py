"""A value of a sweep: one, several in turn, or one that is drawn at random."""

from __future__ import annotations

import math
from random import Random
from typing import Annotated, Any

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

#: Values of one grid, at most.
MAX_POINTS = 1_000_000
_PLAIN = (bool, int, float, str)

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Whole = Annotated[int, Field(strict=True)]


class Strict(BaseModel):
    """A table without other keys than its own."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Range(Strict):
    """Whole numbers in turn."""

    first: Whole = Field(0, description="The first of them.")
    count: Annotated[Whole, Field(ge=1, le=MAX_POINTS)] = Field(description="How many.")


class Normal(Strict):
    """A normal distribution, cut off on both sides."""

    mean: Number
    std: Annotated[Number, Field(gt=0)]
    low: Number = Field(description="Least value: what lies below is drawn again.")
    high: Number = Field(description="Largest value: what lies above is drawn again.")

    @model_validator(mode="after")
    def _likely(self) -> Normal:
        reach = (self.low - self.mean) / self.std, (self.high - self.mean) / self.std
        if _below(reach[1]) - _below(reach[0]) < 0.01:
            raise PydanticCustomError("rule", "must leave at least 1 % of the distribution between low and high")
        return self


class Several(Strict):
    """Values in turn (`grid`, `linspace`, `range`: every one is combined with all others), or one that is drawn for each
    sample."""

    grid: list[Any] | None = Field(None, min_length=1, description="Values in turn.")
    linspace: tuple[Number, Number, Whole] | None = Field(
        None, description="First value, last value, and the number of them, evenly spaced."
    )
    range: Range | None = Field(None, description="Whole numbers in turn.")
    uniform: tuple[Number, Number] | None = Field(None, description="Drawn between two numbers.")
    log_uniform: tuple[Number, Number] | None = Field(
        None, description="Drawn between two positive numbers, evenly in their logarithm."
    )
    integers: tuple[Whole, Whole] | None = Field(None, description="A whole number drawn between two, both included.")
    normal: Normal | None = Field(None, description="Drawn from a normal distribution that is cut off.")
    choice: list[Any] | None = Field(None, min_length=1, description="One of several values, drawn.")

    @model_validator(mode="after")
    def _sound(self) -> Several:
        given = [name for name in type(self).model_fields if getattr(self, name) is not None]
        if len(given) != 1:
            names = ", ".join(type(self).model_fields)
            raise PydanticCustomError("rule", "must have exactly one of {names}", {"names": names})
        for name in ("uniform", "log_uniform", "integers"):
            pair = getattr(self, name)
            if pair is not None and not pair[0] <= pair[1]:
                raise PydanticCustomError("rule", "must have the lower bound first")
        if self.log_uniform is not None and self.log_uniform[0] <= 0.0:
            raise PydanticCustomError("rule", "must have positive bounds")
        if self.linspace is not None and not 1 <= self.linspace[2] <= MAX_POINTS:
            raise PydanticCustomError("rule", "must have a number of values in [1, {most}]", {"most": MAX_POINTS})
        for value in [*(self.grid or []), *(self.choice or [])]:
            _require_plain(value)
        return self

    @property
    def drawn(self) -> bool:
        """Whether one value is drawn for each sample, and none stands in turn."""
        return self.grid is None and self.linspace is None and self.range is None

    def points(self) -> list[Any] | None:
        """The values in turn, or None where one is drawn."""
        if self.grid is not None:
            return list(self.grid)
        if self.linspace is not None:
            first, last, count = self.linspace
            return [first + (last - first) * i / max(count - 1, 1) for i in range_(count)]
        if self.range is not None:
            return list(range_(self.range.first, self.range.first + self.range.count))
        return None

    def count(self) -> int:
        """Number of values in turn; 1 where one is drawn."""
        if self.linspace is not None:
            return self.linspace[2]
        if self.range is not None:
            return self.range.count
        return len(self.grid) if self.grid is not None else 1

    def extremes(self) -> list[Any]:
        """Values that lie in every legal range if all do: the bounds, or each of them."""
        if self.normal is not None:
            return [self.normal.low, self.normal.high]
        if self.range is not None:
            return [self.range.first, self.range.first + self.range.count - 1]
        pair = self.uniform or self.log_uniform or self.integers
        return list(pair) if pair is not None else list(self.choice or self.points() or [])

    def draw(self, rng: Random) -> Any:
        """A value, where one is drawn."""
        if self.uniform is not None:
            return rng.uniform(*self.uniform)
        if self.log_uniform is not None:
            low, high = self.log_uniform
            return min(max(math.exp(rng.uniform(math.log(low), math.log(high))), low), high)
        if self.integers is not None:
            return rng.randint(*self.integers)
        if self.choice is not None:
            return rng.choice(self.choice)
        assert self.normal is not None
        while True:
            value = rng.gauss(self.normal.mean, self.normal.std)
            if self.normal.low <= value <= self.normal.high:
                return value


range_ = range  # the name of a field above


def _below(deviations: float) -> float:
    """Probability that a normal deviate is less."""
    return 0.5 * math.erfc(-deviations / math.sqrt(2.0))


def _require_plain(value: Any) -> Any:
    items = value if isinstance(value, list) else [value]
    if not items or not all(isinstance(item, _PLAIN) for item in items):
        raise PydanticCustomError("rule", "must be a number, a text, true or false, or a list of them")
    if not all(math.isfinite(item) for item in items if isinstance(item, float)):
        raise PydanticCustomError("rule", "must be finite")
    return value


_PLAIN_SCHEMA = {"anyOf": [{"type": kind} for kind in ("number", "string", "boolean", "array")]}

#: One value, or a table that says of which several.
Value = Annotated[
    Annotated[Any, BeforeValidator(_require_plain), WithJsonSchema(_PLAIN_SCHEMA), Tag("plain")]
    | Annotated[Several, Tag("several")],
    Discriminator(lambda value: "several" if isinstance(value, dict | Several) else "plain"),
]
